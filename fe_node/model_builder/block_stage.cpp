// One element block per part and element kind.
#include <fmt/format.h>

#include "fe_node/element/hex8.h"
#include "fe_node/element/shell.h"
#include "fe_node/model_builder/law_stage.h"

namespace crosswalk::fe {
namespace {

std::vector<int> elements_of(const ElementTable& table, int part) {
  std::vector<int> elements;
  for (int e = 0; e < table.size(); ++e)
    if (table.part[e] == part) elements.push_back(e);
  return elements;
}

/// Chains of *PART_AVERAGED: segments in deck order that share an end node.
std::vector<std::vector<int>> strands_of(const Mesh& mesh, const std::vector<int>& elements) {
  std::vector<std::vector<int>> strands;
  int end = -1;
  for (int e = 0; e < static_cast<int>(elements.size()); ++e) {
    const std::span<const int> corners = mesh.corners(ElementKind::Line2, elements[e]);
    if (corners[0] != end) strands.emplace_back();
    strands.back().push_back(e);
    end = corners[1];
  }
  return strands;
}

void add_line_block(BuildContext& c, const Part& part, int index, std::vector<int> elements) {
  std::optional<LineProperties> properties = line_properties(c, part);
  if (!properties) return;
  if (part.is_averaged) properties->strands = strands_of(c.mesh(), elements);
  if (std::holds_alternative<ElasticLine>(properties->law))
    properties->minimum_step = element_controls(c, part).minimum_step;
  const auto is_apart = [&](int e) {
    const std::span<const int> n = c.mesh().corners(ElementKind::Line2, e);
    return (c.mesh().position[n[0]] - c.mesh().position[n[1]]).norm() > 0;
  };
  for (int e : elements)
    if (!is_apart(e)) {
      c.problem(part.source,
                fmt::format("line element {}", c.mesh().table(ElementKind::Line2).id[e].value),
                "two ends apart", "a length of zero");
      return;
    }
  c.model().blocks.push_back(make_line_block(c.mesh(), index, std::move(elements), *properties));
}

/// Thickness of each shell, m: the mean of its own corner values, else the section's. Empty when no
/// shell has its own.
std::vector<double> shell_thickness(const BuildContext& c, ElementKind kind,
                                    const std::vector<int>& elements, double of_section) {
  if (c.shell_thickness.empty()) return {};
  std::vector<double> thickness;
  for (int e : elements) {
    const auto found = c.shell_thickness.find(c.built.model.mesh.table(kind).id[e]);
    thickness.push_back(found == c.shell_thickness.end() ? of_section : found->second);
  }
  return thickness;
}

void add_part_blocks(BuildContext& c, int index) {
  const Part& part = c.deck.parts[index];
  for (ElementKind kind : kElementKinds) {
    std::vector<int> elements = elements_of(c.mesh().table(kind), index);
    if (elements.empty()) continue;
    const ElementControls controls = element_controls(c, part);
    if (kind == ElementKind::Line2) {
      add_line_block(c, part, index, std::move(elements));
    } else if (kind == ElementKind::Hex8) {
      if (const std::optional<SolidLaw> law = solid_law(c, *c.material_of(part)))
        c.model().blocks.push_back(
            make_hex8_block(c.mesh(), index, std::move(elements), *law, controls));
    } else if (const std::optional<ShellSection> section = shell_section(c, part)) {
      const std::vector<double> thickness = shell_thickness(c, kind, elements, section->thickness);
      c.model().blocks.push_back(make_shell_block(c.mesh(), kind, index, std::move(elements),
                                                  *section, controls, thickness));
    }
  }
}

}  // namespace

void build_blocks(BuildContext& c) {
  if (c.problem_count > 0) return;  // elements with bad nodes or shapes would not survive here
  for (std::size_t p = 0; p < c.deck.parts.size(); ++p)
    if (!c.mesh().parts[p].is_rigid) add_part_blocks(c, static_cast<int>(p));
}

}  // namespace crosswalk::fe
