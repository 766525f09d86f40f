// Finite linear viscoelasticity with a Prony series in shear and an elastic bulk response,
//   G(t) = G_inf + sum G_i exp(-beta_i t),
// in the total form of [simo1987]: the instantaneous response is the isochoric neo-Hooke law with
// G_0 = G_inf + sum G_i, and each term relaxes a stress-like internal variable kept in the
// undeformed frame, so a rigid rotation leaves it untouched. The series is the deviatoric law of
// *MAT_VISCOELASTIC and *MAT_KELVIN-MAXWELL for small strain; pressure as in volume_law.h.
#pragma once

#include <array>

#include "fe_node/material/cube_root.h"
#include "fe_node/material/material.h"
#include "fe_node/material/volume_law.h"

namespace crosswalk::fe {

struct Viscoelastic {
  static constexpr bool kIsochoricShear = true;
  static constexpr int kMaxTerms = 12;
  struct Term {
    double shear_modulus = 0;  ///< Pa
    double decay = 0;          ///< 1/s
    double step = -1;          ///< s, that `keep` is for; < 0: none
    double keep = 0;           ///< exp(-decay step)
  };

  double density = 0;            ///< kg/m3
  double bulk = 0;               ///< Pa
  double long_term_modulus = 0;  ///< G_inf, Pa
  std::array<Term, kMaxTerms> terms{};
  int term_count = 0;

  /// One term: G(t) = long + (short - long) exp(-decay t).
  static Viscoelastic from_single_term(double density, double bulk_modulus, double shear_short,
                                       double shear_long, double decay);

  /// The same law with its decays over a step of `dt` worked out beforehand, for many updates.
  Viscoelastic for_step(double dt) const;

  int history_size() const { return 1 + 6 * term_count; }
  double shear_modulus() const {
    double sum = long_term_modulus;
    for (int i = 0; i < term_count; ++i) sum += terms[i].shear_modulus;
    return sum;
  }
  double bulk_modulus() const { return bulk; }

  template <class N>
  void initialise(N* history) const {
    for (int i = 0; i < history_size(); ++i) history[i] = constant<N>(0);
  }

  /// History: work of the relaxing part, then y_i (six components) of each term, where the
  /// overstress is h_i = y_i + G_i T and dy_i/dt = -beta_i h_i. T = J^-2/3 (I - tr C / 3 C^-1). The
  /// update is exact for a T held over the step; its error is beta dt / 2 of a term.
  template <class N>
  SolidAnswer<N> update(const SolidStep<N>& step, N* history) const {
    const N& J = step.J;
    const Symmetric<N> C = right_cauchy_green(step.F);
    const Symmetric<N> C_inverse = right_cauchy_green_inverse(step.F_inverse);
    const N root = inverse_cube_root(J);
    const N isochoric = root * root;
    const N trace_share = trace(C) * (1.0 / 3.0);
    const N a = -isochoric * trace_share;
    const Symmetric<N> T{isochoric + a * C_inverse.xx,
                         isochoric + a * C_inverse.yy,
                         isochoric + a * C_inverse.zz,
                         a * C_inverse.xy,
                         a * C_inverse.yz,
                         a * C_inverse.zx};

    Symmetric<N> Y = zero<N>(), Y_middle = zero<N>();
    for (int i = 0; i < term_count; ++i)
      relax(terms[i], T, step.dt, history + 1 + 6 * i, Y, Y_middle);

    const double G0 = shear_modulus();
    const N shift = contract(Y, C) * (1.0 / 3.0);
    const N pressure_part = 0.5 * bulk * (J * J - 1.0) - shift;
    const Symmetric<N> S{G0 * T.xx + Y.xx + pressure_part * C_inverse.xx,
                         G0 * T.yy + Y.yy + pressure_part * C_inverse.yy,
                         G0 * T.zz + Y.zz + pressure_part * C_inverse.zz,
                         G0 * T.xy + Y.xy + pressure_part * C_inverse.xy,
                         G0 * T.yz + Y.yz + pressure_part * C_inverse.yz,
                         G0 * T.zx + Y.zx + pressure_part * C_inverse.zx};

    const Symmetric<N> dE = green_lagrange_increment(step);
    history[0] +=
        contract(Y_middle, dE) - contract(Y_middle, C) * (1.0 / 3.0) * contract(C_inverse, dE);
    SolidAnswer<N> answer;
    answer.P = product(step.F, S);
    answer.energy =
        1.5 * G0 * (isochoric * trace_share - 1.0) + 0.5 * bulk * volume_energy(J) + history[0];
    answer.bulk_modulus = 0.5 * bulk * (J + 1.0 / J);  // -J dp/dJ
    answer.shear_modulus = constant<N>(G0);
    return answer;
  }

 private:
  template <class N>
  static void relax(const Term& term, const Symmetric<N>& T, double dt, N* y, Symmetric<N>& Y,
                    Symmetric<N>& Y_middle) {
    // On lanes although one number would do: a library call here costs all lanes their registers.
    const N keep =
        term.step == dt ? constant<N>(term.keep) : exponential(constant<N>(-term.decay * dt));
    const N gain = -term.shear_modulus * (1.0 - keep);
    const N* const t[6] = {&T.xx, &T.yy, &T.zz, &T.xy, &T.yz, &T.zx};
    N* const sum[6] = {&Y.xx, &Y.yy, &Y.zz, &Y.xy, &Y.yz, &Y.zx};
    N* const middle[6] = {&Y_middle.xx, &Y_middle.yy, &Y_middle.zz,
                          &Y_middle.xy, &Y_middle.yz, &Y_middle.zx};
    for (int k = 0; k < 6; ++k) {
      const N next = keep * y[k] + gain * *t[k];
      *middle[k] += 0.5 * (y[k] + next);
      *sum[k] += next;
      y[k] = next;
    }
  }
};

}  // namespace crosswalk::fe
