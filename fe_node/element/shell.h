// One-point shells with points through the thickness: the Belytschko-Tsay quadrilateral and a C0
// triangle, and their membranes (no bending, nodes without rotations). Co-rotational, updated
// geometry, any finite motion; theory in shell_kernel.h.
//
// Hourglass control of the quadrilateral after [belytschko1984]: stiffness form k_m = r E t A b.b/8
// (membrane), k_b = r E t^3 A b.b/192 (bending), k_w = r kappa G t^3 b.b/12 (warping), or the
// viscous form c_m = q rho t sqrt(A) c/4, c_b = c_m t^2/12, c_w = c_m t^2 b.b/12.
//
// Rotary inertia per mass is (A + t^2)/12 instead of t^2/12 alone, so that the transverse shear
// does not set the stable step; it changes only waves shorter than the element. No drilling
// stiffness: an explicit step needs none.
#pragma once

#include <memory>
#include <span>

#include "fe_node/element/element_block.h"
#include "fe_node/element/element_controls.h"
#include "fe_node/element/shell_section.h"

namespace crosswalk::fe {

/// Quad4 or Tri3 elements of a part. `thickness` gives each element its own, m; empty: the
/// section's.
std::unique_ptr<ElementBlock> make_shell_block(const Mesh& mesh, ElementKind kind, int part,
                                               std::vector<int> elements,
                                               const ShellSection& section,
                                               const ElementControls& controls,
                                               std::span<const double> thickness = {});

}  // namespace crosswalk::fe
