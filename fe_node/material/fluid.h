// Nearly incompressible fluid: pressure -K (J - 1), not below the cavitation tension, Newtonian
// viscosity 2 eta d', and an optional small elastic shear modulus (isochoric neo-Hooke), which
// near-fluid layers of head models carry. With K and eta alone it is the null material.
#pragma once

#include "fe_node/material/material.h"

namespace crosswalk::fe {

struct Fluid {
  double density = 0;
  double bulk = 0;                   ///< Pa
  double shear = 0;                  ///< Pa
  double viscosity = 0;              ///< Pa s
  double cavitation_tension = 1e30;  ///< Pa, positive

  /// History: work of the viscous stress.
  int history_size() const { return 1; }
  double shear_modulus() const { return shear; }
  double bulk_modulus() const { return bulk; }
  template <class N>
  void initialise(N* history) const {
    history[0] = constant<N>(0);
  }

  template <class N>
  SolidAnswer<N> update(const SolidStep<N>& step, N* history) const {
    const N& J = step.J;
    const N isochoric = exponential(N((-2.0 / 3.0) * logarithm(J)));
    const N I1 = contract(step.F, step.F);
    // beyond the cavity's opening the energy goes on linearly
    const N full = bulk * (J - 1.0);
    const N mean = smaller(full, constant<N>(cavitation_tension));
    const N opened = full - mean;
    const N pressure_part = mean - shear * isochoric * I1 * (1.0 / 3.0) / J;
    SolidAnswer<N> answer;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        answer.P(i, j) =
            shear * isochoric * step.F(i, j) + pressure_part * J * step.F_inverse(j, i);
    if (viscosity > 0) {
      Symmetric<N> d = rate_of_deformation(velocity_gradient(step));
      const N third = trace(d) * (1.0 / 3.0);
      d = {d.xx - third, d.yy - third, d.zz - third, d.xy, d.yz, d.zx};
      const N factor = constant<N>(2 * viscosity);
      const Tensor<N> viscous = nominal_stress(combine(factor, d, constant<N>(0), d), step);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) answer.P(i, j) += viscous(i, j);
      history[0] += J * factor * contract(d, d) * step.dt;
    }
    answer.energy = 0.5 * shear * (isochoric * I1 - 3.0) +
                    0.5 * (full * full - opened * opened) / bulk + history[0];
    answer.bulk_modulus = constant<N>(bulk);
    // viscosity does not shorten the step as long as eta is far below K dt, as in real fluids
    answer.shear_modulus = constant<N>(shear);
    return answer;
  }
};

}  // namespace crosswalk::fe
