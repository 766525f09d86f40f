// J^(-1/3) without exponential and logarithm: nearly incompressible tissue has J close to one.
#pragma once

#include "fe_node/material/lanes.h"

namespace crosswalk::fe {

/// Newton steps on r^-3 = J from a parabola, r' = r (4 - J r^3) / 3. The parabola is right to
/// 1.5e-2 where |J - 1| < 0.25; the error e becomes 2 e^2, so three steps reach round-off.
template <class N>
N inverse_cube_root_near_one(const N& J) {
  const N e = J - 1.0;
  N r = 1.0 + e * ((2.0 / 9.0) * e - 1.0 / 3.0);
  for (int i = 0; i < 3; ++i) r = r * (4.0 - J * r * r * r) * (1.0 / 3.0);
  return r;
}

inline double inverse_cube_root(double J) { return 1.0 / std::cbrt(J); }
template <class Real>
LanesOf<Real> inverse_cube_root(const LanesOf<Real>& J) {
  constexpr double kNear = 0.25;
  if (all_positive(kNear - magnitude(J - 1.0))) return inverse_cube_root_near_one(J);
  return exponential((-1.0 / 3.0) * logarithm(J));
}

}  // namespace crosswalk::fe
