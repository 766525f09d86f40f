// Volumetric energy U = K/2 ((J^2 - 1) / 2 - ln J) [simo1985]: pressure K/2 (1/J - J), which
// follows -K ln J to second order and grows without bound when the volume is squeezed out, so that
// no finite force turns an element inside out.
#pragma once

#include <cmath>

#include "fe_node/material/lanes.h"

namespace crosswalk::fe {

/// (J^2 - 1) / 2 - ln J as a series about J = 1, right to 1e-13 of itself for |J - 1| < 0.01.
template <class N>
N volume_energy_near_one(const N& J) {
  const N e = J - 1.0;
  return e * e *
         (1.0 + e * (-1.0 / 3.0 + e * (0.25 + e * (-0.2 + e * (1.0 / 6.0 + e * (-1.0 / 7.0))))));
}

/// U / (K / 2); tissue that is nearly incompressible needs no logarithm.
inline constexpr double kNearOne = 0.01;
inline double volume_energy(double J) {
  return std::abs(J - 1) < kNearOne ? volume_energy_near_one(J) : 0.5 * (J * J - 1) - std::log(J);
}
template <class Real>
LanesOf<Real> volume_energy(const LanesOf<Real>& J) {
  if (all_positive(kNearOne - magnitude(J - 1.0))) return volume_energy_near_one(J);
  return 0.5 * (J * J - 1.0) - logarithm(J);
}

}  // namespace crosswalk::fe
