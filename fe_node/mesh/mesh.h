// The mesh: reference positions, connectivity by element kind, parts, node sets, and the user's
// ids. Immutable once built; frame of the deck until placed, SI. All indices are plain ints counted
// from 0; numbers typed by the user are DeckId and never mix with them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/spatial.h"
#include "fe_node/deck/deck_id.h"

namespace crosswalk::fe {

enum class ElementKind { Hex8, Tet4, Tet10, Quad4, Tri3, Line2 };
inline constexpr std::array<ElementKind, 6> kElementKinds{ElementKind::Hex8,  ElementKind::Tet4,
                                                          ElementKind::Tet10, ElementKind::Quad4,
                                                          ElementKind::Tri3,  ElementKind::Line2};

int corner_count(ElementKind kind);
std::string_view name(ElementKind kind);

/// All elements of one kind. Wedges and pyramids are hexahedra with repeated nodes.
struct ElementTable {
  std::vector<int> nodes;  ///< corner_count per element
  std::vector<int> part;   ///< index into Mesh::parts
  std::vector<DeckId> id;
  int size() const { return static_cast<int>(part.size()); }
};

struct MeshPart {
  DeckId id;
  std::string name;
  bool is_rigid = false;
};

struct NodeGroup {
  DeckId id;
  std::string name;
  std::vector<int> nodes;  ///< rising
};

struct Mesh {
  std::vector<Vec3> position;  ///< undeformed, m
  std::vector<DeckId> node_id;
  std::array<ElementTable, kElementKinds.size()> elements;  ///< indexed by ElementKind
  std::vector<MeshPart> parts;
  std::vector<NodeGroup> node_sets;

  int node_count() const { return static_cast<int>(position.size()); }
  const ElementTable& table(ElementKind kind) const {
    return elements[static_cast<std::size_t>(kind)];
  }
  ElementTable& table(ElementKind kind) { return elements[static_cast<std::size_t>(kind)]; }
  std::span<const int> corners(ElementKind kind, int element) const;
  /// Index of the set of that name, or -1.
  int find_node_set(std::string_view name) const;
};

}  // namespace crosswalk::fe
