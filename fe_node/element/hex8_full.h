// Hexahedron with 2 x 2 x 2 points for the shape and one mean dilation for the volume (selective
// reduced integration, "F-bar" in the mean-dilation form of [simo1985]), total Lagrangian.
//
// Every point sees Fbar = (Jbar / J)^(1/3) F, Jbar the volume mean of J; forces are the gradient of
// the sum of W(Fbar), see dilation.h. No hourglass modes and no volumetric locking; eight visits of
// the law per step.
//
// A law whose shear is isochoric (kIsochoricShear) would leave the points' dilation free as long as
// its mean holds, and compressed tissue crumple within a layer of cells. Such a law resists J /
// Jbar at each point with the volumetric energy of volume_law.h and the bulk modulus that goes with
// its G at a Poisson's ratio of 0.45: enough against that, too little to lock.
//
// An element fails when its first point does. Wedges and pyramids are hexahedra with repeated
// nodes. Local node order as in *ELEMENT_SOLID.
#pragma once

#include <memory>

#include "fe_node/element/element_block.h"
#include "fe_node/element/element_controls.h"
#include "fe_node/material/solid_law.h"

namespace crosswalk::fe {

std::unique_ptr<ElementBlock> make_full_hex8_block(const Mesh& mesh, int part,
                                                   std::vector<int> elements, const SolidLaw& law,
                                                   const ElementControls& controls);

}  // namespace crosswalk::fe
