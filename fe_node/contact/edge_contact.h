// Penalty contact between edges: free edges of shells, and beams, trusses and cables. Nodes against
// facets (penalty.h) miss two edges that cross between their nodes.
//
// A pair touches where its closest points are nearer than its two radii. The normal force runs
// along the line between them, so it has neither resultant nor moment. Friction acts across that
// distance d and comes with the couples that turn each edge about itself and the other:
// alpha e_1 x n + beta e_2 x n = -d n x f, carried by pairs of forces along n at the edges' ends.
// Slip is the velocity that is conjugate to all these forces, so a rigid rotation slips nothing.
// Two shells' edges touch only between their ends, where no node meets the other's facet; lines
// have no facets and touch with their ends too.
//
// Stiffness, cap, friction law and damping are those of penalty.h; so is what overlaps at the
// start. Near pairs come from the grid search (broad_phase.h), repeated when the motion since has
// used up the margin. Edges of failed elements are gone; edges that a failure lays open are not
// added.
#pragma once

#include "fe_node/contact/penalty.h"

namespace crosswalk::fe {

struct ContactEdge {
  std::array<int, 2> node{};
  double radius = 0;                      ///< m; half the thickness of a shell
  double stiffness = 0;                   ///< N/m, before scaling
  bool is_line = false;                   ///< a beam, truss or cable
  ElementKind kind = ElementKind::Quad4;  ///< of its element
  int element = 0;                        ///< in the mesh table of that kind
};

/// Edges of the surface's shells that belong to one facet only.
std::vector<ContactEdge> free_edges(const ContactSurface& surface);
/// The line elements of a part; the radius is that of a round section of `area`, m2.
std::vector<ContactEdge> line_edges(const Mesh& mesh, int part, double area, double bulk_modulus);

/// `second` empty: the edges among themselves; then a pair that shares a node, or whose nodes an
/// edge or a facet of `surface` joins, never touches.
std::unique_ptr<ContactInterface> make_edge_contact(std::string name,
                                                    std::vector<ContactEdge> first,
                                                    std::vector<ContactEdge> second,
                                                    const ContactSurface& surface,
                                                    const PenaltySettings& settings);

}  // namespace crosswalk::fe
