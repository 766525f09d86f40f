// Isotropic elasticity: compressible neo-Hooke in the form without roots or logarithms of J's
// powers,
//   W = mu/2 (tr C - 3) - mu ln J + lambda/2 (J - 1)^2,   P = mu (F - F^-T) + lambda (J - 1) J F^-T
// [bonet2008, 6.4.3, with the volumetric term in J - 1]. Equal to Hooke's law for small strain,
// exact under rotation, and conservative. For soft tissue lambda >> mu: pressure is -lambda (J - 1)
// with J from nodal positions, never from summed increments.
#pragma once

#include "fe_node/material/material.h"

namespace crosswalk::fe {

struct Elastic {
  double density = 0;  ///< kg/m3
  double lambda = 0;   ///< Pa
  double mu = 0;       ///< Pa

  static Elastic from_young(double density, double youngs_modulus, double poisson_ratio);
  static Elastic from_bulk(double density, double bulk_modulus, double shear_modulus);

  int history_size() const { return 0; }
  double shear_modulus() const { return mu; }
  double bulk_modulus() const { return lambda + 2.0 / 3.0 * mu; }

  template <class N>
  void initialise(N* /*history*/) const {}

  template <class N>
  SolidAnswer<N> update(const SolidStep<N>& step, N* /*history*/) const {
    SolidAnswer<N> answer;
    const N& J = step.J;
    const N dilation = J - 1.0;
    const N a = lambda * dilation * J - mu;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) answer.P(i, j) = mu * step.F(i, j) + a * step.F_inverse(j, i);
    answer.energy = mu * isochoric_energy(step.F) + 0.5 * lambda * dilation * dilation;
    answer.bulk_modulus = constant<N>(bulk_modulus());
    answer.shear_modulus = constant<N>(mu);
    return answer;
  }

 private:
  /// (tr C - 3) / 2 - ln J in invariants of Green's strain E, whose squares it is made of: with
  /// J^2 = 1 + x, x = 2 tr E + 4 I2 + 8 I3, it is (x - ln(1 + x)) / 2 - 2 I2 - 4 I3.
  template <class N>
  static N isochoric_energy(const Tensor<N>& F) {
    const Symmetric<N> C = right_cauchy_green(F);
    const Symmetric<N> E{0.5 * (C.xx - 1.0), 0.5 * (C.yy - 1.0), 0.5 * (C.zz - 1.0),
                         0.5 * C.xy,         0.5 * C.yz,         0.5 * C.zx};
    const N xx = E.yy * E.zz - E.yz * E.yz, xy = E.yz * E.zx - E.xy * E.zz,
            zx = E.xy * E.yz - E.yy * E.zx;
    const N I2 = xx + E.zz * E.xx - E.zx * E.zx + E.xx * E.yy - E.xy * E.xy;
    const N I3 = E.xx * xx + E.xy * xy + E.zx * zx;
    const N of_products = 2.0 * I2 + 4.0 * I3;
    return 0.5 * logarithm_gap(N(2.0 * (trace(E) + of_products))) - of_products;
  }
};

}  // namespace crosswalk::fe
