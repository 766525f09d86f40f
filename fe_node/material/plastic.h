// Von Mises plasticity of solids at large strain: hardening by curve and rate, linear kinematic
// hardening, failure at an effective plastic strain.
//
// Hypoelastic in the rotated Cauchy stress with radial return [simo1998, 3.3]: s_trial = Q s Q^T +
// 2 G d dt, relative stress eta = s - alpha, |eta| = Y(p) + return 3 G + H. The mean stress is
// K ln J from the volume itself, so it neither drifts nor depends on the path.
#pragma once

#include "fe_node/material/hardening.h"
#include "fe_node/material/material.h"
#include "fe_node/material/shell_plastic.h"

namespace crosswalk::fe {

struct Plastic {
  double density = 0;
  double bulk = 0;   ///< Pa
  double shear = 0;  ///< Pa
  YieldStress yield;
  double kinematic_modulus = 0;  ///< H, Pa; 0: isotropic
  double failure_strain = 0;     ///< effective plastic; 0: never

  /// History: plastic strain, alive, deviatoric work, deviator (6), back stress (6) if kinematic.
  static constexpr int kPlasticStrain = 0, kAlive = 1;
  int history_size() const { return kinematic_modulus > 0 ? 15 : 9; }
  double shear_modulus() const { return shear; }
  double bulk_modulus() const { return bulk; }

  template <class N>
  void initialise(N* history) const {
    for (int i = 0; i < history_size(); ++i) history[i] = constant<N>(i == 1 ? 1 : 0);
  }

  template <class N>
  SolidAnswer<N> update(const SolidStep<N>& step, N* history) const;

 private:
  static constexpr int kIterations = 12;
  /// Of the yield stress.
  template <class N>
  static constexpr double kTolerance = std::max(1e-10, 8 * kRoundOff<N>);

  template <class N>
  static Symmetric<N> load(const N* h) {
    return {h[0], h[1], h[2], h[3], h[4], h[5]};
  }
  template <class N>
  static void store(const Symmetric<N>& a, N* h) {
    h[0] = a.xx, h[1] = a.yy, h[2] = a.zz, h[3] = a.xy, h[4] = a.yz, h[5] = a.zx;
  }
};

template <class N>
SolidAnswer<N> Plastic::update(const SolidStep<N>& step, N* history) const {
  const Tensor<N> L = velocity_gradient(step);
  Symmetric<N> d = rate_of_deformation(L);
  const N third = trace(d) * (1.0 / 3.0);
  d.xx -= third;
  d.yy -= third;
  d.zz -= third;
  const N one = constant<N>(1), two_G_dt = constant<N>(2 * shear * step.dt);
  const Symmetric<N> before = rotate_stress(load(history + 3), L, step.dt);
  d = rotate_stress(d, L, 0.5 * step.dt);  // from the middle of the step to its end
  Symmetric<N> s = combine(one, before, two_G_dt, d);
  Symmetric<N> back = zero<N>();
  if (kinematic_modulus > 0) back = rotate_stress(load(history + 9), L, step.dt);
  Symmetric<N> eta = combine(one, s, N(-one), back);

  const N trial = square_root(N(1.5 * contract(eta, eta)));
  const N rate = yield.has_rates() ? N(square_root(N((2.0 / 3.0) * contract(d, d)))) : third;
  const N p0 = history[kPlasticStrain];
  N Y, slope;
  yield.evaluate(p0, rate, Y, slope);
  N p = p0;
  if (any_reaches(trial, N(Y * (1 + kTolerance<N>)))) {
    const N is_plastic = where_less(Y, trial, one, constant<N>(0));
    const double elastic = 3 * shear + kinematic_modulus;
    N increment = constant<N>(0);
    for (int i = 0; i < kIterations; ++i) {
      const N excess = is_plastic * (trial - elastic * increment - Y);
      if (!any_reaches(magnitude(excess), N(kTolerance<N> * Y))) break;
      increment = larger(N(increment + excess / (elastic + slope)), constant<N>(0));
      p = p0 + increment;
      yield.evaluate(p, rate, Y, slope);
    }
    const N flow = 1.5 * increment / (trial + kTiny<N>);
    s = combine(one, s, N(-2 * shear * flow), eta);
    if (kinematic_modulus > 0)
      back = combine(one, back, N((2.0 / 3.0) * kinematic_modulus * flow), eta);
  }
  const N& J = step.J;
  const N log_J = logarithm(J);
  const N middle_J = J * (1.0 - 1.5 * step.dt * third);
  const Symmetric<N> mean = combine(N(0.5 * one), before, N(0.5 * one), s);
  history[2] += middle_J * step.dt * contract(mean, d) * history[1];
  history[kPlasticStrain] = p;
  if (failure_strain > 0)
    history[1] = where_less(p, constant<N>(failure_strain), history[1], constant<N>(0));
  store(s, history + 3);
  if (kinematic_modulus > 0) store(back, history + 9);

  SolidAnswer<N> answer;
  answer.alive = history[1];
  Symmetric<N> sigma = s;
  const N pressure = bulk * log_J;
  sigma.xx += pressure;
  sigma.yy += pressure;
  sigma.zz += pressure;
  for (N* c : {&sigma.xx, &sigma.yy, &sigma.zz, &sigma.xy, &sigma.yz, &sigma.zx})
    *c *= answer.alive;
  answer.P = nominal_stress(sigma, step);
  answer.energy = history[2] + bulk * entropy_gap(N(J - 1.0)) * answer.alive;
  answer.bulk_modulus = constant<N>(bulk);
  answer.shear_modulus = constant<N>(shear);
  return answer;
}

}  // namespace crosswalk::fe
