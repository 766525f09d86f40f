// The arithmetic of the fully integrated quadrilateral shell in lanes: 2 x 2 points in the plane
// and the assumed transverse shear of Dvorkin and Bathe [dvorkin1984], on the co-rotational frame
// of the one-point shell (shell_kernel.h). It needs no hourglass control.
//
// - Membrane: the metric's rate x,a . v,b on the bilinear surface, so that a rigid rotation strains
// a
//   warped element nowhere: e_xx = u,x + z,x w,x. The in-plane shear is that of the centre
//   (selective integration): bending in the plane does not lock, and a warped element can bend
//   without stretching.
// - Curvature: from the rotations at each point, k_xx = th_y,x and so on.
// - Transverse shear: covariant components taken at the middles of the sides and interpolated
//   between opposite ones: no locking of thin shells, no modes without energy.
// - A node's rotation about the surface's normal there is no bending: in a warped element, whose
//   normals at the corners are not its own, the rotation of the material takes its place, th' = th
//   + grad z (th_z - Omega), Omega = (v,x - u,y)/2.
//
// Nodal fields are written f = mean + xi f.xi + eta f.eta + xi eta f.twist.
#pragma once

#include "fe_node/element/shell_kernel.h"

namespace crosswalk::fe {

/// Natural coordinates of the corners.
inline constexpr double kCornerXi[4] = {-1, 1, 1, -1}, kCornerEta[4] = {-1, -1, 1, 1};
inline constexpr double kGaussPoint = 0.57735026918962576;  // 1/sqrt(3)

template <class N>
struct Bilinear {
  N mean, xi, eta, twist;

  static Bilinear<N> of(const N& a, const N& b, const N& c, const N& d) {
    return {0.25 * (a + b + c + d), 0.25 * (b + c - a - d), 0.25 * (c + d - a - b),
            0.25 * (a + c - b - d)};
  }
  static Bilinear<N> zero() {
    return {constant<N>(0), constant<N>(0), constant<N>(0), constant<N>(0)};
  }
  /// The load on a corner that does the work of these loads on the coefficients.
  N at_corner(int i) const {
    return 0.25 *
           (mean + kCornerXi[i] * xi + kCornerEta[i] * eta + kCornerXi[i] * kCornerEta[i] * twist);
  }
};

/// Local coordinates and their slopes; z = warp xi eta.
template <class N>
struct FullShellShape {
  Bilinear<N> x, y;
  N warp, jacobian;  ///< jacobian at the centre, a quarter of the area

  explicit FullShellShape(const ShellShape<N, 4>& s)
      : x(Bilinear<N>::of(s.x[0], s.x[1], s.x[2], s.x[3])),
        y(Bilinear<N>::of(s.y[0], s.y[1], s.y[2], s.y[3])),
        warp(s.warp),
        jacobian(0.25 * s.area) {}

  /// At the four points the Jacobian is jacobian +- a +- b; the least of them.
  N least_jacobian() const {
    return jacobian - kGaussPoint * (magnitude(x.xi * y.twist - x.twist * y.xi) +
                                     magnitude(x.twist * y.eta - x.eta * y.twist));
  }
};

template <class N>
struct Slope {
  N x, y;
};

/// Derivatives of the coordinates at (xi, eta).
template <class N>
struct FullShellPoint {
  double xi, eta;
  N x_xi, x_eta, y_xi, y_eta, jacobian;
  Slope<N> z;

  FullShellPoint(const FullShellShape<N>& s, double at_xi, double at_eta)
      : xi(at_xi),
        eta(at_eta),
        x_xi(s.x.xi + eta * s.x.twist),
        x_eta(s.x.eta + xi * s.x.twist),
        y_xi(s.y.xi + eta * s.y.twist),
        y_eta(s.y.eta + xi * s.y.twist),
        jacobian(x_xi * y_eta - x_eta * y_xi),
        z(in_plane(eta * s.warp, xi * s.warp)) {}

  /// Slopes in x, y of covariant components.
  Slope<N> in_plane(const N& along_xi, const N& along_eta) const {
    const N f = 1.0 / jacobian;
    return {f * (along_xi * y_eta - along_eta * y_xi), f * (along_eta * x_xi - along_xi * x_eta)};
  }
  Slope<N> gradient(const Bilinear<N>& f) const {
    return in_plane(f.xi + eta * f.twist, f.eta + xi * f.twist);
  }
  /// Adds the loads on the coefficients of f whose work is (load . gradient(f)) jacobian.
  void add_gradient_load(const Slope<N>& load, Bilinear<N>& f) const {
    const N a = load.x * y_eta - load.y * x_eta, b = load.y * x_xi - load.x * y_xi;
    f.xi += a;
    f.eta += b;
    f.twist += eta * a + xi * b;
  }
};

/// Velocities and rotations (th' of above) of the corners, or the loads on them.
template <class N>
struct FullShellField {
  Bilinear<N> u, v, w, th_x, th_y;
};

/// grad z at a corner with the Jacobian of the centre, which no distortion makes vanish.
template <class N>
Slope<N> corner_slope(const FullShellPoint<N>& centre, const N& warp, int i) {
  return centre.in_plane(kCornerEta[i] * warp, kCornerXi[i] * warp);
}

template <class N>
N material_spin(const FullShellPoint<N>& centre, const FullShellField<N>& f) {
  return 0.5 * (centre.gradient(f.v).x - centre.gradient(f.u).y);
}

template <class N>
FullShellField<N> full_shell_field(const FullShellShape<N>& s, const Lanes3<N> (&v)[4],
                                   const Lanes3<N> (&spin)[4]) {
  FullShellField<N> f{Bilinear<N>::of(v[0].x, v[1].x, v[2].x, v[3].x),
                      Bilinear<N>::of(v[0].y, v[1].y, v[2].y, v[3].y),
                      Bilinear<N>::of(v[0].z, v[1].z, v[2].z, v[3].z), Bilinear<N>::zero(),
                      Bilinear<N>::zero()};
  const FullShellPoint<N> centre(s, 0, 0);
  const N omega = material_spin(centre, f);
  N th_x[4], th_y[4];
  for (int i = 0; i < 4; ++i) {
    const Slope<N> z = corner_slope(centre, s.warp, i);
    th_x[i] = spin[i].x + z.x * (spin[i].z - omega);
    th_y[i] = spin[i].y + z.y * (spin[i].z - omega);
  }
  f.th_x = Bilinear<N>::of(th_x[0], th_x[1], th_x[2], th_x[3]);
  f.th_y = Bilinear<N>::of(th_y[0], th_y[1], th_y[2], th_y[3]);
  return f;
}

/// Covariant transverse shear: along xi it is xi_mean + eta xi_slope, along eta eta_mean + xi
/// eta_slope, linear between the middles of opposite sides.
template <class N>
struct TiedShear {
  N xi_mean, xi_slope, eta_mean, eta_slope;

  static TiedShear<N> of(const FullShellShape<N>& s, const FullShellField<N>& f) {
    const Bilinear<N>&x = s.x, &y = s.y, &a = f.th_x, &b = f.th_y;
    return {f.w.xi + x.xi * b.mean + x.twist * b.eta - y.xi * a.mean - y.twist * a.eta,
            f.w.twist + x.xi * b.eta + x.twist * b.mean - y.xi * a.eta - y.twist * a.mean,
            f.w.eta + x.eta * b.mean + x.twist * b.xi - y.eta * a.mean - y.twist * a.xi,
            f.w.twist + x.eta * b.xi + x.twist * b.mean - y.eta * a.xi - y.twist * a.mean};
  }
  /// These as loads, on the field: the transpose of the above.
  void add_loads(const FullShellShape<N>& s, FullShellField<N>& f) const {
    const Bilinear<N>&x = s.x, &y = s.y;
    f.w.xi += xi_mean;
    f.w.eta += eta_mean;
    f.w.twist += xi_slope + eta_slope;
    f.th_y.mean += x.xi * xi_mean + x.eta * eta_mean + x.twist * (xi_slope + eta_slope);
    f.th_y.eta += x.twist * xi_mean + x.xi * xi_slope;
    f.th_y.xi += x.twist * eta_mean + x.eta * eta_slope;
    f.th_x.mean -= y.xi * xi_mean + y.eta * eta_mean + y.twist * (xi_slope + eta_slope);
    f.th_x.eta -= y.twist * xi_mean + y.xi * xi_slope;
    f.th_x.xi -= y.twist * eta_mean + y.eta * eta_slope;
  }
};

/// `plane_shear`: of the centre.
template <class N>
SectionVector<N> full_shell_rates(const FullShellPoint<N>& p, const FullShellField<N>& f,
                                  const TiedShear<N>& shear, const N& plane_shear) {
  const Slope<N> w = p.gradient(f.w), a = p.gradient(f.th_x), b = p.gradient(f.th_y);
  const Slope<N> across =
      p.in_plane(shear.xi_mean + p.eta * shear.xi_slope, shear.eta_mean + p.xi * shear.eta_slope);
  SectionVector<N> r;
  r.xx = p.gradient(f.u).x + p.z.x * w.x;
  r.yy = p.gradient(f.v).y + p.z.y * w.y;
  r.xy = plane_shear;
  r.kxx = b.x;
  r.kyy = -a.y;
  r.kxy = b.y - a.x;
  r.yz = across.y;
  r.zx = across.x;
  return r;
}

/// Adds the loads that do the work of the resultants at a point; in-plane shear apart.
template <class N>
void add_full_shell_loads(const FullShellPoint<N>& p, const SectionVector<N>& n,
                          FullShellField<N>& f, TiedShear<N>& shear) {
  const N none = constant<N>(0);
  p.add_gradient_load({n.xx, none}, f.u);
  p.add_gradient_load({none, n.yy}, f.v);
  p.add_gradient_load({p.z.x * n.xx, p.z.y * n.yy}, f.w);
  p.add_gradient_load({-n.kxy, -n.kyy}, f.th_x);
  p.add_gradient_load({n.kxx, n.kxy}, f.th_y);
  const N along_xi = n.zx * p.y_eta - n.yz * p.x_eta;
  const N along_eta = n.yz * p.x_xi - n.zx * p.y_xi;
  shear.xi_mean += along_xi;
  shear.xi_slope += p.eta * along_xi;
  shear.eta_mean += along_eta;
  shear.eta_slope += p.xi * along_eta;
}

}  // namespace crosswalk::fe
