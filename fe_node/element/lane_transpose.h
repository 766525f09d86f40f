// Between one-record-per-node memory and lanes: records become component lanes and back, by a
// transpose in registers where the processor has one, else by plain copies; all give the same bits.
#pragma once

#include <span>

#include "fe_node/material/lanes.h"
#include "fe_node/mesh/node_record.h"

// Eigen's packets are vector types; as template arguments they lose an attribute that does not
// matter.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wignored-attributes"

namespace crosswalk::fe {

/// Doubles per element corner in a corner force array: x, y, z and padding.
inline constexpr int kCornerStride = 4;

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
  __m256d part[kLanes / 4][3];
  for (int half = 0; half < kLanes / 4; ++half) {
    const __m256d a = four(4 * half), b = four(4 * half + 1), c = four(4 * half + 2),
                  d = four(4 * half + 3);
    const __m256d ab = _mm256_unpacklo_pd(a, b), cd = _mm256_unpacklo_pd(c, d);
    part[half][0] = _mm256_permute2f128_pd(ab, cd, 0x20);
    part[half][1] =
        _mm256_permute2f128_pd(_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d), 0x20);
    part[half][2] = _mm256_permute2f128_pd(ab, cd, 0x31);
  }
  const auto whole = [&part](int axis) -> LaneRegister {
#ifdef __AVX512F__
    return _mm512_insertf64x4(_mm512_castpd256_pd512(part[0][axis]), part[1][axis], 1);
#else
    return part[0][axis];
#endif
  };
  x = whole(0);
  y = whole(1);
  z = whole(2);
#else
  for (int lane = 0; lane < kLanes; ++lane) {
    const double* row = row_of(lane);
    x[lane] = row[0];
    y[lane] = row[1];
    z[lane] = row[2];
  }
#endif
}

inline void load_positions(std::span<const NodeRecord> nodes, const int* index, Lanes (&x)[3]) {
  load_rows<4>([&](int lane) { return nodes[index[lane]].x; }, x[0], x[1], x[2]);
}
inline void load_velocities(std::span<const NodeRecord> nodes, const int* index, Lanes (&v)[3]) {
  load_rows<4>([&](int lane) { return nodes[index[lane]].v; }, v[0], v[1], v[2]);
}
/// Components of vectors of nodes.
inline void load_vectors(std::span<const Vec3> vectors, const int* index, Lanes& x, Lanes& y,
                         Lanes& z) {
  load_rows<3>([&](int lane) { return vectors[index[lane]].data(); }, x, y, z);
}

/// Writes one corner of a lane group: `to` is the corner's first double, aligned like Lanes.
inline void store_corner(const Lanes& x, const Lanes& y, const Lanes& z, double* to) {
#ifdef __AVX__
  for (int half = 0; half < kLanes / 4; ++half) {
#ifdef __AVX512F__
    const auto part = [half](const Lanes& a) -> __m256d {
      return half == 0 ? _mm512_castpd512_pd256(a.v) : _mm512_extractf64x4_pd(a.v, 1);
    };
#else
    const auto part = [](const Lanes& a) -> __m256d { return a.v; };
#endif
    const __m256d zero = _mm256_setzero_pd();
    const __m256d xy0 = _mm256_unpacklo_pd(part(x), part(y)),
                  xy1 = _mm256_unpackhi_pd(part(x), part(y)),
                  z0 = _mm256_unpacklo_pd(part(z), zero), z1 = _mm256_unpackhi_pd(part(z), zero);
    double* row = to + 4 * half * kCornerStride;
    _mm256_store_pd(row, _mm256_permute2f128_pd(xy0, z0, 0x20));
    _mm256_store_pd(row + kCornerStride, _mm256_permute2f128_pd(xy1, z1, 0x20));
    _mm256_store_pd(row + 2 * kCornerStride, _mm256_permute2f128_pd(xy0, z0, 0x31));
    _mm256_store_pd(row + 3 * kCornerStride, _mm256_permute2f128_pd(xy1, z1, 0x31));
  }
#else
  for (int lane = 0; lane < kLanes; ++lane) {
    to[lane * kCornerStride] = x[lane];
    to[lane * kCornerStride + 1] = y[lane];
    to[lane * kCornerStride + 2] = z[lane];
    to[lane * kCornerStride + 3] = 0;
  }
#endif
}

}  // namespace crosswalk::fe

#pragma GCC diagnostic pop
