// Linear viscoelastic sheet in plane stress, G(t) = G_long + (G_short - G_long) exp(-beta t), bulk
// modulus elastic; the PVB interlayer [wei2006] and membranes of soft tissue.
//
// Over a step the deviatoric stress follows ds = 2 G_a de - (1 - exp(-beta dt)) q exactly for a
// constant strain rate, with G_a = G_long + G_1 (1 - exp(-beta dt)) / (beta dt) and q the relaxing
// part; the normal strain is solved from a zero normal stress.
#pragma once

#include "fe_node/material/shell_law.h"

namespace crosswalk::fe {

struct ShellViscoelastic {
  double density = 0;
  double bulk_modulus = 0;                       ///< Pa
  double shear_short = 0;                        ///< Pa
  double shear_long = 0;                         ///< Pa
  double decay = 0;                              ///< 1/s
  double youngs_modulus = 0, poisson_ratio = 0;  ///< of the short-time response; set by make()

  static ShellViscoelastic make(double density, double bulk_modulus, double shear_short,
                                double shear_long, double decay) {
    const double E = 9 * bulk_modulus * shear_short / (3 * bulk_modulus + shear_short);
    return {density, bulk_modulus, shear_short, shear_long, decay, E, 0.5 * E / shear_short - 1};
  }

  /// History: the relaxing part q, xx yy xy yz zx (zz = -xx - yy).
  int history_size() const { return 5; }
  template <class N>
  void initialise(N* history) const {
    for (int i = 0; i < 5; ++i) history[i] = constant<N>(0);
  }

  template <class N>
  PlaneAnswer<N> update(const PlaneStep<N>& step, N* q) const {
    const double x = decay * step.dt;
    const double relaxed = -std::expm1(-x);
    const double mean_factor = x > 1e-8 ? relaxed / x : 1 - 0.5 * x;
    const double G1 = (shear_short - shear_long) * mean_factor;
    const double Ga = shear_long + G1;
    const PlaneTensor<N>& e = step.strain;
    const N plane = e.xx + e.yy;
    // 0 = K (plane + ez) + 2 Ga (ez - (plane + ez)/3) + relaxed (q.xx + q.yy)
    PlaneAnswer<N> answer;
    const N ez = -((bulk_modulus - 2.0 / 3.0 * Ga) * plane + relaxed * (q[0] + q[1])) *
                 (1 / (bulk_modulus + 4.0 / 3.0 * Ga));
    answer.thinning = ez;
    const N third = (plane + ez) * (1.0 / 3.0);
    const N pressure = bulk_modulus * (plane + ez);
    const PlaneTensor<N> d{e.xx - third, e.yy - third, 0.5 * e.xy, 0.5 * e.yz, 0.5 * e.zx};
    auto change = [&](const N& strain, const N& part) -> N {
      return 2.0 * Ga * strain - relaxed * part;
    };
    answer.stress = {step.stress.xx + pressure + change(d.xx, q[0]),
                     step.stress.yy + pressure + change(d.yy, q[1]),
                     step.stress.xy + change(d.xy, q[2]), step.stress.yz + change(d.yz, q[3]),
                     step.stress.zx + change(d.zx, q[4])};
    const N strain[5] = {d.xx, d.yy, d.xy, d.yz, d.zx};
    for (int i = 0; i < 5; ++i) q[i] += 2.0 * G1 * strain[i] - relaxed * q[i];
    return answer;
  }
};

}  // namespace crosswalk::fe
