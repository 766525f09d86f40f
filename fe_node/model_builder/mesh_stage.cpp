// Nodes, elements, parts and node sets; nodes in Hilbert order, elements by their first node.
#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "fe_node/element/hex8.h"
#include "fe_node/element/tet4.h"
#include "fe_node/mesh/node_order.h"
#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

void add_nodes(BuildContext& c) {
  std::vector<Vec3> points;
  points.reserve(c.deck.nodes.size());
  for (const DeckNode& n : c.deck.nodes) points.push_back(c.units.length * n.position);
  std::vector<int> order = hilbert_order(points);
  if (const int last = c.options.last_nodes_from; last > 0)
    std::stable_partition(order.begin(), order.end(),
                          [&](int n) { return c.deck.nodes[n].id.value < last; });
  for (int n : order) {
    const DeckNode& node = c.deck.nodes[n];
    if (!points[n].allFinite())
      c.problem(node.source, fmt::format("*NODE {}", node.id.value), "finite coordinates", "none");
    if (!c.node_index.emplace(node.id, c.mesh().node_count()).second)
      c.problem(node.source, fmt::format("*NODE {}", node.id.value), "an id used once",
                "a second node of that id");
    c.mesh().position.push_back(points[n]);
    c.mesh().node_id.push_back(node.id);
  }
}

void add_parts(BuildContext& c) {
  for (const Part& part : c.deck.parts) {
    const Material* material = c.material_of(part);
    MeshPart mesh_part{part.id, part.title, false};
    mesh_part.name.erase(mesh_part.name.find_last_not_of(" \t") + 1);
    if (part.composite.has_value()) {
      // its layers name the materials
    } else if (material == nullptr) {
      c.problem(part.source, fmt::format("*PART {}", part.id.value), "a material of the deck",
                std::to_string(part.material.value));
    } else {
      mesh_part.is_rigid = std::holds_alternative<mat::Rigid>(material->law);
    }
    if (!c.part_index.emplace(part.id, static_cast<int>(c.mesh().parts.size())).second)
      c.problem(part.source, fmt::format("*PART {}", part.id.value), "an id used once",
                "a second part of that id");
    c.mesh().parts.push_back(mesh_part);
  }
}

/// Appends one element; false and a problem when its part or a node is missing.
bool add_element(BuildContext& c, ElementKind kind, DeckId id, DeckId part,
                 std::span<const DeckId> nodes, Source source, const char* keyword) {
  const std::string who = fmt::format("{} {}", keyword, id.value);
  const auto found = c.part_index.find(part);
  if (found == c.part_index.end()) {
    c.problem(source, who, "a part of the deck", std::to_string(part.value));
    return false;
  }
  std::vector<int> corners;
  for (DeckId n : nodes) corners.push_back(c.node(n, source, who));
  if (std::find(corners.begin(), corners.end(), -1) != corners.end()) return false;
  ElementTable& table = c.mesh().table(kind);
  table.nodes.insert(table.nodes.end(), corners.begin(), corners.end());
  table.part.push_back(found->second);
  table.id.push_back(id);
  return true;
}

/// Nodes of the brick that a wedge or pyramid collapses from, in *ELEMENT_SOLID order.
std::array<DeckId, 8> brick_nodes(const ShapedSolid& shape) {
  const auto& n = shape.nodes;
  if (shape.shape == SolidShape::Penta6) return {n[0], n[1], n[2], n[2], n[3], n[4], n[5], n[5]};
  if (shape.shape == SolidShape::Pyramid5) return {n[0], n[1], n[2], n[3], n[4], n[4], n[4], n[4]};
  return {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]};
}

double volume_of_last(const Mesh& mesh, ElementKind kind) {
  const std::span<const int> corners = mesh.corners(kind, mesh.table(kind).size() - 1);
  Vec3 x[8];
  for (std::size_t k = 0; k < corners.size(); ++k) x[k] = mesh.position[corners[k]];
  return kind == ElementKind::Tet4 ? tet4_volume(x[0], x[1], x[2], x[3]) : hex8_volume(x);
}

void add_solids(BuildContext& c) {
  for (const SolidElement& solid : c.deck.solids) {
    const ShapedSolid shape = solid_shape(solid);
    const std::string who = fmt::format("*ELEMENT_SOLID {}", solid.id.value);
    if (shape.shape == SolidShape::Other || shape.shape == SolidShape::Tet10) {
      c.problem(solid.source, who, "a brick, wedge, pyramid or four-node tetrahedron",
                solid_shape_name(shape.shape));
      continue;
    }
    const bool is_tet = shape.shape == SolidShape::Tet4;
    const ElementKind kind = is_tet ? ElementKind::Tet4 : ElementKind::Hex8;
    const std::array<DeckId, 8> brick = brick_nodes(shape);
    if (!add_element(
            c, kind, solid.id, solid.part,
            is_tet ? std::span<const DeckId>(shape.nodes).first(4) : std::span<const DeckId>(brick),
            solid.source, "*ELEMENT_SOLID"))
      continue;
    const double volume = volume_of_last(c.mesh(), kind);
    if (!(volume > 0))
      c.problem(solid.source, who, "a positive volume", fmt::format("{:.3g} m3", volume),
                "is its node order inside out?");
  }
}

void add_shells(BuildContext& c) {
  for (const ShellElement& shell : c.deck.shells) {
    const bool triangle = is_triangle(shell);
    double sum = 0;
    for (int k = 0; k < (triangle ? 3 : 4); ++k) sum += shell.thickness[k];
    if (sum > 0) c.shell_thickness[shell.id] = sum / (triangle ? 3 : 4) * c.units.length;
    add_element(c, triangle ? ElementKind::Tri3 : ElementKind::Quad4, shell.id, shell.part,
                std::span<const DeckId>(shell.nodes).first(triangle ? 3 : 4), shell.source,
                "*ELEMENT_SHELL");
  }
}

/// A spring to ground ends on a node of its own at the same place.
DeckId ground_node(BuildContext& c, DeckId free_end, DeckId element) {
  const DeckId id(-element.value);
  const auto found = c.node_index.find(free_end);
  if (found == c.node_index.end()) return free_end;  // reported with the element
  if (c.node_index.emplace(id, c.mesh().node_count()).second) {
    c.mesh().position.push_back(c.mesh().position[found->second]);
    c.mesh().node_id.push_back(id);
  }
  return id;
}

void add_lines(BuildContext& c) {
  for (const BeamElement& beam : c.deck.beams)
    add_element(c, ElementKind::Line2, beam.id, beam.part,
                std::span<const DeckId>(beam.nodes).first(2), beam.source, "*ELEMENT_BEAM");
  for (const DiscreteElement& spring : c.deck.discretes) {
    std::array<DeckId, 2> ends = spring.nodes;
    if (!ends[1].given()) ends[1] = ground_node(c, ends[0], spring.id);
    if (spring.orientation.given())
      c.problem(spring.source, fmt::format("*ELEMENT_DISCRETE {}", spring.id.value),
                "a spring along its nodes (VID 0)", std::to_string(spring.orientation.value));
    add_element(c, ElementKind::Line2, spring.id, spring.part, ends, spring.source,
                "*ELEMENT_DISCRETE");
  }
  for (const SeatbeltElement& belt : c.deck.seatbelts)
    add_element(c, ElementKind::Line2, belt.id, belt.part, belt.nodes, belt.source,
                "*ELEMENT_SEATBELT");
}

void sort_elements(Mesh& mesh) {
  for (ElementKind kind : kElementKinds) {
    ElementTable& table = mesh.table(kind);
    if (kind == ElementKind::Line2) continue;  // strands follow the order of the deck
    const int count = corner_count(kind);
    std::vector<int> order(table.size()), first(table.size());
    std::iota(order.begin(), order.end(), 0);
    for (int e = 0; e < table.size(); ++e) {
      const std::span<const int> corners = mesh.corners(kind, e);
      first[e] = *std::min_element(corners.begin(), corners.end());
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return first[a] < first[b]; });
    ElementTable sorted;
    for (int e : order) {
      sorted.nodes.insert(sorted.nodes.end(), table.nodes.begin() + e * count,
                          table.nodes.begin() + (e + 1) * count);
      sorted.part.push_back(table.part[e]);
      sorted.id.push_back(table.id[e]);
    }
    table = std::move(sorted);
  }
}

}  // namespace

void build_mesh(BuildContext& c) {
  add_parts(c);
  add_nodes(c);
  add_solids(c);
  add_shells(c);
  add_lines(c);
  for (const ThickShellElement& shell : c.deck.thick_shells) {
    c.problem(shell.source, fmt::format("*ELEMENT_TSHELL {}", shell.id.value),
              "solids or thin shells", "a thick shell");
    break;
  }
  sort_elements(c.mesh());
  for (const DeckSet& set : c.deck.sets) {
    std::string title = set.title;
    title.erase(title.find_last_not_of(" \t") + 1);
    if (set.kind == SetKind::Node)
      c.mesh().node_sets.push_back({set.id, title, c.node_set(set.id, set.source)});
    if (set.kind == SetKind::Part)
      c.built.part_sets.emplace_back(title, c.part_set(set.id, set.source));
  }
}

}  // namespace crosswalk::fe
