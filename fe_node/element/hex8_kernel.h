// The arithmetic of the one-point hexahedron on a number type N (Lanes or double); see hex8.h.
#pragma once

#include "fe_node/element/element_controls.h"
#include "fe_node/material/material.h"

namespace crosswalk::fe {

/// What an element keeps of its undeformed shape. B_I = dV/dX_I.
template <class N>
struct HexReference {
  N gradient[8][3];  ///< B_I, m2
  N volume;          ///< m3
  N inverse_volume;
  N hourglass[4][3];  ///< h_a . X, m
  N hourglass_scale;  ///< V tr(metric) / 8, m: the stiffness of a mode over coefficient and modulus
  N length;           ///< cube root of the volume, m
};

/// What only the bound of the stiffness asks for: sum_I b_I b_I^T with b = B / V, 1/m2.
template <class N>
struct HexMetric {
  N entries[6];  ///< xx yy zz xy yz zx
};

template <class N>
struct HexNodes {
  N x[8][3];
  N v[8][3];
};

template <class N>
struct HexAnswer {
  N force[8][3];
  N energy;            ///< J
  N hourglass_stored;  ///< J
  N hourglass_power;   ///< W, dissipated
  N viscous_power;     ///< W
  N stiffness;         ///< bound at each corner, N/m; 0 where none is wanted
  N J;
  N alive;
};

/// The four hourglass base vectors dotted with nodal values of one component.
template <class N>
void hourglass_modes(const N (&u)[8][3], int axis, N (&mode)[4]) {
  const N a = u[0][axis] - u[2][axis], b = u[1][axis] - u[3][axis], c = u[4][axis] - u[6][axis],
          d = u[5][axis] - u[7][axis];
  const N e = u[0][axis] + u[2][axis], f = u[1][axis] + u[3][axis], g = u[4][axis] + u[6][axis],
          h = u[5][axis] + u[7][axis];
  mode[0] = (a + b) - (c + d);  // eta zeta
  mode[1] = (a - b) - (c - d);  // xi zeta
  mode[2] = (e - f) + (g - h);  // xi eta
  mode[3] = (g - h) - (e - f);  // xi eta zeta
}

/// -sum_a h_a[I] t_a at each corner.
template <class N>
void mode_loads(const N (&t)[4], N (&load)[8]) {
  const N p = t[0] + t[1], m = t[0] - t[1], s = t[2] - t[3], r = t[2] + t[3];
  load[0] = -(p + s);
  load[1] = s - m;
  load[2] = p - s;
  load[3] = m + s;
  load[4] = p - r;
  load[5] = m + r;
  load[6] = -(p + r);
  load[7] = r - m;
}

/// Largest eigenvalue of a symmetric 3x3 matrix from above: mean + 2 sqrt(J2/3), exact for three
/// equal ones, tightened by two Newton steps of the characteristic polynomial, which stay above the
/// root.
template <class N>
N largest_eigenvalue(const Symmetric<N>& g) {
  const N mean = trace(g) * (1.0 / 3.0);
  const N a = g.xx - mean, b = g.yy - mean, c = g.zz - mean;
  const N off = g.xy * g.xy + g.yz * g.yz + g.zx * g.zx;
  const N third_j2 = (a * a + b * b + c * c + 2.0 * off) * (1.0 / 6.0);
  const N det =
      a * (b * c - g.yz * g.yz) - g.xy * (g.xy * c - g.yz * g.zx) + g.zx * (g.xy * g.yz - b * g.zx);
  // y^3 - 3 p2 y - det = 0 for the deviator's eigenvalue y, p2 = third_j2; y <= 2 sqrt(p2).
  N y = 2.0 * square_root(third_j2);
  for (int i = 0; i < 2; ++i) {
    const N slope = 3.0 * (y * y - third_j2) + kTiny<N>;
    y -= (y * (y * y - 3.0 * third_j2) - det) / slope;
  }
  return mean + y;
}

/// sum u_I (grad N_I)^T: F of positions, its rate of velocities. One after the other: nine sums fit
/// the registers, eighteen do not.
template <class N>
Tensor<N> gradient_of(const HexReference<N>& ref, const N (&u)[8][3]) {
  Tensor<N> out;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) out(i, j) = u[0][i] * ref.gradient[0][j];
  for (int node = 1; node < 8; ++node)
    for (int j = 0; j < 3; ++j) {
      const N b = ref.gradient[node][j];
      for (int i = 0; i < 3; ++i) out(i, j) += u[node][i] * b;
    }
  for (int k = 0; k < 9; ++k) out(k / 3, k % 3) *= ref.inverse_volume;
  return out;
}

/// Bound of an element's stiffness per undeformed volume: u^T k u <= V hex_stiffness sum |u_I|^2
/// with J (lambda tr g + 2 mu g_max), g = F^-T metric F^-1: the element eigenvalue bound of
/// [flanagan1984] with the shear part bounded by the largest direction. Pa/m2.
template <class N>
N hex_stiffness(const N (&metric)[6], const Tensor<N>& Fi, const N& J, const N& bulk_modulus,
                const N& shear_modulus) {
  N t[3][3];  // metric F^-1
  for (int j = 0; j < 3; ++j) {
    t[0][j] = metric[0] * Fi(0, j) + metric[3] * Fi(1, j) + metric[5] * Fi(2, j);
    t[1][j] = metric[3] * Fi(0, j) + metric[1] * Fi(1, j) + metric[4] * Fi(2, j);
    t[2][j] = metric[5] * Fi(0, j) + metric[4] * Fi(1, j) + metric[2] * Fi(2, j);
  }
  auto entry = [&](int i, int j) -> N {
    return Fi(0, i) * t[0][j] + Fi(1, i) * t[1][j] + Fi(2, i) * t[2][j];
  };
  const Symmetric<N> g{entry(0, 0), entry(1, 1), entry(2, 2),
                       entry(0, 1), entry(1, 2), entry(2, 0)};
  const N lambda = larger(N(bulk_modulus - 2.0 / 3.0 * shear_modulus), constant<N>(0));
  return J * (lambda * trace(g) + 2.0 * shear_modulus * largest_eigenvalue(g));
}

/// The same of an undeformed element.
template <class N>
N hex_stiffness_at_rest(const N (&metric)[6], double bulk_modulus, double shear_modulus) {
  Tensor<N> identity;
  for (int k = 0; k < 9; ++k) identity(k / 3, k % 3) = constant<N>(k % 4 == 0 ? 1.0 : 0.0);
  return hex_stiffness(metric, identity, constant<N>(1), constant<N>(bulk_modulus),
                       constant<N>(shear_modulus));
}

/// What damping with the ratio s = (Q1 e l + Q2 c) / c multiplies a stiffness by: the stable step
/// shrinks by sqrt(1 + s^2) - s [hallquist2006, 22.1]. Viscosity acts in compression only.
template <class N>
N stiffening_by_viscosity(const N& compression, const N& viscous_speed, const N& wave_speed) {
  const N ratio =
      where_less(constant<N>(0), compression, N(viscous_speed / wave_speed), constant<N>(0));
  const N shorten = square_root(N(1.0 + ratio * ratio)) - ratio;
  return 1.0 / (shorten * shorten);
}

/// An element that has failed counts as undeformed and at rest: its nodes go on without it and may
/// turn it inside out, which has no stress to answer with.
template <class N>
void rest_where_failed(const N& alive, Tensor<N>& F, Tensor<N>& F_rate) {
  if (all_positive(alive)) return;
  const N zero = constant<N>(0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      F(i, j) = where_less(zero, alive, F(i, j), constant<N>(i == j ? 1 : 0));
      F_rate(i, j) = where_less(zero, alive, F_rate(i, j), zero);
    }
}

template <class N, class Law>
HexAnswer<N> hex8_forces(const HexReference<N>& ref, const HexMetric<N>& metric,
                         const HexNodes<N>& nodes, const Law& law, const ElementControls& controls,
                         double dt, N* history, bool wants_stiffness) {
  SolidStep<N> step;
  step.dt = dt;
  step.F = gradient_of(ref, nodes.x);
  step.F_rate = gradient_of(ref, nodes.v);
  if constexpr (requires { Law::kAlive; })
    rest_where_failed(history[Law::kAlive], step.F, step.F_rate);
  step.J = determinant(step.F);
  step.F_inverse = inverse(step.F, step.J);

  SolidAnswer<N> material = law.update(step, history);
  HexAnswer<N> answer;
  answer.J = step.J;
  answer.alive = material.alive;
  answer.energy = material.energy * ref.volume;

  // Bulk viscosity [hallquist2006, 3.5]: q = rho l (Q1 l e^2 - Q2 c e) in compression (e < 0).
  N expansion = step.F_rate(0, 0) * step.F_inverse(0, 0);
  for (int k = 1; k < 9; ++k) expansion += step.F_rate(k / 3, k % 3) * step.F_inverse(k % 3, k / 3);
  const N wave_speed = square_root(N((material.bulk_modulus + 4.0 / 3.0 * material.shear_modulus) *
                                     step.J * (1.0 / law.density)));
  const N compression = larger(N(-expansion), constant<N>(0)) * ref.length;
  const N viscous_speed = controls.quadratic_bulk * compression + controls.linear_bulk * wave_speed;
  const N q = law.density * viscous_speed * compression;  // per undeformed mass; rho0 / J * J
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) material.P(i, j) -= q * step.F_inverse(j, i);
  answer.viscous_power = q * compression * ref.length * ref.length;  // V / l = l^2

  answer.stiffness = constant<N>(0);
  if (wants_stiffness)
    answer.stiffness = ref.volume *
                       hex_stiffness(metric.entries, step.F_inverse, step.J, material.bulk_modulus,
                                     material.shear_modulus) *
                       stiffening_by_viscosity(compression, viscous_speed, wave_speed);

  // Hourglass control; its reaction on F is folded into the stress (see hex8.h). Component by
  // component, so that the loads of the modes stay in registers.
  const bool is_viscous = controls.hourglass == HourglassForm::Viscous;
  const bool is_controlled = controls.hourglass != HourglassForm::None;
  const Tensor<N>& field = is_viscous ? step.F_rate : step.F;
  const N factor =
      is_viscous ? N((0.25 * controls.hourglass_coefficient * law.density) * ref.length *
                     ref.length * wave_speed)
                 : N(controls.hourglass_coefficient * material.shear_modulus * ref.hourglass_scale);
  N sum = constant<N>(0);
  for (int i = 0; i < 3; ++i) {
    N load[8], P[3] = {material.P(i, 0), material.P(i, 1), material.P(i, 2)};
    if (is_controlled) {
      N t[4];
      hourglass_modes(is_viscous ? nodes.v : nodes.x, i, t);
      for (int a = 0; a < 4; ++a) {
        t[a] -= field(i, 0) * ref.hourglass[a][0] + field(i, 1) * ref.hourglass[a][1] +
                field(i, 2) * ref.hourglass[a][2];
        sum += t[a] * t[a];
        t[a] *= factor;
      }
      for (int j = 0; j < 3; ++j)
        P[j] -= ref.inverse_volume * (t[0] * ref.hourglass[0][j] + t[1] * ref.hourglass[1][j] +
                                      t[2] * ref.hourglass[2][j] + t[3] * ref.hourglass[3][j]);
      mode_loads(t, load);
    } else {
      for (N& l : load) l = constant<N>(0);
    }
    for (int node = 0; node < 8; ++node)
      answer.force[node][i] = load[node] - P[0] * ref.gradient[node][0] -
                              P[1] * ref.gradient[node][1] - P[2] * ref.gradient[node][2];
  }
  const N resisted = is_controlled ? N(factor * sum) : constant<N>(0);
  answer.hourglass_power = is_viscous ? resisted : constant<N>(0);
  answer.hourglass_stored = is_viscous ? constant<N>(0) : N(0.5 * resisted);

  if constexpr (requires { Law::kAlive; }) {
    answer.stiffness *= answer.alive;
    for (auto& corner : answer.force)
      for (N& f : corner) f *= answer.alive;
  }
  return answer;
}

}  // namespace crosswalk::fe
