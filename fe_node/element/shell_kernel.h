// The arithmetic of one-point shells in lanes: co-rotational frames, strain rates and nodal loads
// of the Belytschko-Tsay quadrilateral [belytschko1984] and of a C0 triangle with discrete shear
// gap [bletzinger2000].
//
// Strain rates are taken from the geometry at the middle of the step, so a finite rigid rotation
// strains nothing; loads act on the geometry at its end, so they have no resultant and no moment.
// Section directions: x y z local, z normal. Rotations th: u = u_mid + z th_y, v = v_mid - z th_x.
#pragma once

#include "fe_node/element/element_block.h"

namespace crosswalk::fe {

/// Membrane strain, curvature and transverse shear of the mid-surface, or their increments;
/// engineering shears. Also used for the work-conjugate resultants (N/m, N m/m, N/m).
template <class N>
struct SectionVector {
  N xx, yy, xy;     ///< membrane
  N kxx, kyy, kxy;  ///< curvature: strain at height z is membrane + z k
  N yz, zx;         ///< transverse shear
};

template <class N>
struct Lanes3 {
  N x, y, z;
};

template <class N>
Lanes3<N> cross(const Lanes3<N>& a, const Lanes3<N>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class N>
N dot(const Lanes3<N>& a, const Lanes3<N>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class N>
Lanes3<N> scaled(const Lanes3<N>& a, const N& s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class N>
Lanes3<N> difference(const Lanes3<N>& a, const Lanes3<N>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
Lanes3<N> sum(const Lanes3<N>& a, const Lanes3<N>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
Lanes3<N> unit(const Lanes3<N>& a) {
  return scaled(a, 1.0 / square_root(dot(a, a)));
}

/// Axes of the local frame, in W.
template <class N>
struct ShellFrame {
  Lanes3<N> e1, e2, e3;
  Lanes3<N> to_local(const Lanes3<N>& a) const { return {dot(a, e1), dot(a, e2), dot(a, e3)}; }
  Lanes3<N> to_world(const Lanes3<N>& a) const {
    return sum(sum(scaled(e1, a.x), scaled(e2, a.y)), scaled(e3, a.z));
  }
};

/// Gradients of the shape functions and the frame they are in.
template <class N, int kCorners>
struct ShellShape {
  ShellFrame<N> frame;
  N x[kCorners], y[kCorners];  ///< local, about the first corner (3) or the centre (4)
  N warp;                      ///< corners lie at z = +warp, -warp, +warp, -warp
  N bx[kCorners], by[kCorners];
  N area;
};

/// z normal to both diagonals; x half-way between the two mid-lines' directions, so that the frame
/// follows the rotation of the material and not of one side.
template <class N>
ShellShape<N, 4> shell_shape(const Lanes3<N> (&p)[4]) {
  ShellShape<N, 4> s;
  const Lanes3<N> d31 = difference(p[2], p[0]), d42 = difference(p[3], p[1]);
  s.frame.e3 = unit(cross(d31, d42));
  const Lanes3<N> xi = difference(d31, d42), eta = sum(d31, d42);
  const Lanes3<N> towards = sum(unit(xi), unit(cross(eta, s.frame.e3)));
  s.frame.e1 = unit(difference(towards, scaled(s.frame.e3, dot(towards, s.frame.e3))));
  s.frame.e2 = cross(s.frame.e3, s.frame.e1);
  const Lanes3<N> centre = scaled(sum(sum(p[0], p[1]), sum(p[2], p[3])), constant<N>(0.25));
  for (int i = 0; i < 4; ++i) {
    const Lanes3<N> r = difference(p[i], centre);
    s.x[i] = dot(r, s.frame.e1);
    s.y[i] = dot(r, s.frame.e2);
  }
  s.warp = dot(difference(p[0], centre), s.frame.e3);
  const N x31 = s.x[2] - s.x[0], y31 = s.y[2] - s.y[0], x42 = s.x[3] - s.x[1],
          y42 = s.y[3] - s.y[1];
  s.area = 0.5 * (x31 * y42 - x42 * y31);
  const N f = 0.5 / s.area;
  s.bx[0] = -f * y42;
  s.bx[1] = f * y31;
  s.by[0] = f * x42;
  s.by[1] = -f * x31;
  for (int i = 0; i < 2; ++i) {
    s.bx[i + 2] = -s.bx[i];
    s.by[i + 2] = -s.by[i];
  }
  return s;
}

template <class N>
ShellShape<N, 3> shell_shape(const Lanes3<N> (&p)[3]) {
  ShellShape<N, 3> s;
  const Lanes3<N> a = difference(p[1], p[0]), b = difference(p[2], p[0]);
  s.frame.e3 = unit(cross(a, b));
  // halfway between side 1-2 and the in-plane normal of the line from its middle to corner 3
  const Lanes3<N> median = difference(b, scaled(a, constant<N>(0.5)));
  s.frame.e1 = unit(sum(unit(a), unit(cross(median, s.frame.e3))));
  s.frame.e2 = cross(s.frame.e3, s.frame.e1);
  s.x[0] = s.y[0] = s.warp = constant<N>(0);
  s.x[1] = dot(a, s.frame.e1);
  s.y[1] = dot(a, s.frame.e2);
  s.x[2] = dot(b, s.frame.e1);
  s.y[2] = dot(b, s.frame.e2);
  s.area = 0.5 * (s.x[1] * s.y[2] - s.x[2] * s.y[1]);
  const N f = 0.5 / s.area;
  s.bx[0] = f * (s.y[1] - s.y[2]);
  s.bx[1] = f * s.y[2];
  s.bx[2] = -f * s.y[1];
  s.by[0] = f * (s.x[2] - s.x[1]);
  s.by[1] = -f * s.x[2];
  s.by[2] = f * s.x[1];
  return s;
}

/// Coefficients of the rotations in the transverse shear: yz = B_y w - sum(yx th_x + yy th_y),
/// zx = B_x w + sum(xx th_x + xy th_y) per corner.
template <class N>
struct ShearRow {
  N yx, yy, xx, xy;
};

template <class N>
ShearRow<N> shear_row(const ShellShape<N, 4>&, int) {
  const N quarter = constant<N>(0.25), none = constant<N>(0);
  return {quarter, none, none, quarter};
}
/// The discrete shear gap: w_gap(corner) integrates the shear from the first corner along straight
/// lines. With th_y = beta_x and th_x = -beta_y the rows below are those of [bletzinger2000].
template <class N>
ShearRow<N> shear_row(const ShellShape<N, 3>& s, int corner) {
  const N f = 0.5 / s.area;
  const N a = s.x[1], b = s.y[1], d = s.x[2], c = s.y[2];
  if (corner == 0) {
    const N half = constant<N>(0.5), none = constant<N>(0);
    return {half, none, none, half};
  }
  // zx row: beta_x a c/2, beta_y b c/2 at corner 1; -b d/2, -b c/2 at corner 2
  // yz row: beta_x -a d/2, beta_y -b d/2 at corner 1; a d/2, a c/2 at corner 2
  if (corner == 1)
    return {f * (-0.5 * b * d), f * (0.5 * a * d), f * (-0.5 * b * c), f * (0.5 * a * c)};
  return {f * (0.5 * a * c), f * (-0.5 * a * d), f * (0.5 * b * c), f * (-0.5 * b * d)};
}

/// Strain rates of the mid-surface from local velocities (u, v, w) and spins (th_x, th_y).
template <class N, int kCorners>
SectionVector<N> shell_rates(const ShellShape<N, kCorners>& s, const Lanes3<N> (&v)[kCorners],
                             const Lanes3<N> (&th)[kCorners]) {
  SectionVector<N> r;
  r.xx = r.yy = r.xy = r.kxx = r.kyy = r.kxy = r.yz = r.zx = constant<N>(0);
  for (int i = 0; i < kCorners; ++i) {
    r.xx += s.bx[i] * v[i].x;
    r.yy += s.by[i] * v[i].y;
    r.xy += s.by[i] * v[i].x + s.bx[i] * v[i].y;
    r.kxx += s.bx[i] * th[i].y;
    r.kyy -= s.by[i] * th[i].x;
    r.kxy += s.by[i] * th[i].y - s.bx[i] * th[i].x;
    const ShearRow<N> row = shear_row(s, i);
    r.yz += s.by[i] * v[i].z - row.yx * th[i].x - row.yy * th[i].y;
    r.zx += s.bx[i] * v[i].z + row.xx * th[i].x + row.xy * th[i].y;
  }
  return r;
}

/// Loads of corner i in local axes, the negative gradient of the work of the resultants `n`.
template <class N, int kCorners>
void shell_loads(const ShellShape<N, kCorners>& s, const SectionVector<N>& n, int i,
                 Lanes3<N>& force, Lanes3<N>& moment) {
  const N bx = -s.area * s.bx[i], by = -s.area * s.by[i];
  force = {bx * n.xx + by * n.xy, by * n.yy + bx * n.xy, by * n.yz + bx * n.zx};
  const ShearRow<N> row = shear_row(s, i);
  moment.x = -by * n.kyy - bx * n.kxy + s.area * (row.yx * n.yz - row.xx * n.zx);
  moment.y = bx * n.kxx + by * n.kxy + s.area * (row.yy * n.yz - row.xy * n.zx);
  moment.z = constant<N>(0);
}

template <class N>
N larger_eigenvalue(const N& xx, const N& yy, const N& xy) {
  const N half = 0.5 * (xx - yy);
  return 0.5 * (xx + yy) + square_root(half * half + xy * xy);
}

/// Larger eigenvalue of sum_I b_I b_I^T and its trace, 1/m2.
template <class N, int kCorners>
void gradient_metric(const ShellShape<N, kCorners>& s, N& largest, N& trace) {
  N xx = constant<N>(0), yy = constant<N>(0), xy = constant<N>(0);
  for (int i = 0; i < kCorners; ++i) {
    xx += s.bx[i] * s.bx[i];
    yy += s.by[i] * s.by[i];
    xy += s.bx[i] * s.by[i];
  }
  trace = xx + yy;
  largest = larger_eigenvalue(xx, yy, xy);
}

/// Larger eigenvalue of the two shear rows' products with rotations weighted by 1 / gyration, 1/m2.
template <class N, int kCorners>
N shear_metric(const ShellShape<N, kCorners>& s, const N& gyration) {
  N zz = constant<N>(0), yy = constant<N>(0), zy = constant<N>(0);
  const N weight = 1.0 / gyration;
  for (int i = 0; i < kCorners; ++i) {
    const ShearRow<N> row = shear_row(s, i);
    zz += s.bx[i] * s.bx[i] + weight * (row.xx * row.xx + row.xy * row.xy);
    yy += s.by[i] * s.by[i] + weight * (row.yx * row.yx + row.yy * row.yy);
    zy += s.bx[i] * s.by[i] - weight * (row.xx * row.yx + row.xy * row.yy);
  }
  return larger_eigenvalue(zz, yy, zy);
}

}  // namespace crosswalk::fe
