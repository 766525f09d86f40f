// Contact surfaces: facets of shells and of the outer faces of solids, with the thickness and the
// stiffness that contact needs.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fe_node/contact/segment.h"
#include "fe_node/mesh/mesh.h"
#include "fe_node/mesh/node_record.h"

namespace crosswalk::fe {

struct ContactFacet {
  std::array<int, 4> node{};  ///< outward side anticlockwise; a triangle repeats its last node
  double half_thickness = 0;  ///< m; of a shell, 0 on solids
  double stiffness = 0;       ///< N/m, penalty stiffness before scaling
  double depth_limit = 0;     ///< m; deeper nodes of solids are let go
  bool is_two_sided = false;  ///< shells
  ElementKind kind = ElementKind::Quad4;  ///< of the element it belongs to
  int element = 0;                        ///< in the mesh table of that kind
  int twin = -1;  ///< the same face seen from the neighbouring solid, which covers it; -1: none
  bool is_triangle() const { return node[3] == node[2]; }
};

struct ContactNode {
  int node = 0;
  double half_thickness = 0;  ///< m, largest of its shells
  double stiffness = 0;       ///< N/m, least of its facets
};

struct ContactSurface {
  std::vector<ContactFacet> facets;
  std::vector<ContactNode> nodes;  ///< rising

  static ContactSurface of_nodes(std::span<const int> nodes);
  /// Fills `nodes` from the facets.
  void collect_nodes();
};

/// What contact has to know of a part.
struct ContactPart {
  int part = 0;                       ///< index in the mesh
  double bulk_modulus = 0;            ///< Pa
  double thickness = 0;               ///< m, of shells
  std::vector<double> per_element{};  ///< m, per shell, quadrilaterals first; may be empty
};

/// Shells of the parts and the faces of their solids that no second solid of the parts shares; a
/// face covered by a shell of the parts with the same nodes is left to the shell. Stiffness K A^2/V
/// of solids and K A / longest diagonal of shells [hallquist2006, 26.6].
enum class InnerFaces {
  Left,  ///< the outer surface only
  Kept   ///< faces between two solids too, each with its twin, for surfaces that erode
};
ContactSurface surface_of(const Mesh& mesh, std::span<const ContactPart> parts,
                          InnerFaces inner = InnerFaces::Left);

inline FacetCorners corners_of(const ContactFacet& facet, std::span<const NodeRecord> nodes) {
  return {nodes[facet.node[0]].position(), nodes[facet.node[1]].position(),
          nodes[facet.node[2]].position(), nodes[facet.node[3]].position()};
}

}  // namespace crosswalk::fe
