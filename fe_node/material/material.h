// The contract of a solid material law.
//
// Elements are total Lagrangian: they hand over the deformation gradient F = dx/dX with respect to
// the undeformed body, and its rate, and take back the first Piola-Kirchhoff stress P (force now
// per area then, P = J sigma F^-T). A law is a small value type of constants:
//
//   double density;                  kg/m3
//   int history_size() const;        numbers per element
//   double shear_modulus() const;    instantaneous, Pa; scales hourglass control
//   double bulk_modulus() const;     Pa
//   void initialise(N* history) const;                 the stress-free state
//   SolidAnswer<N> update(const SolidStep<N>& step, N* history) const;
//   Law for_step(double dt) const;   optional, see ready_law()
//
// N is Lanes or double. update() must be objective, must return zero stress for F = R, and with dt
// = 0 it returns the stress of the present state and leaves the history alone (that is how outputs
// are made). Hyperelastic and Prony laws work from F directly, with history in the undeformed
// frame. Rate laws (plasticity) use velocity_gradient(), rotate their stored Cauchy stress with
// rotate_stress() and return nominal_stress(). Kernels never throw and never allocate; a lane out
// of range returns NaN. tests/fe_node/material/law_suite.h runs one list of properties over every
// law.
#pragma once

#include "fe_node/material/tensor.h"

namespace crosswalk::fe {

template <class N>
struct SolidStep {
  Tensor<N> F;  ///< at the end of the step
  Tensor<N> F_inverse;
  N J;               ///< det F
  Tensor<N> F_rate;  ///< dF/dt at the middle of the step, 1/s
  double dt = 0;     ///< s
};

template <class N>
struct SolidAnswer {
  Tensor<N> P;  ///< first Piola-Kirchhoff stress, Pa
  N energy;     ///< work done on the material so far, J per undeformed m3
  /// Upper bounds of the present moduli, Pa: they give the stable step.
  N bulk_modulus;
  N shear_modulus;
  N alive = constant<N>(1);  ///< 0 once failed: the element then carries nothing
};

/// Brain, CSF: matter that gives way to shear a thousand times more than to pressure. What floats
/// in such matter weighs next to nothing there, so a little mass more decides how it moves.
template <class Law>
bool is_near_fluid(const Law& law) {
  return law.shear_modulus() < 1e-3 * law.bulk_modulus();
}

/// L at the middle of the step, F_rate (F - dt/2 F_rate)^-1: exactly skew under a finite rigid
/// rotation.
template <class N>
Tensor<N> velocity_gradient(const SolidStep<N>& step) {
  Tensor<N> middle;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) middle(i, j) = step.F(i, j) - 0.5 * step.dt * step.F_rate(i, j);
  return product(step.F_rate, inverse(middle, determinant(middle)));
}

/// E_{n+1} - E_n = dt sym(F_middle^T F_rate), exact for the step's straight path.
template <class N>
Symmetric<N> green_lagrange_increment(const SolidStep<N>& step) {
  Tensor<N> M;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) M(i, j) = step.F(i, j) - 0.5 * step.dt * step.F_rate(i, j);
  const Tensor<N>& R = step.F_rate;
  const double half = 0.5 * step.dt;
  auto entry = [&](int i, int j) -> N {
    return half * (M(0, i) * R(0, j) + M(1, i) * R(1, j) + M(2, i) * R(2, j) + M(0, j) * R(0, i) +
                   M(1, j) * R(1, i) + M(2, j) * R(2, i));
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

/// The law made ready for steps of `dt` where it has something to prepare, else itself.
template <class Law>
decltype(auto) ready_law(const Law& law, double dt) {
  if constexpr (requires { law.for_step(dt); })
    return law.for_step(dt);
  else
    return (law);
}

/// Rate of deformation, the symmetric part of L.
template <class N>
Symmetric<N> rate_of_deformation(const Tensor<N>& L) {
  return {L(0, 0),
          L(1, 1),
          L(2, 2),
          0.5 * (L(0, 1) + L(1, 0)),
          0.5 * (L(1, 2) + L(2, 1)),
          0.5 * (L(2, 0) + L(0, 2))};
}

/// Q sigma Q^T with Q = (I - dt/2 W)^-1 (I + dt/2 W), W the spin: the finite rotation of Hughes and
/// Winget (1980), exact for rigid motion.
template <class N>
Symmetric<N> rotate_stress(const Symmetric<N>& sigma, const Tensor<N>& L, double dt) {
  // w = dt/2 axial vector of the spin; Q = I + 2 (w~ + w~ w~) / (1 + w.w).
  const N wx = 0.25 * dt * (L(2, 1) - L(1, 2)), wy = 0.25 * dt * (L(0, 2) - L(2, 0)),
          wz = 0.25 * dt * (L(1, 0) - L(0, 1));
  const N s = 2.0 / (1.0 + wx * wx + wy * wy + wz * wz);
  Tensor<N> Q;
  Q(0, 0) = 1.0 - s * (wy * wy + wz * wz);
  Q(1, 1) = 1.0 - s * (wx * wx + wz * wz);
  Q(2, 2) = 1.0 - s * (wx * wx + wy * wy);
  Q(0, 1) = s * (wx * wy - wz);
  Q(1, 0) = s * (wx * wy + wz);
  Q(0, 2) = s * (wx * wz + wy);
  Q(2, 0) = s * (wx * wz - wy);
  Q(1, 2) = s * (wy * wz - wx);
  Q(2, 1) = s * (wy * wz + wx);
  const Tensor<N> A = product(Q, sigma);
  auto entry = [&](int i, int j) -> N {
    return A(i, 0) * Q(j, 0) + A(i, 1) * Q(j, 1) + A(i, 2) * Q(j, 2);
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

/// P = J sigma F^-T.
template <class N>
Tensor<N> nominal_stress(const Symmetric<N>& sigma, const SolidStep<N>& step) {
  Tensor<N> P;
  for (int j = 0; j < 3; ++j) {
    const N a = step.J * step.F_inverse(j, 0), b = step.J * step.F_inverse(j, 1),
            c = step.J * step.F_inverse(j, 2);
    P(0, j) = sigma.xx * a + sigma.xy * b + sigma.zx * c;
    P(1, j) = sigma.xy * a + sigma.yy * b + sigma.yz * c;
    P(2, j) = sigma.zx * a + sigma.yz * b + sigma.zz * c;
  }
  return P;
}

/// sigma = P F^T / J.
template <class N>
Symmetric<N> cauchy_stress(const Tensor<N>& P, const Tensor<N>& F, const N& J) {
  const N s = 1.0 / J;
  auto entry = [&](int i, int j) -> N {
    return s * (P(i, 0) * F(j, 0) + P(i, 1) * F(j, 1) + P(i, 2) * F(j, 2));
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

}  // namespace crosswalk::fe
