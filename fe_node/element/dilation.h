// Elements that replace their own dilation by an averaged one against volumetric locking:
// Fbar = (Jbar / J)^(1/3) F goes to the material law, and the nodal forces are the exact gradient
// of the energy W(Fbar): with the Kirchhoff stress tau = P Fbar^T of the law and p = tr tau / (3
// Jbar), an element (or point) of volume V works with dev tau on its own F, and with p on its Jbar.
#pragma once

#include "fe_node/material/cube_root.h"
#include "fe_node/material/material.h"

namespace crosswalk::fe {

/// (Jbar / J)^(1/3) and its inverse.
template <class N>
struct Dilation {
  N scale, inverse;
};

/// `unevenness`: J / Jbar.
template <class N>
Dilation<N> dilation(const N& unevenness) {
  const N scale = inverse_cube_root(unevenness);
  return {scale, scale * scale * unevenness};
}

/// The step as the law sees it. `before` is the scale of the last step.
template <class N>
SolidStep<N> dilated_step(const Tensor<N>& F, const Tensor<N>& F_rate, const Tensor<N>& F_inverse,
                          const N& mean_J, const Dilation<N>& now, const N& before, double dt) {
  SolidStep<N> step;
  step.dt = dt;
  step.J = mean_J;
  const N change = (dt > 0 ? 1 / dt : 0) * (now.scale - before);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      step.F(i, j) = now.scale * F(i, j);
      step.F_rate(i, j) = change * F(i, j) + before * F_rate(i, j);
      step.F_inverse(i, j) = now.inverse * F_inverse(i, j);
    }
  return step;
}

/// Kirchhoff stress P F^T.
template <class N>
Symmetric<N> kirchhoff_stress(const Tensor<N>& P, const Tensor<N>& F) {
  auto entry = [&](int i, int j) -> N {
    return P(i, 0) * F(j, 0) + P(i, 1) * F(j, 1) + P(i, 2) * F(j, 2);
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

/// tau F^-T, the nominal stress of a Kirchhoff stress.
template <class N>
Tensor<N> pulled_back(const Symmetric<N>& tau, const Tensor<N>& F_inverse) {
  Tensor<N> P;
  for (int j = 0; j < 3; ++j) {
    const N &a = F_inverse(j, 0), &b = F_inverse(j, 1), &c = F_inverse(j, 2);
    P(0, j) = tau.xx * a + tau.xy * b + tau.zx * c;
    P(1, j) = tau.xy * a + tau.yy * b + tau.yz * c;
    P(2, j) = tau.zx * a + tau.yz * b + tau.zz * c;
  }
  return P;
}

template <class N>
void add_pressure(Symmetric<N>& tau, const N& p) {
  tau.xx += p;
  tau.yy += p;
  tau.zz += p;
}

/// F = sum x_I (grad N_I)^T.
template <class N, int kNodes>
Tensor<N> field_gradient(const N (&u)[kNodes][3], const N (&gradient)[kNodes][3]) {
  Tensor<N> out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      N sum = u[0][i] * gradient[0][j];
      for (int node = 1; node < kNodes; ++node) sum += u[node][i] * gradient[node][j];
      out(i, j) = sum;
    }
  return out;
}

/// tr(F_rate F^-1), the rate of volume change.
template <class N>
N expansion_rate(const Tensor<N>& F_rate, const Tensor<N>& F_inverse) {
  N sum = F_rate(0, 0) * F_inverse(0, 0);
  for (int k = 1; k < 9; ++k) sum += F_rate(k / 3, k % 3) * F_inverse(k % 3, k / 3);
  return sum;
}

}  // namespace crosswalk::fe
