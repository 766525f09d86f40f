#include "fe_node/model_report.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "common/units.h"
#include "fe_node/generate/quality.h"

namespace crosswalk::fe {
namespace {

struct PartElements {
  int count = 0;
  double least_step = std::numeric_limits<double>::infinity();  ///< s
};

/// Per part of the mesh; rigid parts have none, lines no step of their own.
std::map<int, PartElements> elements_of(const Model& model) {
  std::map<int, PartElements> parts;
  for (const auto& block : model.blocks) {
    PartElements& part = parts[block->part()];
    part.count += block->element_count();
    for (int e = 0; e < block->element_count(); ++e)
      part.least_step = std::min(part.least_step, block->initial_stable_step(e));
  }
  return parts;
}

}  // namespace

std::string model_report(const generate::HeadNeck& made, const Model& model) {
  std::map<int, generate::PartQuality> quality;
  for (const generate::PartQuality& q : generate::hex_quality(made.draft.mesh)) quality[q.part] = q;
  std::string out = "Masses, frame N\n" + made.masses.text();
  out += fmt::format(
      "\nMesh: scaled Jacobian (at least {}, tetrahedra aside), aspect (at most {}), warpage, "
      "least volume\nover face area of the bricks; least step of an element of its own, unscaled; "
      "mass added by mass scaling.\nThe nodes allow {:.3f} us.\n",
      generate::kMinScaledJacobian, generate::kMaxAspect, 1e6 * initial_stable_step(model));
  out += fmt::format("{:>6}  {:<20}{:>9}{:>10}{:>8}{:>9}{:>9}{:>9}{:>9}\n", "part", "title",
                     "elements", "Jacobian", "aspect", "warp deg", "size mm", "step us", "added g");
  std::map<int, PartElements> elements = elements_of(model);
  int lines = 0;
  for (int p = 0; p < static_cast<int>(model.mesh.parts.size()); ++p) {
    const MeshPart& part = model.mesh.parts[p];
    const auto bricks = quality.find(static_cast<int>(part.id.value));
    const PartElements own = elements[p];
    const bool is_solid = bricks != quality.end(), has_step = own.least_step < 1;
    if (!is_solid && !has_step) {
      lines += own.count;
      continue;
    }
    const auto to = std::back_inserter(out);
    fmt::format_to(to, "{:>6}  {:<20}{:>9}", part.id.value, part.name,
                   is_solid ? bricks->second.elements : own.count);
    if (is_solid) {
      const generate::PartQuality& q = bricks->second;
      fmt::format_to(to, "{:>10.3f}{:>8.1f}{:>9.1f}{:>9.2f}", q.min_scaled_jacobian, q.max_aspect,
                     q.max_warpage / kDegree, 1e3 * q.min_characteristic_length);
    } else {
      fmt::format_to(to, "{:>10}{:>8}{:>9}{:>9}", "", "", "", "");
    }
    if (has_step)
      fmt::format_to(to, "{:>9.3f}{:>9.3f}\n", 1e6 * own.least_step, 1e3 * model.added_mass[p]);
    else
      fmt::format_to(to, "{:>9}{:>9}\n", "rigid", "");
  }
  out += fmt::format(
      "and {} ligaments, muscles, fibres and stops, which set no step of their own\n", lines);
  return out;
}

}  // namespace crosswalk::fe
