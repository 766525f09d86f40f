// Between one-record-per-node memory and lanes: records become component lanes and back, by a
// transpose in registers where the processor has one, else by plain copies; all give the same bits.
//
//   load_corners         positions and velocities of the corners of the elements in one register.
//                        `index`: their nodes, kLanes of each corner, group after group. Single
//                        lanes are counted from the first corner, in double until then: an element
//                        asks for nothing else, and nothing is lost of what near numbers differ by.
//   load_corner_vectors  one vector a node, likewise
//   store_corner         a corner's vector and the stiffness that goes with it, four doubles an
//                        element. `to`: the place in the first group, aligned like Lanes;
//                        `group_stride`: doubles from there to the next group's.
#pragma once

#include <span>

#include "fe_node/material/lanes.h"
#include "fe_node/mesh/node_record.h"

// Eigen's packets are vector types; as template arguments they lose an attribute that does not
// matter.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wignored-attributes"

namespace crosswalk::fe {

/// Doubles per element corner in a corner force array: x, y, z and the corner's stiffness.
inline constexpr int kCornerStride = 4;
/// Place of the stiffness among them.
inline constexpr int kCornerStiffness = 3;

}  // namespace crosswalk::fe

#ifdef __AVX512F__
#include "fe_node/element/lane_transpose_avx512.h"
#else

namespace crosswalk::fe {

/// The first three numbers of four or eight rows of doubles, as lanes. Rows of kWidth doubles may
/// be read: four, or three where nothing may follow the third.
template <int kWidth, class RowOf>
void load_rows(RowOf row_of, Lanes& x, Lanes& y, Lanes& z) {
#ifdef __AVX__
  const auto four = [&](int lane) {
    const double* row = row_of(lane);
    if constexpr (kWidth == 4) return _mm256_load_pd(row);
    return _mm256_maskload_pd(row, _mm256_setr_epi64x(-1, -1, -1, 0));
  };
  const __m256d a = four(0), b = four(1), c = four(2), d = four(3);
  const __m256d ab = _mm256_unpacklo_pd(a, b), cd = _mm256_unpacklo_pd(c, d);
  x = DoubleRegister(_mm256_permute2f128_pd(ab, cd, 0x20));
  y = DoubleRegister(
      _mm256_permute2f128_pd(_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d), 0x20));
  z = DoubleRegister(_mm256_permute2f128_pd(ab, cd, 0x31));
#else
  for (int lane = 0; lane < kLanes; ++lane) {
    const double* row = row_of(lane);
    x.set(lane, row[0]);
    y.set(lane, row[1]);
    z.set(lane, row[2]);
  }
#endif
}

/// Two registers of doubles rounded into one.
inline SingleLanes joined(const Lanes& first, const Lanes& second) {
#ifdef __AVX__
  return SingleRegister(_mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(first.v)),
                                             _mm256_cvtpd_ps(second.v), 1));
#else
  SingleLanes both;
  for (int lane = 0; lane < kLanes; ++lane) {
    both.set(lane, first[lane]);
    both.set(kLanes + lane, second[lane]);
  }
  return both;
#endif
}

/// The first three numbers of rows of four doubles less those of other rows, as single lanes:
/// nothing is lost of what near numbers differ by.
template <class RowOf, class OriginOf>
void load_differences(RowOf row_of, OriginOf origin_of, SingleLanes& x, SingleLanes& y,
                      SingleLanes& z) {
#ifdef __AVX__
  const auto difference = [&](int lane) {
    return _mm256_cvtpd_ps(
        _mm256_sub_pd(_mm256_load_pd(row_of(lane)), _mm256_load_pd(origin_of(lane))));
  };
  __m256 rows[4];  // of lanes k and k + 4
  for (int k = 0; k < 4; ++k)
    rows[k] = _mm256_insertf128_ps(_mm256_castps128_ps256(difference(k)), difference(k + 4), 1);
  const __m256 xy01 = _mm256_unpacklo_ps(rows[0], rows[1]),
               xy23 = _mm256_unpacklo_ps(rows[2], rows[3]);
  x = SingleRegister(_mm256_shuffle_ps(xy01, xy23, 0x44));
  y = SingleRegister(_mm256_shuffle_ps(xy01, xy23, 0xee));
  z = SingleRegister(_mm256_shuffle_ps(_mm256_unpackhi_ps(rows[0], rows[1]),
                                       _mm256_unpackhi_ps(rows[2], rows[3]), 0x44));
#else
  for (int lane = 0; lane < kWidth<SingleLanes>; ++lane) {
    const double *row = row_of(lane), *origin = origin_of(lane);
    x.set(lane, row[0] - origin[0]);
    y.set(lane, row[1] - origin[1]);
    z.set(lane, row[2] - origin[2]);
  }
#endif
}

template <int kCorners>
void load_corners(std::span<const NodeRecord> nodes, const int* index, Lanes (&x)[kCorners][3],
                  Lanes (&v)[kCorners][3]) {
  for (int corner = 0; corner < kCorners; ++corner) {
    const auto node = [&](int lane) -> const NodeRecord& {
      return nodes[index[corner * kLanes + lane]];
    };
    load_rows<4>([&](int lane) { return node(lane).x; }, x[corner][0], x[corner][1], x[corner][2]);
    load_rows<4>([&](int lane) { return node(lane).v; }, v[corner][0], v[corner][1], v[corner][2]);
  }
}
template <int kCorners>
void load_corners(std::span<const NodeRecord> nodes, const int* index,
                  SingleLanes (&x)[kCorners][3], SingleLanes (&v)[kCorners][3]) {
  const auto node = [&](int corner, int lane) -> const NodeRecord& {
    return nodes[index[(lane / kLanes * kCorners + corner) * kLanes + lane % kLanes]];
  };
  for (int i = 0; i < 3; ++i) x[0][i] = v[0][i] = SingleLanes::Zero();
  for (int corner = 1; corner < kCorners; ++corner) {
    load_differences([&](int lane) { return node(corner, lane).x; },
                     [&](int lane) { return node(0, lane).x; }, x[corner][0], x[corner][1],
                     x[corner][2]);
    load_differences([&](int lane) { return node(corner, lane).v; },
                     [&](int lane) { return node(0, lane).v; }, v[corner][0], v[corner][1],
                     v[corner][2]);
  }
}
template <int kCorners>
void load_corner_vectors(std::span<const Vec3> vectors, const int* index, Lanes (&a)[kCorners][3]) {
  for (int corner = 0; corner < kCorners; ++corner)
    load_rows<3>([&](int lane) { return vectors[index[corner * kLanes + lane]].data(); },
                 a[corner][0], a[corner][1], a[corner][2]);
}
template <int kCorners>
void load_corner_vectors(std::span<const Vec3> vectors, const int* index,
                         SingleLanes (&a)[kCorners][3]) {
  Lanes first[kCorners][3], second[kCorners][3];
  load_corner_vectors(vectors, index, first);
  load_corner_vectors(vectors, index + kCorners * kLanes, second);
  for (int corner = 0; corner < kCorners; ++corner)
    for (int i = 0; i < 3; ++i) a[corner][i] = joined(first[corner][i], second[corner][i]);
}

inline void store_corner(const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& stiffness,
                         double* to, std::size_t /*group_stride*/) {
#ifdef __AVX__
  const __m256d xy0 = _mm256_unpacklo_pd(x.v, y.v), xy1 = _mm256_unpackhi_pd(x.v, y.v),
                z0 = _mm256_unpacklo_pd(z.v, stiffness.v),
                z1 = _mm256_unpackhi_pd(z.v, stiffness.v);
  _mm256_store_pd(to, _mm256_permute2f128_pd(xy0, z0, 0x20));
  _mm256_store_pd(to + kCornerStride, _mm256_permute2f128_pd(xy1, z1, 0x20));
  _mm256_store_pd(to + 2 * kCornerStride, _mm256_permute2f128_pd(xy0, z0, 0x31));
  _mm256_store_pd(to + 3 * kCornerStride, _mm256_permute2f128_pd(xy1, z1, 0x31));
#else
  for (int lane = 0; lane < kLanes; ++lane) {
    to[lane * kCornerStride] = x[lane];
    to[lane * kCornerStride + 1] = y[lane];
    to[lane * kCornerStride + 2] = z[lane];
    to[lane * kCornerStride + kCornerStiffness] = stiffness[lane];
  }
#endif
}

inline void store_corner(const SingleLanes& x, const SingleLanes& y, const SingleLanes& z,
                         const SingleLanes& stiffness, double* to, std::size_t group_stride) {
#ifdef __AVX__
  const __m256 xy01 = _mm256_unpacklo_ps(x.v, y.v), xy23 = _mm256_unpackhi_ps(x.v, y.v),
               z01 = _mm256_unpacklo_ps(z.v, stiffness.v),
               z23 = _mm256_unpackhi_ps(z.v, stiffness.v);
  const __m256 rows[4] = {// of lanes k and k + 4
                          _mm256_shuffle_ps(xy01, z01, 0x44), _mm256_shuffle_ps(xy01, z01, 0xee),
                          _mm256_shuffle_ps(xy23, z23, 0x44), _mm256_shuffle_ps(xy23, z23, 0xee)};
  for (int k = 0; k < 4; ++k) {
    double* row = to + k * kCornerStride;
    _mm256_store_pd(row, _mm256_cvtps_pd(_mm256_castps256_ps128(rows[k])));
    _mm256_store_pd(row + group_stride, _mm256_cvtps_pd(_mm256_extractf128_ps(rows[k], 1)));
  }
#else
  for (int lane = 0; lane < kWidth<SingleLanes>; ++lane) {
    double* row = to + lane / kLanes * group_stride + std::size_t(lane % kLanes) * kCornerStride;
    row[0] = x[lane];
    row[1] = y[lane];
    row[2] = z[lane];
    row[kCornerStiffness] = stiffness[lane];
  }
#endif
}

}  // namespace crosswalk::fe

#endif

#pragma GCC diagnostic pop
