// Sheet that carries tension only (skin, ligament sheets, fabric): elastic plane stress of which
// the principal compressions are dropped. In total strain, so that a wrinkle closes where it
// opened; wrinkled states after the mixed criterion [roddeman1987]: slack if the larger principal
// strain is negative, uniaxial if the smaller principal stress would be.
#pragma once

#include "fe_node/material/shell_law.h"

namespace crosswalk::fe {

struct ShellTensionSheet {
  double density = 0;
  double youngs_modulus = 0;
  double poisson_ratio = 0;

  /// History: strain xx yy xy.
  int history_size() const { return 3; }
  template <class N>
  void initialise(N* history) const {
    for (int i = 0; i < 3; ++i) history[i] = constant<N>(0);
  }

  template <class N>
  PlaneAnswer<N> update(const PlaneStep<N>& step, N* e) const {
    const N zero = constant<N>(0);
    PlaneAnswer<N> answer = plane_elastic(youngs_modulus, poisson_ratio, step);
    e[0] += step.strain.xx;
    e[1] += step.strain.yy;
    e[2] += step.strain.xy;
    const N mean = 0.5 * (e[0] + e[1]), half = 0.5 * (e[0] - e[1]), shear = 0.5 * e[2];
    const N radius = square_root(N(half * half + shear * shear)) + kTiny<N>;
    const N e1 = mean + radius, e2 = mean - radius;
    const double plane = youngs_modulus / (1 - poisson_ratio * poisson_ratio);
    const N uniaxial = larger(N(youngs_modulus * e1), zero);
    const N s2_full = plane * (e2 + poisson_ratio * e1);
    const N s1 = where_less(zero, s2_full, N(plane * (e1 + poisson_ratio * e2)), uniaxial);
    const N s2 = larger(s2_full, zero);
    const N m = 0.5 * (s1 + s2), h = 0.5 * (s1 - s2) / radius;
    answer.stress.xx = m + h * half;
    answer.stress.yy = m - h * half;
    answer.stress.xy = h * shear;
    return answer;
  }
};

}  // namespace crosswalk::fe
