// Rubber-like laws with isochoric-volumetric split, U = K (J - 1 - ln J), and a Prony series on
// top:
//   Ogden   W = sum mu_i / alpha_i (l1^alpha_i + l2^alpha_i + l3^alpha_i - 3), l_k isochoric
//           principal stretches; G = 1/2 sum mu_i alpha_i [ogden1984]
//   Rubber  W = sum c_ij (I1 - 3)^i (I2 - 3)^j, isochoric invariants; c10 and c01 are
//   Mooney-Rivlin;
//           G = 2 (c10 + c01)
// These are the long-time responses; each Prony term adds an overstress that starts as a
// neo-Hooke stress of its modulus and relaxes (viscoelastic.h).
#pragma once

#include <array>

#include "fe_node/material/spectral.h"
#include "fe_node/material/viscoelastic.h"

namespace crosswalk::fe {

/// K from G and a Poisson ratio below one half.
inline double bulk_from_poisson(double shear_modulus, double poisson_ratio) {
  return 2 * shear_modulus * (1 + poisson_ratio) / (3 * (1 - 2 * poisson_ratio));
}

/// What both laws share: the overstress and the volume.
struct RubberBase {
  static constexpr bool kIsochoricShear = true;
  double density = 0;
  double bulk = 0;               ///< Pa
  Viscoelastic overstress = {};  ///< terms only; no long-term modulus, no bulk

  int history_size() const { return overstress.term_count > 0 ? overstress.history_size() : 0; }
  double bulk_modulus() const { return bulk; }
  template <class N>
  void initialise(N* history) const {
    for (int i = 0; i < history_size(); ++i) history[i] = constant<N>(0);
  }
  /// Adds volume and overstress to the isochoric P and W in `answer`.
  template <class N>
  void complete(const SolidStep<N>& step, N* history, const N& isochoric_shear,
                SolidAnswer<N>& answer) const {
    const N& J = step.J;
    const N pressure = bulk * (J - 1.0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) answer.P(i, j) += pressure * step.F_inverse(j, i);
    answer.energy += bulk * logarithm_gap(N(J - 1.0));
    answer.bulk_modulus = bulk / J;  // of the spatial acoustic tensor
    answer.shear_modulus = isochoric_shear;
    if (overstress.term_count == 0) return;
    const SolidAnswer<N> more = overstress.update(step, history);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) answer.P(i, j) += more.P(i, j);
    answer.energy += more.energy;
    answer.shear_modulus += more.shear_modulus;
  }
};

struct Ogden : RubberBase {
  static constexpr int kMaxTerms = 8;
  std::array<double, kMaxTerms> mu{};  ///< Pa
  std::array<double, kMaxTerms> alpha{};
  int term_count = 0;

  double shear_modulus() const {
    double sum = overstress.shear_modulus();
    for (int i = 0; i < term_count; ++i) sum += 0.5 * mu[i] * alpha[i];
    return sum;
  }

  template <class N>
  SolidAnswer<N> update(const SolidStep<N>& step, N* history) const {
    const Spectrum<N> C = spectrum(right_cauchy_green(step.F));
    const N log_J_third = logarithm(step.J) * (1.0 / 3.0);
    N log_stretch[3], tau[3];
    for (int k = 0; k < 3; ++k) {
      log_stretch[k] = 0.5 * logarithm(C.value[k]) - log_J_third;
      tau[k] = constant<N>(0);
    }
    SolidAnswer<N> answer;
    answer.energy = constant<N>(0);
    N shear = constant<N>(0);
    for (int i = 0; i < term_count; ++i) {
      N power[3];
      for (int k = 0; k < 3; ++k) power[k] = exponential(N(alpha[i] * log_stretch[k]));
      const N sum = power[0] + power[1] + power[2];
      for (int k = 0; k < 3; ++k) tau[k] += mu[i] * (power[k] - sum * (1.0 / 3.0));
      answer.energy += mu[i] / alpha[i] * (sum - 3.0);
      shear += 0.5 * std::abs(mu[i] * alpha[i]) * larger(power[0], larger(power[1], power[2]));
    }
    N second_piola[3];
    for (int k = 0; k < 3; ++k) second_piola[k] = tau[k] / C.value[k];
    answer.P = product(step.F, assemble(C, second_piola));
    complete(step, history, shear, answer);
    return answer;
  }
};

struct Rubber : RubberBase {
  double c10 = 0, c01 = 0, c11 = 0, c20 = 0, c02 = 0, c30 = 0;  ///< Pa

  double shear_modulus() const { return 2 * (c10 + c01) + overstress.shear_modulus(); }

  template <class N>
  SolidAnswer<N> update(const SolidStep<N>& step, N* history) const {
    const Symmetric<N> C = right_cauchy_green(step.F);
    const Symmetric<N> Ci = right_cauchy_green_inverse(step.F_inverse);
    const N scale = exponential(N((-2.0 / 3.0) * logarithm(step.J)));
    const N I1 = trace(C), I2 = 0.5 * (I1 * I1 - contract(C, C));
    const N a = scale * I1 - 3.0, b = scale * scale * I2 - 3.0;
    const N W1 = c10 + c11 * b + 2 * c20 * a + 3 * c30 * a * a;
    const N W2 = c01 + c11 * a + 2 * c02 * b;
    const N f = 2.0 * scale * W1 + 2.0 * scale * scale * W2 * I1;                  // of I
    const N g = -2.0 * scale * scale * W2;                                         // of C
    const N h = -(2.0 / 3.0) * (scale * W1 * I1 + 2.0 * scale * scale * W2 * I2);  // of C^-1
    const Symmetric<N> S{f + g * C.xx + h * Ci.xx, f + g * C.yy + h * Ci.yy,
                         f + g * C.zz + h * Ci.zz, g * C.xy + h * Ci.xy,
                         g * C.yz + h * Ci.yz,     g * C.zx + h * Ci.zx};
    SolidAnswer<N> answer;
    answer.P = product(step.F, S);
    answer.energy = c10 * a + c01 * b + c11 * a * b + c20 * a * a + c02 * b * b + c30 * a * a * a;
    // principal stretches squared are below I1: a bound of the tangent shear
    const N shear = 2.0 * (magnitude(W1) * larger(N(scale * I1 - 2.0), constant<N>(1)) +
                           magnitude(W2) * larger(N(scale * scale * I2 - 2.0), constant<N>(1)));
    complete(step, history, shear, answer);
    return answer;
  }
};

}  // namespace crosswalk::fe
