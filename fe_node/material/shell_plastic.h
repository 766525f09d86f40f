// Von Mises plasticity in plane stress: isotropic hardening by curve and rate, linear kinematic
// hardening, failure at an effective plastic strain.
//
// The return is exact [simo1986]: elasticity and the plane-stress projection share their
// eigenvectors, so the relative stress eta = sigma - alpha scales by 1 / (1 + (E/(3(1-nu)) + 2/3 H)
// g) on its mean part and by 1 / (1 + (2G + 2/3 H) g) on the others, and one scalar equation in the
// multiplier g is left: |eta|(g) = Y(p + 2/3 |eta| g). Transverse shears take part in yielding.
#pragma once

#include <algorithm>

#include "fe_node/material/hardening.h"
#include "fe_node/material/shell_law.h"

namespace crosswalk::fe {

struct ShellPlastic {
  double density = 0;
  double youngs_modulus = 0;
  double poisson_ratio = 0;
  YieldStress yield;
  double kinematic_modulus = 0;  ///< H, Pa; 0: isotropic
  double failure_strain = 0;     ///< effective plastic; 0: never

  /// History: plastic strain, alive, and with kinematic hardening the five back stresses.
  static constexpr int kPlasticStrain = 0;
  int history_size() const { return kinematic_modulus > 0 ? 7 : 2; }
  template <class N>
  void initialise(N* history) const {
    for (int i = 0; i < history_size(); ++i) history[i] = constant<N>(i == 1 ? 1 : 0);
  }

  template <class N>
  PlaneAnswer<N> update(const PlaneStep<N>& step, N* history) const;

 private:
  static constexpr int kIterations = 12;
  /// Of the yield stress.
  template <class N>
  static constexpr double kTolerance = std::max(1e-10, 8 * kRoundOff<N>);
};

/// Any lane with a >= b?
inline bool any_reaches(double a, double b) { return a >= b; }
template <class Real>
bool any_reaches(const LanesOf<Real>& a, const LanesOf<Real>& b) {
  return !all_positive(b - a);
}

/// Effective strain of an increment of plane stress that keeps its volume, sqrt(2/3 e:e).
template <class N>
N effective_increment(const PlaneTensor<N>& e) {
  return square_root(N((4.0 / 3.0) * (e.xx * e.xx + e.yy * e.yy + e.xx * e.yy +
                                      0.25 * (e.xy * e.xy + e.yz * e.yz + e.zx * e.zx))));
}

template <class N>
PlaneAnswer<N> ShellPlastic::update(const PlaneStep<N>& step, N* history) const {
  PlaneAnswer<N> answer = plane_elastic(youngs_modulus, poisson_ratio, step);
  PlaneTensor<N>& s = answer.stress;
  const double G = 0.5 * youngs_modulus / (1 + poisson_ratio);
  const bool is_kinematic = kinematic_modulus > 0;
  PlaneTensor<N> eta = s;
  if (is_kinematic)
    eta = {s.xx - history[2], s.yy - history[3], s.xy - history[4], s.yz - history[5],
           s.zx - history[6]};

  // |eta|^2 = (m/(1 + a g))^2 + d/(1 + b g)^2 as a von Mises stress
  const N mean = 0.5 * (eta.xx + eta.yy), half_difference = 0.5 * (eta.xx - eta.yy);
  const N mean2 = mean * mean;
  const N shear2 = 3.0 * (half_difference * half_difference + eta.xy * eta.xy + eta.yz * eta.yz +
                          eta.zx * eta.zx);
  const N p0 = history[kPlasticStrain];
  const N rate = step.dt > 0 && yield.has_rates()
                     ? N(effective_increment(step.strain) * (1 / step.dt))
                     : constant<N>(0);
  N Y, slope;
  yield.evaluate(p0, rate, Y, slope);
  const N trial = square_root(N(mean2 + shear2));
  N p = p0;
  if (any_reaches(trial, Y)) {
    const double a = youngs_modulus / (3 * (1 - poisson_ratio)) + 2.0 / 3.0 * kinematic_modulus;
    const double b = 2 * G + 2.0 / 3.0 * kinematic_modulus;
    const N is_plastic = where_less(Y, trial, constant<N>(1), constant<N>(0));
    N g = constant<N>(0), q = trial;
    for (int i = 0; i < kIterations; ++i) {
      const N ra = 1.0 / (1.0 + a * g), rb = 1.0 / (1.0 + b * g);
      const N ma = mean2 * ra * ra, sb = shear2 * rb * rb;
      q = square_root(N(ma + sb)) + kTiny<N>;
      p = p0 + (2.0 / 3.0) * g * q;
      yield.evaluate(p, rate, Y, slope);
      const N excess = is_plastic * (q - Y);
      if (!any_reaches(magnitude(excess), N(kTolerance<N> * Y))) break;
      const N q_slope = -(a * ma * ra + b * sb * rb) / q;
      const N residual_slope = q_slope - slope * (2.0 / 3.0) * (q + g * q_slope);
      // the root lies right of a convex start; the step never leaves g >= 0
      g = larger(N(g - excess / smaller(residual_slope, constant<N>(-kTiny<N>))), constant<N>(0));
    }
    const N ra = 1.0 / (1.0 + a * g), rb = 1.0 / (1.0 + b * g);
    const N hk = (2.0 / 3.0) * kinematic_modulus * g;
    const PlaneTensor<N> r{mean * ra + half_difference * rb, mean * ra - half_difference * rb,
                           eta.xy * rb, eta.yz * rb, eta.zx * rb};
    if (is_kinematic) {
      history[2] += hk * r.xx;
      history[3] += hk * r.yy;
      history[4] += hk * r.xy;
      history[5] += hk * r.yz;
      history[6] += hk * r.zx;
      s = {r.xx + history[2], r.yy + history[3], r.xy + history[4], r.yz + history[5],
           r.zx + history[6]};
    } else {
      s = r;
    }
    history[kPlasticStrain] = p;
    // plastic normal strain -g (r.xx + r.yy)/3, and the elastic one follows the released stress
    const double nu = poisson_ratio;
    const N plastic_sum = g * (r.xx + r.yy) * (1.0 / 3.0);
    answer.thinning =
        (-nu / (1 - nu)) * (step.strain.xx + step.strain.yy - plastic_sum) - plastic_sum;
  }
  if (failure_strain > 0) {
    history[1] = where_less(p, constant<N>(failure_strain), history[1], constant<N>(0));
    answer.alive = history[1];
    s = {s.xx * answer.alive, s.yy * answer.alive, s.xy * answer.alive, s.yz * answer.alive,
         s.zx * answer.alive};
  }
  return answer;
}

}  // namespace crosswalk::fe
