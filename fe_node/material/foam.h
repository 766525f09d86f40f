// Low-density foam: no lateral contraction, each principal direction follows the tabulated curve of
// nominal stress over nominal compression 1 - l; in tension E (l - 1) up to a cut-off. Unloading is
// softened by hysteresis, sigma = (1 - (1 - h) (1 - (W / W_max)^shape)) sigma_curve, with h the
// share left (1: none) and W the stored energy of the curve [hallquist2006, 22.57].
#pragma once

#include <algorithm>

#include "fe_node/material/lane_curve.h"
#include "fe_node/material/material.h"
#include "fe_node/material/spectral.h"

namespace crosswalk::fe {

struct Foam {
  double density = 0;
  double tension_modulus = 0;    ///< E, Pa
  LaneCurve curve = {};          ///< nominal stress over nominal compression, from (0, 0)
  double tension_cutoff = 1e30;  ///< Pa
  double unloading_share = 1;    ///< h
  double shape = 1;

  /// History: largest energy of the curve so far, work so far, energy of the curve before.
  int history_size() const { return 3; }
  double shear_modulus() const { return 0.5 * initial_slope(); }
  double bulk_modulus() const { return initial_slope() / 3; }
  template <class N>
  void initialise(N* history) const {
    for (int i = 0; i < 3; ++i) history[i] = constant<N>(0);
  }

  template <class N>
  SolidAnswer<N> update(const SolidStep<N>& step, N* history) const {
    const Spectrum<N> C = spectrum(right_cauchy_green(step.F));
    const N zero = constant<N>(0);
    N stress[3], stiffest = constant<N>(tension_modulus), stored = zero;
    for (int k = 0; k < 3; ++k) {
      const N stretch = square_root(C.value[k]);
      const N compression = 1.0 - stretch;
      N curve_stress, slope;
      curve.evaluate(larger(compression, zero), curve_stress, slope);
      const N integral = curve.integral(larger(compression, zero));
      const N pulled = tension_modulus * larger(N(-compression), zero);
      const N tension = smaller(pulled, constant<N>(tension_cutoff));
      const N beyond = pulled - tension;
      stress[k] = where_less(zero, compression, N(-curve_stress), tension);
      stored += where_less(zero, compression, integral,
                           N(0.5 * (pulled * pulled - beyond * beyond) / tension_modulus));
      stiffest = larger(stiffest, slope);
      stress[k] /= stretch;  // P = F S, S = T / l
    }
    N keep = constant<N>(1);
    if (unloading_share < 1) {
      history[0] = larger(history[0], stored);
      const N ratio = larger(N(stored / (history[0] + kTiny<N>)), constant<N>(1e-12));
      const N power = exponential(N(shape * logarithm(ratio)));
      keep = 1.0 - (1 - unloading_share) * (1.0 - power);
      keep = where_less(constant<N>(1e20 * kTiny<N>), history[0], keep, constant<N>(1));
      for (N& s : stress) s *= keep;
    }
    history[1] += keep * (stored - history[2]);
    history[2] = stored;
    SolidAnswer<N> answer;
    answer.P = product(step.F, assemble(C, stress));
    answer.energy = history[1];
    answer.bulk_modulus = stiffest * (1.0 / 3.0);
    answer.shear_modulus = 0.5 * stiffest;
    return answer;
  }

 private:
  double initial_slope() const { return std::max(curve.first_slope(), tension_modulus); }
};

}  // namespace crosswalk::fe
