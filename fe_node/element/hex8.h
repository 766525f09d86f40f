// One-point hexahedron with mean gradients and hourglass control after Flanagan and Belytschko
// [flanagan1981], total Lagrangian.
//
// F = sum x_I (grad N_I)^T with the volume mean of the undeformed gradients, so the constant-stress
// patch test holds on any mesh; nodal forces are P B_I V, conservative for a hyperelastic law.
// Hourglass coordinates q_a = h_a.x - F (h_a.X) vanish for every linear field and turn with the
// body, so stiffness control stores exactly 1/2 k |q|^2 / 8 and resists no rigid rotation.
// Wedges and pyramids are hexahedra with repeated nodes. Local node order as in *ELEMENT_SOLID.
#pragma once

#include <memory>

#include "fe_node/element/element_block.h"
#include "fe_node/element/element_controls.h"
#include "fe_node/material/solid_law.h"

namespace crosswalk::fe {

std::unique_ptr<ElementBlock> make_hex8_block(const Mesh& mesh, int part, std::vector<int> elements,
                                              const SolidLaw& law, const ElementControls& controls);

/// Exact volume of a trilinear hexahedron; negative when its nodes are numbered inside out.
double hex8_volume(const Vec3 (&x)[8]);
/// dV/dx_I, the volume times the mean of grad N_I.
void hex8_volume_gradient(const Vec3 (&x)[8], Vec3 (&gradient)[8]);

}  // namespace crosswalk::fe
