// lane_transpose.h with AVX-512: eight doubles or sixteen floats a register, a node's record in one
// load, and as few shuffles as there can be, for one port does them all.
#pragma once

#include <span>

#include "fe_node/material/lanes.h"
#include "fe_node/mesh/node_record.h"

namespace crosswalk::fe {

namespace lane_detail {

inline __m512d load(const NodeRecord& node) {
  return _mm512_load_pd(reinterpret_cast<const double*>(&node));
}
inline __m256d load(const Vec3& vector) { return _mm256_maskz_loadu_pd(0x7, vector.data()); }

inline __m512 joined(__m256 low, __m256 high) {
  return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
}
inline __m512d joined(__m256d low, __m256d high) {
  return _mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1);
}

// Of the four quarters of two registers: the even ones, and the odd ones.
inline __m512d even_quarters(__m512d a, __m512d b) { return _mm512_shuffle_f64x2(a, b, 0x88); }
inline __m512d odd_quarters(__m512d a, __m512d b) { return _mm512_shuffle_f64x2(a, b, 0xdd); }
inline __m512 even_quarters(__m512 a, __m512 b) { return _mm512_shuffle_f32x4(a, b, 0x88); }
inline __m512 odd_quarters(__m512 a, __m512 b) { return _mm512_shuffle_f32x4(a, b, 0xdd); }

/// Of rows of four in the quarters of four registers, row k, k + 4 and so on in register k: the
/// first three numbers, each of all rows in their order.
inline void transpose_rows(const __m512 (&rows)[4], __m512 (&out)[3]) {
  const __m512 xy01 = _mm512_unpacklo_ps(rows[0], rows[1]),
               xy23 = _mm512_unpacklo_ps(rows[2], rows[3]);
  out[0] = _mm512_shuffle_ps(xy01, xy23, 0x44);
  out[1] = _mm512_shuffle_ps(xy01, xy23, 0xee);
  out[2] = _mm512_shuffle_ps(_mm512_unpackhi_ps(rows[0], rows[1]),
                             _mm512_unpackhi_ps(rows[2], rows[3]), 0x44);
}

}  // namespace lane_detail

template <int kCorners>
void load_corners(std::span<const NodeRecord> nodes, const int* index, Lanes (&x)[kCorners][3],
                  Lanes (&v)[kCorners][3]) {
  using namespace lane_detail;
  for (int corner = 0; corner < kCorners; ++corner) {
    __m512d even[4], odd[4];  // quarters of two records: x and z, y, of position and velocity
#pragma GCC unroll 4
    for (int pair = 0; pair < 4; ++pair) {
      const int* two = index + corner * kLanes + 2 * pair;
      const __m512d a = load(nodes[two[0]]), b = load(nodes[two[1]]);
      even[pair] = _mm512_unpacklo_pd(a, b);
      odd[pair] = _mm512_unpackhi_pd(a, b);
    }
    const auto set = [](__m512d a, __m512d b, Lanes& of_position, Lanes& of_velocity) {
      of_position = DoubleRegister(even_quarters(a, b));
      of_velocity = DoubleRegister(odd_quarters(a, b));
    };
    set(even_quarters(even[0], even[1]), even_quarters(even[2], even[3]), x[corner][0],
        v[corner][0]);
    set(even_quarters(odd[0], odd[1]), even_quarters(odd[2], odd[3]), x[corner][1], v[corner][1]);
    set(odd_quarters(even[0], even[1]), odd_quarters(even[2], even[3]), x[corner][2], v[corner][2]);
  }
}

template <int kCorners>
void load_corners(std::span<const NodeRecord> nodes, const int* index,
                  SingleLanes (&x)[kCorners][3], SingleLanes (&v)[kCorners][3]) {
  using namespace lane_detail;
  for (int i = 0; i < 3; ++i) x[0][i] = v[0][i] = SingleLanes::Zero();
  __m512d origin[2][kLanes];
#pragma GCC unroll 2
  for (int group = 0; group < 2; ++group)
#pragma GCC unroll 8
    for (int lane = 0; lane < kLanes; ++lane)
      origin[group][lane] = load(nodes[index[group * kCorners * kLanes + lane]]);
  for (int corner = 1; corner < kCorners; ++corner) {
    __m512 of_group[2][3];  // quarters: lanes 0 to 3 of position, of velocity, lanes 4 to 7
#pragma GCC unroll 2
    for (int group = 0; group < 2; ++group) {
      const int* own = index + (group * kCorners + corner) * kLanes;
      const auto difference = [&](int lane) {
        return _mm512_cvtpd_ps(_mm512_sub_pd(load(nodes[own[lane]]), origin[group][lane]));
      };
      __m512 rows[4];
#pragma GCC unroll 4
      for (int k = 0; k < 4; ++k) rows[k] = joined(difference(k), difference(k + 4));
      transpose_rows(rows, of_group[group]);
    }
    for (int i = 0; i < 3; ++i) {
      x[corner][i] = SingleRegister(even_quarters(of_group[0][i], of_group[1][i]));
      v[corner][i] = SingleRegister(odd_quarters(of_group[0][i], of_group[1][i]));
    }
  }
}

template <int kCorners>
void load_corner_vectors(std::span<const Vec3> vectors, const int* index, Lanes (&a)[kCorners][3]) {
  using namespace lane_detail;
  for (int corner = 0; corner < kCorners; ++corner) {
    const auto two = [&](int lane) {
      const int* own = index + corner * kLanes + lane;
      return joined(load(vectors[own[0]]), load(vectors[own[2]]));
    };
    const __m512d r02 = two(0), r13 = two(1), r46 = two(4), r57 = two(5);
    const __m512d xz0123 = _mm512_unpacklo_pd(r02, r13), xz4567 = _mm512_unpacklo_pd(r46, r57);
    a[corner][0] = DoubleRegister(even_quarters(xz0123, xz4567));
    a[corner][1] =
        DoubleRegister(even_quarters(_mm512_unpackhi_pd(r02, r13), _mm512_unpackhi_pd(r46, r57)));
    a[corner][2] = DoubleRegister(odd_quarters(xz0123, xz4567));
  }
}

template <int kCorners>
void load_corner_vectors(std::span<const Vec3> vectors, const int* index,
                         SingleLanes (&a)[kCorners][3]) {
  using namespace lane_detail;
  for (int corner = 0; corner < kCorners; ++corner) {
    const auto eight = [&](int group, int k) {
      const int* own = index + (group * kCorners + corner) * kLanes + k;
      return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(load(vectors[own[0]]))),
                                  _mm256_cvtpd_ps(load(vectors[own[4]])), 1);
    };
    __m512 rows[4], out[3];
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) rows[k] = joined(eight(0, k), eight(1, k));
    transpose_rows(rows, out);
    for (int i = 0; i < 3; ++i) a[corner][i] = SingleRegister(out[i]);
  }
}

inline void store_corner(const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& stiffness,
                         double* to, std::size_t /*group_stride*/) {
  // Lanes 0, 2, 4, 6 and 1, 3, 5, 7.
  const __m512d xy[2] = {_mm512_unpacklo_pd(x.v, y.v), _mm512_unpackhi_pd(x.v, y.v)},
                zk[2] = {_mm512_unpacklo_pd(z.v, stiffness.v),
                         _mm512_unpackhi_pd(z.v, stiffness.v)};
  const __m512i first_half = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11),
                second_half = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
#pragma GCC unroll 2
  for (int odd = 0; odd < 2; ++odd) {
    const __m512d low = _mm512_permutex2var_pd(xy[odd], first_half, zk[odd]),
                  high = _mm512_permutex2var_pd(xy[odd], second_half, zk[odd]);
    _mm256_store_pd(to + 4 * odd, _mm512_castpd512_pd256(low));
    _mm256_store_pd(to + 4 * (odd + 2), _mm512_extractf64x4_pd(low, 1));
    _mm256_store_pd(to + 4 * (odd + 4), _mm512_castpd512_pd256(high));
    _mm256_store_pd(to + 4 * (odd + 6), _mm512_extractf64x4_pd(high, 1));
  }
}

inline void store_corner(const SingleLanes& x, const SingleLanes& y, const SingleLanes& z,
                         const SingleLanes& stiffness, double* to, std::size_t group_stride) {
  const __m512 xy[2] = {_mm512_unpacklo_ps(x.v, y.v), _mm512_unpackhi_ps(x.v, y.v)},
               zk[2] = {_mm512_unpacklo_ps(z.v, stiffness.v), _mm512_unpackhi_ps(z.v, stiffness.v)};
  const __m512i first_group =
                    _mm512_setr_epi32(0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23),
                second_group =
                    _mm512_setr_epi32(8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31);
  // Two rows of four floats become two of four doubles, side by side.
  const auto store = [](__m512 rows, double* at) {
    _mm512_store_pd(at, _mm512_cvtps_pd(_mm512_castps512_ps256(rows)));
    _mm512_store_pd(at + 16, _mm512_cvtps_pd(_mm512_extractf32x8_ps(rows, 1)));
  };
#pragma GCC unroll 2
  for (int pair = 0; pair < 2; ++pair) {  // lanes 0, 1 or 2, 3 of every four
    const __m512 a = _mm512_shuffle_ps(xy[pair], zk[pair], 0x44),
                 b = _mm512_shuffle_ps(xy[pair], zk[pair], 0xee);
    store(_mm512_permutex2var_ps(a, first_group, b), to + 8 * pair);
    store(_mm512_permutex2var_ps(a, second_group, b), to + group_stride + 8 * pair);
  }
}

}  // namespace crosswalk::fe
