// Two-node elastic beam with six resultants, co-rotational after Belytschko and Schwer
// [belytschko1977]: large displacements and rotations, small strains; shear by Timoshenko's factor.
//
// The axis runs through the nodes; axes s and t of the cross-section turn with the nodes. Each end
// keeps its own triad, turned by the node's angular velocity; the element's frame lies along the
// chord and halfway between the triads about it. Forces belong to the present deformations, not to
// their increments, so the element stores energy.
//
// Rotary inertia of a node is a scalar here: its mass times (L^2/12 + larger I / A), so that
// bending does not set the stable step [E: as of shells]. That changes only bending waves shorter
// than the element, but slows torsional waves by sqrt((L^2/12 + I/A) A / (I_s + I_t)): mesh finely
// where torsion is dynamic.
#pragma once

#include <memory>
#include <span>

#include "fe_node/element/element_block.h"

namespace crosswalk::fe {

struct BeamSection {
  double density = 0;                            ///< kg/m3
  double youngs_modulus = 0, shear_modulus = 0;  ///< Pa
  double area = 0;                               ///< m2
  double shear_area = 0;                         ///< m2; 0: no shear deformation
  double inertia_ss = 0, inertia_tt = 0;         ///< m4, bending about s and about t
  double torsion = 0;                            ///< m4
};
BeamSection rectangular_beam(double density, double youngs_modulus, double poisson_ratio,
                             double width_s, double width_t);
/// A tube; `inner` 0: a rod.
BeamSection tubular_beam(double density, double youngs_modulus, double poisson_ratio, double outer,
                         double inner);

/// `in_plane`: per element, a vector in the plane of the axis and s.
std::unique_ptr<ElementBlock> make_beam_block(const Mesh& mesh, int part, std::vector<int> elements,
                                              const BeamSection& section,
                                              std::span<const Vec3> in_plane);

}  // namespace crosswalk::fe
