// Between one-record-per-node memory and lanes: eight records become component lanes and back. With
// AVX-512 by a transpose in registers, else by plain copies; both give the same bits.
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

/// Lane `l` of the result is component-wise the record of node index[l].
struct NodeLanes {
  Lanes x[3], v[3];
};

inline NodeLanes load_nodes(std::span<const NodeRecord> nodes, const int* index) {
  NodeLanes out;
#ifdef EIGEN_VECTORIZE_AVX512
  using Packet = Eigen::internal::Packet8d;
  Eigen::internal::PacketBlock<Packet, 8> rows;
  for (int lane = 0; lane < kLanes; ++lane)
    rows.packet[lane] = Eigen::internal::pload<Packet>(nodes[index[lane]].x);
  Eigen::internal::ptranspose(rows);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::internal::pstore(out.x[axis].data(), rows.packet[axis]);
    Eigen::internal::pstore(out.v[axis].data(), rows.packet[axis + 4]);
  }
#else
  for (int lane = 0; lane < kLanes; ++lane) {
    const NodeRecord& node = nodes[index[lane]];
    for (int axis = 0; axis < 3; ++axis) {
      out.x[axis][lane] = node.x[axis];
      out.v[axis][lane] = node.v[axis];
    }
  }
#endif
  return out;
}

/// Components of eight vectors of nodes.
inline void load_vectors(std::span<const Vec3> vectors, const int* index, Lanes& x, Lanes& y,
                         Lanes& z) {
#ifdef EIGEN_VECTORIZE_AVX512
  using Packet = Eigen::internal::Packet4d;
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  for (int half = 0; half < kLanes; half += 4) {
    Eigen::internal::PacketBlock<Packet, 4> rows;
    for (int lane = 0; lane < 4; ++lane)
      rows.packet[lane] = _mm256_maskload_pd(vectors[index[half + lane]].data(), three);
    Eigen::internal::ptranspose(rows);
    Eigen::internal::pstore(x.data() + half, rows.packet[0]);
    Eigen::internal::pstore(y.data() + half, rows.packet[1]);
    Eigen::internal::pstore(z.data() + half, rows.packet[2]);
  }
#else
  for (int lane = 0; lane < kLanes; ++lane) {
    const Vec3& v = vectors[index[lane]];
    x[lane] = v.x();
    y[lane] = v.y();
    z[lane] = v.z();
  }
#endif
}

/// Writes one corner of a lane group: `to` is the corner's first double, 64-byte aligned.
inline void store_corner(const Lanes& x, const Lanes& y, const Lanes& z, double* to) {
#ifdef EIGEN_VECTORIZE_AVX512
  using Packet = Eigen::internal::Packet8d;
  Eigen::internal::PacketBlock<Packet, 4> columns;
  columns.packet[0] = Eigen::internal::pload<Packet>(x.data());
  columns.packet[1] = Eigen::internal::pload<Packet>(y.data());
  columns.packet[2] = Eigen::internal::pload<Packet>(z.data());
  columns.packet[3] = Eigen::internal::pset1<Packet>(0.0);
  Eigen::internal::ptranspose(columns);  // two lanes per packet
  for (int pair = 0; pair < 4; ++pair)
    Eigen::internal::pstore(to + pair * 2 * kCornerStride, columns.packet[pair]);
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
