// 3x3 tensors over a number type N (double or Lanes), component by component so that lanes stay in
// registers. Tensor is general (F, P, L), Symmetric holds six components (C, S, D, sigma).
#pragma once

#include "fe_node/material/lanes.h"

namespace crosswalk::fe {

template <class N>
struct Tensor {
  N m[3][3];
  N& operator()(int i, int j) { return m[i][j]; }
  const N& operator()(int i, int j) const { return m[i][j]; }
};

/// Order xx, yy, zz, xy, yz, zx.
template <class N>
struct Symmetric {
  N xx, yy, zz, xy, yz, zx;
};

template <class N>
N trace(const Symmetric<N>& a) {
  return a.xx + a.yy + a.zz;
}

/// a : b
template <class N>
N contract(const Symmetric<N>& a, const Symmetric<N>& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}
template <class N>
N contract(const Tensor<N>& a, const Tensor<N>& b) {
  N sum = a(0, 0) * b(0, 0);
  for (int k = 1; k < 9; ++k) sum += a(k / 3, k % 3) * b(k / 3, k % 3);
  return sum;
}

template <class N>
Symmetric<N> combine(const N& s, const Symmetric<N>& a, const N& t, const Symmetric<N>& b) {
  return {s * a.xx + t * b.xx, s * a.yy + t * b.yy, s * a.zz + t * b.zz,
          s * a.xy + t * b.xy, s * a.yz + t * b.yz, s * a.zx + t * b.zx};
}

template <class N>
N determinant(const Tensor<N>& a) {
  return a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) +
         a(0, 1) * (a(1, 2) * a(2, 0) - a(1, 0) * a(2, 2)) +
         a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0));
}

template <class N>
Tensor<N> inverse(const Tensor<N>& a, const N& det) {
  const N s = 1.0 / det;
  Tensor<N> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      r(j, i) = s * (a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1));
    }
  return r;
}

template <class N>
Symmetric<N> inverse(const Symmetric<N>& a) {
  const N cxx = a.yy * a.zz - a.yz * a.yz, cxy = a.yz * a.zx - a.xy * a.zz,
          czx = a.xy * a.yz - a.yy * a.zx;
  const N s = 1.0 / (a.xx * cxx + a.xy * cxy + a.zx * czx);
  return {s * cxx, s * (a.xx * a.zz - a.zx * a.zx), s * (a.xx * a.yy - a.xy * a.xy),
          s * cxy, s * (a.xy * a.zx - a.xx * a.yz), s * czx};
}

/// F^T F
template <class N>
Symmetric<N> right_cauchy_green(const Tensor<N>& F) {
  auto column = [&F](int i, int j) -> N {
    return F(0, i) * F(0, j) + F(1, i) * F(1, j) + F(2, i) * F(2, j);
  };
  return {column(0, 0), column(1, 1), column(2, 2), column(0, 1), column(1, 2), column(2, 0)};
}

/// C^-1 = F^-1 F^-T from F^-1.
template <class N>
Symmetric<N> right_cauchy_green_inverse(const Tensor<N>& F_inverse) {
  auto row = [&F_inverse](int i, int j) -> N {
    return F_inverse(i, 0) * F_inverse(j, 0) + F_inverse(i, 1) * F_inverse(j, 1) +
           F_inverse(i, 2) * F_inverse(j, 2);
  };
  return {row(0, 0), row(1, 1), row(2, 2), row(0, 1), row(1, 2), row(2, 0)};
}

template <class N>
Symmetric<N> zero() {
  const N o = constant<N>(0);
  return {o, o, o, o, o, o};
}

/// A B
template <class N>
Tensor<N> product(const Tensor<N>& a, const Tensor<N>& b) {
  Tensor<N> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return r;
}

/// F S, for example the nominal stress of a second Piola-Kirchhoff stress.
template <class N>
Tensor<N> product(const Tensor<N>& F, const Symmetric<N>& S) {
  Tensor<N> r;
  for (int i = 0; i < 3; ++i) {
    r(i, 0) = F(i, 0) * S.xx + F(i, 1) * S.xy + F(i, 2) * S.zx;
    r(i, 1) = F(i, 0) * S.xy + F(i, 1) * S.yy + F(i, 2) * S.yz;
    r(i, 2) = F(i, 0) * S.zx + F(i, 1) * S.yz + F(i, 2) * S.zz;
  }
  return r;
}

}  // namespace crosswalk::fe
