// One element block per part and element kind.
#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "fe_node/element/beam.h"
#include "fe_node/element/hex8.h"
#include "fe_node/element/hex8_full.h"
#include "fe_node/element/hex8_points.h"
#include "fe_node/element/shell.h"
#include "fe_node/element/tet4.h"
#include "fe_node/model_builder/law_stage.h"

namespace crosswalk::fe {
namespace {

std::vector<int> elements_of(const ElementTable& table, int part) {
  std::vector<int> elements;
  for (int e = 0; e < table.size(); ++e)
    if (table.part[e] == part) elements.push_back(e);
  return elements;
}

/// Chains of *PART_AVERAGED: segments that follow each other in the deck, from one end of the chain
/// or from the other.
std::vector<std::vector<int>> strands_of(const Mesh& mesh, const std::vector<int>& elements) {
  std::vector<std::vector<int>> strands;
  int begin = -1, end = -1;
  for (int e = 0; e < static_cast<int>(elements.size()); ++e) {
    const std::span<const int> corners = mesh.corners(ElementKind::Line2, elements[e]);
    const bool goes_on = corners[0] == end, comes_before = corners[1] == begin;
    if (!goes_on && !comes_before) strands.emplace_back();
    strands.back().push_back(e);
    if (goes_on || !comes_before) end = corners[1];
    if (!goes_on) begin = corners[0];
  }
  return strands;
}

/// The vector from the axis to the third node, or the one the card gives, of each beam.
std::optional<std::vector<Vec3>> beam_planes(BuildContext& c, const Part& part,
                                             const std::vector<int>& elements) {
  std::unordered_map<DeckId, const BeamElement*> cards;
  for (const BeamElement& beam : c.deck.beams) cards.emplace(beam.id, &beam);
  const Mesh& mesh = c.mesh();
  std::vector<Vec3> planes;
  for (int e : elements) {
    const DeckId id = mesh.table(ElementKind::Line2).id[e];
    const std::string who = fmt::format("*ELEMENT_BEAM {}", id.value);
    const auto card = cards.find(id);
    if (card == cards.end()) {
      c.problem(part.source, who, "beams alone in a part whose section bends", "another element");
      return std::nullopt;
    }
    const BeamElement& beam = *card->second;
    const std::span<const int> ends = mesh.corners(ElementKind::Line2, e);
    const Vec3 axis = mesh.position[ends[1]] - mesh.position[ends[0]];
    Vec3 plane = beam.orientation;
    if (beam.nodes[2].given())
      if (const int n = c.node(beam.nodes[2], beam.source, who); n >= 0)
        plane = mesh.position[n] - mesh.position[ends[0]];
    for (const int released : beam.released)
      if (released != 0) {
        c.problem(beam.source, who, "ends that release nothing", "a release");
        return std::nullopt;
      }
    constexpr double kAngle = 1e-6;
    if (!(axis.cross(plane).norm() > kAngle * axis.norm() * plane.norm())) {
      c.problem(beam.source, who, "a third node off the axis", "none",
                "the section's axes need it, of a round section too");
      return std::nullopt;
    }
    planes.push_back(plane);
  }
  return planes;
}

/// True when the part's section is one that bends, and a block of it has been made or refused.
bool add_beam_block(BuildContext& c, const Part& part, int index,
                    const std::vector<int>& elements) {
  const Section* section = c.section_of(part);
  const auto* card = section == nullptr ? nullptr : std::get_if<SectionBeam>(&section->law);
  if (card == nullptr || !bends(*card)) return false;
  const std::optional<BeamSection> beam = beam_section(c, part, *card);
  const std::optional<std::vector<Vec3>> planes = beam_planes(c, part, elements);
  if (beam && planes && c.problem_count == 0)
    c.model().blocks.push_back(make_beam_block(c.mesh(), index, elements, *beam, *planes));
  return true;
}

void add_line_block(BuildContext& c, const Part& part, int index, std::vector<int> elements) {
  if (add_beam_block(c, part, index, elements)) return;
  std::optional<LineProperties> properties = line_properties(c, part);
  if (!properties) return;
  if (part.is_averaged) properties->strands = strands_of(c.mesh(), elements);
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

int solid_formulation(const BuildContext& c, const Part& part) {
  const Section* section = c.section_of(part);
  const auto* card = section == nullptr ? nullptr : std::get_if<SectionSolid>(&section->law);
  return card == nullptr ? 1 : card->formulation;
}

/// The smallest Jacobian at the 2 x 2 x 2 points of a brick.
double least_jacobian(const Mesh& mesh, int element) {
  const std::span<const int> corners = mesh.corners(ElementKind::Hex8, element);
  std::array<std::array<Vec3, kHexPoints>, 3> tangent;
  for (int k = 0; k < 3; ++k) {
    Vec3 edge[4];
    for (int i = 0; i < 4; ++i) {
      const auto& [from, to] = hex_points::kEdge[k][i];
      edge[i] = 0.5 * (mesh.position[corners[to]] - mesh.position[corners[from]]);
    }
    hex_points::spread(edge);
    for (int i = 0; i < 4; ++i)
      for (int point : hex_points::kPair[k][i]) tangent[k][point] = edge[i];
  }
  double least = std::numeric_limits<double>::infinity();
  for (int q = 0; q < kHexPoints; ++q)
    least = std::min(least, tangent[0][q].cross(tangent[1][q]).dot(tangent[2][q]));
  return least;
}

bool has_sound_points(BuildContext& c, const Part& part, const std::vector<int>& elements) {
  for (int e : elements)
    if (const double least = least_jacobian(c.mesh(), e); !(least > 0)) {
      c.problem(part.source,
                fmt::format("*ELEMENT_SOLID {} of part {}",
                            c.mesh().table(ElementKind::Hex8).id[e].value, part.id.value),
                "a positive Jacobian at each of its eight points", fmt::format("{:.3g}", least),
                "formulation 1 needs a positive volume alone");
      return false;
    }
  return true;
}

/// Bricks of formulations 2, 3, -1 and -2 get eight points and a mean dilation, of 1 one point;
/// tetrahedra of 13 a pressure averaged at the nodes, of others their own.
void add_solid_block(BuildContext& c, const Part& part, int index, ElementKind kind,
                     std::vector<int> elements) {
  const std::optional<SolidLaw> law = solid_law(c, *c.material_of(part));
  if (!law) return;
  const int formulation = solid_formulation(c, part);
  const ElementControls controls = element_controls(c, part);
  const bool is_tet = kind == ElementKind::Tet4;
  const auto is_one_of = [&](std::initializer_list<int> known) {
    return std::find(known.begin(), known.end(), formulation) != known.end();
  };
  if (!is_one_of({-2, -1, 1, 2, 3, 10, 13, 15})) {
    c.problem(part.source, fmt::format("*SECTION_SOLID of part {}", part.id.value),
              "formulation 1, 2, 10 or 13", fmt::format("{}", formulation));
    return;
  }
  std::unique_ptr<ElementBlock> block;
  if (is_tet)
    block = make_tet4_block(c.mesh(), index, std::move(elements), *law, controls,
                            formulation == 13 ? TetPressure::NodalMean : TetPressure::Own);
  else if (is_one_of({-2, -1, 2, 3}) && !has_sound_points(c, part, elements))
    return;
  else if (is_one_of({-2, -1, 2, 3}))
    block = make_full_hex8_block(c.mesh(), index, std::move(elements), *law, controls);
  else
    block = make_hex8_block(c.mesh(), index, std::move(elements), *law, controls);
  const bool is_as_said = is_tet ? is_one_of({1, 2, 10, 13}) : is_one_of({1, 2});
  if (!is_as_said)
    c.note(fmt::format("part {}: solid formulation {} is computed as {}", part.id.value,
                       formulation,
                       is_tet                   ? "the four-node tetrahedron (10)"
                       : is_one_of({-2, -1, 3}) ? "the selective-reduced brick (2)"
                                                : "the one-point brick (1)"));
  c.model().blocks.push_back(std::move(block));
}

void add_part_blocks(BuildContext& c, int index) {
  const Part& part = c.deck.parts[index];
  for (ElementKind kind : kElementKinds) {
    std::vector<int> elements = elements_of(c.mesh().table(kind), index);
    if (elements.empty()) continue;
    if (const bool is_shell = kind == ElementKind::Quad4 || kind == ElementKind::Tri3;
        !is_shell && c.material_of(part) == nullptr) {
      c.problem(part.source, fmt::format("*PART_COMPOSITE {}", part.id.value), "shells alone",
                "other elements");
      continue;
    }
    const ElementControls controls = element_controls(c, part);
    if (kind == ElementKind::Line2) {
      add_line_block(c, part, index, std::move(elements));
    } else if (kind == ElementKind::Hex8 || kind == ElementKind::Tet4) {
      add_solid_block(c, part, index, kind, std::move(elements));
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
