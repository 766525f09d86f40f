#include "fe_node/element/element_block.h"

#include "common/error.h"

namespace crosswalk::fe {

ElementBlock::ElementBlock(const Mesh& mesh, ElementKind kind, int part,
                           std::vector<int> mesh_elements, int groups_per_pack)
    : kind_(kind),
      part_(part),
      corners_(corner_count(kind)),
      mesh_elements_(std::move(mesh_elements)) {
  CW_ASSERT(!mesh_elements_.empty());
  const int pack = kLanes * groups_per_pack;
  group_count_ = (element_count() + pack - 1) / pack * groups_per_pack;
  nodes_.reserve(static_cast<std::size_t>(group_count()) * corners_ * kLanes);
  for (int group = 0; group < group_count(); ++group)
    for (int corner = 0; corner < corners_; ++corner)
      for (int lane = 0; lane < kLanes; ++lane) {
        const int element = std::min(group * kLanes + lane, element_count() - 1);
        nodes_.push_back(mesh.corners(kind, mesh_elements_[element])[corner]);
      }
}

template <class N>
void LaneSums<N>::book(BlockSums& sums) const {
  sums.internal += sum(internal);
  sums.hourglass += sum(hourglass);
  sums.hourglass_dissipated += sum(hourglass_dissipated);
  sums.viscous_dissipated += sum(viscous_dissipated);
  sums.failed += static_cast<int>(sum(failed) + 0.5);
  if (sum(largest_rate) == 0) return;
  for (int lane = 0; lane < kWidth<N>; ++lane) {
    if (critical_pack[lane] < 0) continue;
    const double step = 2 / std::sqrt(largest_rate[lane]);
    const int element = static_cast<int>(critical_pack[lane]) * kWidth<N> + lane;
    const bool is_first = step == sums.least_step && element < sums.critical_element;
    if (!(step < sums.least_step || is_first)) continue;
    sums.least_step = step;
    sums.critical_element = element;
  }
}

template <class N>
N ElementBlock::lane_mask(int pack) const {
  const int first = pack * kWidth<N>;
  if (first + kWidth<N> <= element_count()) return N::Ones();
  N mask;
  for (int lane = 0; lane < kWidth<N>; ++lane)
    mask.set(lane, first + lane < element_count() ? 1 : 0);
  return mask;
}

double ElementBlock::initial_stable_step(int element) const {
  const double stiffness = initial_stiffness(element);
  if (stiffness == 0) return std::numeric_limits<double>::infinity();
  return 2 * std::sqrt(corner_mass(element) / stiffness);
}

Vec3 ElementBlock::centre(std::span<const NodeRecord> nodes, int element) const {
  Vec3 sum = Vec3::Zero();
  for (int corner = 0; corner < corners_; ++corner)
    sum += nodes[node(element / kLanes, corner, element % kLanes)].position();
  return sum / corners_;
}

template struct LaneSums<Lanes>;
template struct LaneSums<SingleLanes>;
template Lanes ElementBlock::lane_mask<Lanes>(int) const;
template SingleLanes ElementBlock::lane_mask<SingleLanes>(int) const;

}  // namespace crosswalk::fe
