// Eigenvalues and eigenvectors of a symmetric 3x3 tensor in lanes: cyclic Jacobi rotations, a fixed
// number of them and no branches. Coinciding eigenvalues are no special case.
#pragma once

#include "fe_node/material/tensor.h"

namespace crosswalk::fe {

template <class N>
struct Spectrum {
  N value[3];
  N axis[3][3];  ///< axis[k][i]: component i of unit eigenvector k
};

namespace spectral {

/// Annihilates a(p, q); the third index is r.
template <class N>
void rotate(N (&a)[3][3], N (&v)[3][3], int p, int q) {
  const int r = 3 - p - q;
  const N d = a[q][q] - a[p][p], off = 2.0 * a[p][q];
  const N root = square_root(N(d * d + off * off)) + kTiny<N>;
  // tan = off / (d + sign(d) root), the smaller rotation
  const N signed_root = where_less(d, constant<N>(0), N(-root), root);
  const N t = off / (d + signed_root);
  const N c = 1.0 / square_root(N(1.0 + t * t)), s = t * c;
  a[p][p] -= t * a[p][q];
  a[q][q] += t * a[p][q];
  a[p][q] = constant<N>(0);
  a[q][p] = a[p][q];
  const N rp = a[r][p], rq = a[r][q];
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  for (int i = 0; i < 3; ++i) {
    const N vp = v[p][i], vq = v[q][i];
    v[p][i] = c * vp - s * vq;
    v[q][i] = s * vp + c * vq;
  }
}

}  // namespace spectral

template <class N>
Spectrum<N> spectrum(const Symmetric<N>& s) {
  N a[3][3] = {{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}};
  Spectrum<N> out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out.axis[i][j] = constant<N>(i == j ? 1 : 0);
  constexpr int kSweeps = 5;  // quadratic convergence: off-diagonals below 1e-16 of the trace
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    spectral::rotate(a, out.axis, 0, 1);
    spectral::rotate(a, out.axis, 0, 2);
    spectral::rotate(a, out.axis, 1, 2);
  }
  for (int i = 0; i < 3; ++i) out.value[i] = a[i][i];
  return out;
}

/// sum_k f[k] axis_k axis_k^T
template <class N>
Symmetric<N> assemble(const Spectrum<N>& s, const N (&f)[3]) {
  auto entry = [&](int i, int j) -> N {
    return f[0] * s.axis[0][i] * s.axis[0][j] + f[1] * s.axis[1][i] * s.axis[1][j] +
           f[2] * s.axis[2][i] * s.axis[2][j];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

}  // namespace crosswalk::fe
