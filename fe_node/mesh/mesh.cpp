#include "fe_node/mesh/mesh.h"

namespace crosswalk::fe {

int corner_count(ElementKind kind) {
  switch (kind) {
    case ElementKind::Hex8:
      return 8;
    case ElementKind::Tet4:
      return 4;
    case ElementKind::Tet10:
      return 10;
    case ElementKind::Quad4:
      return 4;
    case ElementKind::Tri3:
      return 3;
    case ElementKind::Line2:
      return 2;
  }
  return 0;
}

std::string_view name(ElementKind kind) {
  switch (kind) {
    case ElementKind::Hex8:
      return "hex8";
    case ElementKind::Tet4:
      return "tet4";
    case ElementKind::Tet10:
      return "tet10";
    case ElementKind::Quad4:
      return "quad4";
    case ElementKind::Tri3:
      return "tri3";
    case ElementKind::Line2:
      return "line2";
  }
  return "";
}

std::span<const int> Mesh::corners(ElementKind kind, int element) const {
  const int count = corner_count(kind);
  return std::span<const int>(table(kind).nodes)
      .subspan(static_cast<std::size_t>(element) * count, count);
}

int Mesh::find_node_set(std::string_view wanted) const {
  for (int i = 0; i < static_cast<int>(node_sets.size()); ++i)
    if (node_sets[i].name == wanted) return i;
  return -1;
}

}  // namespace crosswalk::fe
