// Four-node tetrahedron, constant strain, total Lagrangian; its pressure either its own (it then
// locks when nearly incompressible) or averaged over the nodes.
//
// Nodal averaging after Bonet and Burton [bonet1998], made consistent for any law: a node's
// dilation is the volume-weighted mean of its elements', an element's Jbar the mean of its four
// nodes'; the law sees Fbar = (Jbar/J)^(1/3) F, and the pressures go back the same way: averaged to
// the nodes, then to the elements. That is the exact gradient of sum V W(Fbar), so energy is kept,
// and both averages contract, so the plain element's stable step bounds this one's. Averages stay
// within the block, that is the part. Elements that have failed take no part in them.
#pragma once

#include <memory>

#include "fe_node/element/element_block.h"
#include "fe_node/element/element_controls.h"
#include "fe_node/material/solid_law.h"

namespace crosswalk::fe {

enum class TetPressure { Own, NodalMean };

std::unique_ptr<ElementBlock> make_tet4_block(const Mesh& mesh, int part, std::vector<int> elements,
                                              const SolidLaw& law, const ElementControls& controls,
                                              TetPressure pressure);

/// Signed: negative when the nodes are numbered inside out.
double tet4_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace crosswalk::fe
