// What the block of shells (shell.cpp) asks of an element, one-point (shell_one_point.h) or fully
// integrated (shell_full.h): its answer to the motion of one step and a bound of its stiffness.
#pragma once

#include "fe_node/element/element_controls.h"
#include "fe_node/element/section_integral.h"

namespace crosswalk::fe {

/// A section with the numerical controls and the moduli that bound its stiffness.
struct ShellMatter {
  ShellSection section;
  ElementControls controls;
  double density = 0;              ///< kg/m3, mean
  double youngs = 0, poisson = 0;  ///< of the stiffest layer
  double mean_youngs = 0;          ///< over the thickness
  double off_middle = 0;           ///< of the nodes, in units of the thickness

  ShellMatter(const ShellSection& section, const ElementControls& controls);
  bool is_bending() const { return section.theory == ShellTheory::Bending; }
};

/// The motion of a step: geometry at its middle and end, velocities and spins in the local frame of
/// the middle.
template <class N, int kCorners>
struct ShellMotion {
  ShellShape<N, kCorners> middle, end;
  Lanes3<N> v[kCorners], spin[kCorners];
  N thickness, mass;
  double dt = 0;
};

/// Loads of the corners in local axes of the end of the step.
template <class N, int kCorners>
struct ShellAnswer {
  Lanes3<N> force[kCorners], moment[kCorners];
  N work = constant<N>(0);        ///< J, of this step on the material
  N thinning = constant<N>(0);    ///< mean normal strain increment
  N alive = constant<N>(1);       ///< 0 when the element has failed
  N stored = constant<N>(0);      ///< J, change of the energy of stiffness hourglass control
  N dissipated = constant<N>(0);  ///< J, by hourglass control in this step
};

/// Bounds of omega^2 m / (n A t), n corners: the membrane's lambda' tr g + 2 mu g_max with lambda'
/// = E nu / (1 - nu^2); the same times t^2 / (12 gyration) for bending; and kappa G times the
/// larger eigenvalue of the shear rows for shear. Where the nodes lie off the middle by e the
/// membrane's is for both at once, times the larger eigenvalue of (1, e / r; e / r, (t^2 / 12 +
/// e^2) / r^2), r^2 the gyration.
template <class N>
struct ShellBounds {
  N membrane, bending, shear;
};

template <class N, int kCorners>
ShellBounds<N> shell_bounds(const ShellMatter& matter, const ShellShape<N, kCorners>& shape,
                            const N& thickness, const N& gyration) {
  N largest, trace;
  gradient_metric(shape, largest, trace);
  const double E = matter.youngs, nu = matter.poisson;
  const double two_mu = E / (1 + nu), lambda = E * nu / (1 - nu * nu);
  ShellBounds<N> bounds;
  bounds.membrane = lambda * trace + two_mu * largest;
  bounds.bending = bounds.shear = constant<N>(0);
  if (!matter.is_bending()) return bounds;
  const N relative = thickness * thickness / gyration;
  bounds.bending = bounds.membrane * relative * (1.0 / 12);
  if (matter.off_middle != 0) {
    const N off2 = matter.off_middle * matter.off_middle * relative;
    bounds.membrane *=
        larger_eigenvalue(constant<N>(1), relative * (1.0 / 12) + off2, square_root(off2));
  }
  bounds.shear = (0.5 * two_mu * matter.section.shear_factor) * shear_metric(shape, gyration);
  return bounds;
}

template <class N>
SectionVector<N> increment_of(SectionVector<N> rate, double dt, bool is_bending) {
  for (N* r : {&rate.xx, &rate.yy, &rate.xy, &rate.kxx, &rate.kyy, &rate.kxy, &rate.yz, &rate.zx})
    *r *= dt;
  if (!is_bending) rate.yz = rate.zx = constant<N>(0);
  return rate;
}

}  // namespace crosswalk::fe
