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
  N metric[6];        ///< sum_I b_I b_I^T with b = B / V (xx yy zz xy yz zx), 1/m2
  N density;          ///< with added mass, kg/m3; only for the stable step
  N length;           ///< cube root of the volume, m
};

template <class N>
struct HexNodes {
  N x[8][3];
  N v[8][3];
};

template <class N>
struct HexAnswer {
  N force[8][3];
  N energy;               ///< J
  N hourglass_stored;     ///< J
  N hourglass_power;      ///< W, dissipated
  N viscous_power;        ///< W
  N stable_step_squared;  ///< s2
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

/// force -= sum_a h_a[I] t_a for one component.
template <class N>
void subtract_modes(const N (&t)[4], int axis, N (&force)[8][3]) {
  const N p = t[0] + t[1], m = t[0] - t[1], s = t[2] - t[3], r = t[2] + t[3];
  force[0][axis] -= p + s;
  force[1][axis] -= m - s;
  force[2][axis] += p - s;
  force[3][axis] += m + s;
  force[4][axis] += p - r;
  force[5][axis] += m + r;
  force[6][axis] -= p + r;
  force[7][axis] -= m - r;
}

/// Largest eigenvalue of a symmetric 3x3 matrix, from above: exact for three equal ones, at most
/// mean + 2 sqrt(J2/3), tightened by two Newton steps of the characteristic polynomial, which stay
/// above the root.
template <class N>
N largest_eigenvalue_bound(const Symmetric<N>& g) {
  const N mean = trace(g) * (1.0 / 3.0);
  const N a = g.xx - mean, b = g.yy - mean, c = g.zz - mean;
  const N off = g.xy * g.xy + g.yz * g.yz + g.zx * g.zx;
  const N third_j2 = (a * a + b * b + c * c + 2.0 * off) * (1.0 / 6.0);
  const N det =
      a * (b * c - g.yz * g.yz) - g.xy * (g.xy * c - g.yz * g.zx) + g.zx * (g.xy * g.yz - b * g.zx);
  // y^3 - 3 p2 y - det = 0 for the deviator's eigenvalue y, p2 = third_j2; y <= 2 sqrt(p2).
  N y = 2.0 * square_root(third_j2);
  for (int i = 0; i < 2; ++i) {
    const N slope = 3.0 * (y * y - third_j2) + 1e-300;
    y -= (y * (y * y - 3.0 * third_j2) - det) / slope;
  }
  return mean + y;
}

/// F and its rate, node by node: both together use every gradient once.
template <class N>
void deformation_of(const HexReference<N>& ref, const HexNodes<N>& nodes, Tensor<N>& F,
                    Tensor<N>& F_rate) {
  for (int node = 0; node < 8; ++node)
    for (int j = 0; j < 3; ++j) {
      const N b = ref.gradient[node][j];
      for (int i = 0; i < 3; ++i)
        if (node == 0) {
          F(i, j) = nodes.x[node][i] * b;
          F_rate(i, j) = nodes.v[node][i] * b;
        } else {
          F(i, j) += nodes.x[node][i] * b;
          F_rate(i, j) += nodes.v[node][i] * b;
        }
    }
  for (int k = 0; k < 9; ++k) {
    F(k / 3, k % 3) *= ref.inverse_volume;
    F_rate(k / 3, k % 3) *= ref.inverse_volume;
  }
}

/// omega^2 <= 8 J / rho0 (lambda tr g + 2 mu g_max), g = F^-T metric F^-1: the element eigenvalue
/// bound of [flanagan1984] with the shear part bounded by the largest direction. dt^2 = 4 /
/// omega^2.
template <class N>
N hex_stable_step_squared(const HexReference<N>& ref, const Tensor<N>& Fi, const N& J,
                          const N& bulk_modulus, const N& shear_modulus) {
  N t[3][3];  // metric F^-1
  const N* m = ref.metric;
  for (int j = 0; j < 3; ++j) {
    t[0][j] = m[0] * Fi(0, j) + m[3] * Fi(1, j) + m[5] * Fi(2, j);
    t[1][j] = m[3] * Fi(0, j) + m[1] * Fi(1, j) + m[4] * Fi(2, j);
    t[2][j] = m[5] * Fi(0, j) + m[4] * Fi(1, j) + m[2] * Fi(2, j);
  }
  auto entry = [&](int i, int j) -> N {
    return Fi(0, i) * t[0][j] + Fi(1, i) * t[1][j] + Fi(2, i) * t[2][j];
  };
  const Symmetric<N> g{entry(0, 0), entry(1, 1), entry(2, 2),
                       entry(0, 1), entry(1, 2), entry(2, 0)};
  const N lambda = larger(N(bulk_modulus - 2.0 / 3.0 * shear_modulus), constant<N>(0));
  const N stiffness = lambda * trace(g) + 2.0 * shear_modulus * largest_eigenvalue_bound(g);
  return 0.5 * ref.density / (J * stiffness);
}

template <class N, class Law>
HexAnswer<N> hex8_forces(const HexReference<N>& ref, const HexNodes<N>& nodes, const Law& law,
                         const ElementControls& controls, double dt, N* history) {
  SolidStep<N> step;
  step.dt = dt;
  deformation_of(ref, nodes, step.F, step.F_rate);
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

  // Hourglass control; its reaction on F is folded into the stress (see hex8.h).
  answer.hourglass_stored = constant<N>(0);
  answer.hourglass_power = constant<N>(0);
  for (int i = 0; i < 3; ++i)
    for (int node = 0; node < 8; ++node) answer.force[node][i] = constant<N>(0);
  if (controls.hourglass != HourglassForm::None) {
    const bool is_viscous = controls.hourglass == HourglassForm::Viscous;
    const Tensor<N>& field = is_viscous ? step.F_rate : step.F;
    N factor;
    if (is_viscous)
      factor = (0.25 * controls.hourglass_coefficient * law.density) * ref.length * ref.length *
               wave_speed;
    else
      factor = (0.125 * controls.hourglass_coefficient) * material.shear_modulus * ref.volume *
               (ref.metric[0] + ref.metric[1] + ref.metric[2]);
    N sum = constant<N>(0);
    for (int i = 0; i < 3; ++i) {
      N t[4];
      hourglass_modes(is_viscous ? nodes.v : nodes.x, i, t);
      for (int a = 0; a < 4; ++a) {
        t[a] -= field(i, 0) * ref.hourglass[a][0] + field(i, 1) * ref.hourglass[a][1] +
                field(i, 2) * ref.hourglass[a][2];
        sum += t[a] * t[a];
        t[a] *= factor;
      }
      for (int j = 0; j < 3; ++j)
        material.P(i, j) -=
            ref.inverse_volume * (t[0] * ref.hourglass[0][j] + t[1] * ref.hourglass[1][j] +
                                  t[2] * ref.hourglass[2][j] + t[3] * ref.hourglass[3][j]);
      subtract_modes(t, i, answer.force);
    }
    (is_viscous ? answer.hourglass_power : answer.hourglass_stored) =
        (is_viscous ? 1.0 : 0.5) * factor * sum;
  }

  for (int node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i)
      answer.force[node][i] =
          (answer.force[node][i] - material.P(i, 0) * ref.gradient[node][0] -
           material.P(i, 1) * ref.gradient[node][1] - material.P(i, 2) * ref.gradient[node][2]) *
          answer.alive;

  // Damping with ratio s = (Q1 e l + Q2 c) / c shortens the step by sqrt(1 + s^2) - s.
  const N ratio =
      where_less(constant<N>(0), compression, N(viscous_speed / wave_speed), constant<N>(0));
  const N shorten = square_root(N(1.0 + ratio * ratio)) - ratio;
  answer.stable_step_squared =
      hex_stable_step_squared(ref, step.F_inverse, step.J, material.bulk_modulus,
                              material.shear_modulus) *
      shorten * shorten;
  return answer;
}

}  // namespace crosswalk::fe
