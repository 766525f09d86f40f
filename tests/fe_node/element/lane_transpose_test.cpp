// Records into lanes and back, against plain copies: the same bits.
#include "fe_node/element/lane_transpose.h"

#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

namespace crosswalk::fe {
namespace {

constexpr int kNodes = 200;

std::vector<NodeRecord> some_nodes() {
  std::vector<NodeRecord> nodes(kNodes);
  for (int n = 0; n < kNodes; ++n) {
    nodes[n].set_position({100 + std::sin(1.3 * n), std::cos(2.1 * n), 0.01 * n});
    nodes[n].set_velocity({std::sin(3.7 * n), 11 + std::cos(0.4 * n), -0.1 * n});
    nodes[n].inverse_mass = nodes[n].inverse_inertia = 1e30;  // must not be seen
  }
  return nodes;
}

template <class N>
constexpr int kGroups = kWidth<N> / kLanes;

/// Corner, lane in the group, group.
int node_at(int corner, int lane, int group) {
  return (37 * corner + 11 * lane + 71 * group) % kNodes;
}

template <class N, int kCorners>
std::vector<int> index_of_corners() {
  std::vector<int> index;
  for (int group = 0; group < kGroups<N>; ++group)
    for (int corner = 0; corner < kCorners; ++corner)
      for (int lane = 0; lane < kLanes; ++lane) index.push_back(node_at(corner, lane, group));
  return index;
}

template <class N>
class LaneTranspose : public testing::Test {};
using Numbers = testing::Types<Lanes, SingleLanes>;
TYPED_TEST_SUITE(LaneTranspose, Numbers);

TYPED_TEST(LaneTranspose, CornersComeAsTheyAreOrAsDifferences) {
  using N = TypeParam;
  constexpr bool kIsSingle = std::is_same_v<N, SingleLanes>;
  const std::vector<NodeRecord> nodes = some_nodes();
  const std::vector<int> index = index_of_corners<N, 8>();
  N x[8][3], v[8][3];
  load_corners(nodes, index.data(), x, v);
  for (int corner = 0; corner < 8; ++corner)
    for (int lane = 0; lane < kWidth<N>; ++lane) {
      const NodeRecord& node = nodes[node_at(corner, lane % kLanes, lane / kLanes)];
      const NodeRecord& first = nodes[node_at(0, lane % kLanes, lane / kLanes)];
      for (int i = 0; i < 3; ++i) {
        if constexpr (kIsSingle) {
          EXPECT_EQ(x[corner][i][lane],
                    static_cast<double>(static_cast<float>(node.x[i] - first.x[i])));
          EXPECT_EQ(v[corner][i][lane],
                    static_cast<double>(static_cast<float>(node.v[i] - first.v[i])));
        } else {
          EXPECT_EQ(x[corner][i][lane], node.x[i]);
          EXPECT_EQ(v[corner][i][lane], node.v[i]);
        }
      }
    }
}

TYPED_TEST(LaneTranspose, VectorsComeFromPackedMemory) {
  using N = TypeParam;
  std::vector<Vec3> spin;
  for (int n = 0; n < kNodes; ++n) spin.emplace_back(n + 0.25, -n, 1000 + n);
  const std::vector<int> index = index_of_corners<N, 4>();
  N a[4][3];
  load_corner_vectors(spin, index.data(), a);
  for (int corner = 0; corner < 4; ++corner)
    for (int lane = 0; lane < kWidth<N>; ++lane)
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(a[corner][i][lane], spin[node_at(corner, lane % kLanes, lane / kLanes)][i]);
}

TYPED_TEST(LaneTranspose, CornersAreStoredRowByRow) {
  using N = TypeParam;
  constexpr std::size_t kStride = std::size_t{3} * kLanes * kCornerStride;  // of three corners
  alignas(64) double to[kGroups<N> * kStride] = {};
  N part[4];
  for (int k = 0; k < 4; ++k)
    for (int lane = 0; lane < kWidth<N>; ++lane) part[k].set(lane, 100 * k + lane + 0.5);
  store_corner(part[0], part[1], part[2], part[3], to, kStride);
  for (int lane = 0; lane < kWidth<N>; ++lane)
    for (int k = 0; k < 4; ++k)
      EXPECT_EQ(to[lane / kLanes * kStride + std::size_t(lane % kLanes * kCornerStride + k)],
                100 * k + lane + 0.5);
}

TYPED_TEST(LaneTranspose, SumTakesEveryLane) {
  using N = TypeParam;
  N a;
  double expected = 0;
  for (int lane = 0; lane < kWidth<N>; ++lane) {
    a.set(lane, 1 << lane);
    expected += 1 << lane;
  }
  EXPECT_EQ(sum(a), expected);
}

}  // namespace
}  // namespace crosswalk::fe
