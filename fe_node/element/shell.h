// Shells with points through the thickness: quadrilaterals of one point in the plane
// (Belytschko-Tsay, shell_kernel.h) or of 2 x 2 (shell_full_kernel.h), the C0 triangle, and their
// membranes (no bending, nodes without rotations). Co-rotational, updated geometry, any finite
// motion. The section says which.
//
// Rotary inertia per mass is (A + t^2)/12 instead of t^2/12 alone, so that the transverse shear
// does not set the stable step; it changes only waves shorter than the element. One-point shells
// have no drilling stiffness (an explicit step needs none), the others a trace of it
// (shell_full.h).
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
