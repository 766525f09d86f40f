#include "fe_node/element/element_block.h"

#include "common/error.h"

namespace crosswalk::fe {

ElementBlock::ElementBlock(const Mesh& mesh, ElementKind kind, int part,
                           std::vector<int> mesh_elements)
    : kind_(kind),
      part_(part),
      corners_(corner_count(kind)),
      mesh_elements_(std::move(mesh_elements)) {
  CW_ASSERT(!mesh_elements_.empty());
  nodes_.reserve(static_cast<std::size_t>(group_count()) * corners_ * kLanes);
  for (int group = 0; group < group_count(); ++group)
    for (int corner = 0; corner < corners_; ++corner)
      for (int lane = 0; lane < kLanes; ++lane) {
        const int element = std::min(group * kLanes + lane, element_count() - 1);
        nodes_.push_back(mesh.corners(kind, mesh_elements_[element])[corner]);
      }
}

void LaneSums::book(BlockSums& sums) const {
  sums.internal += sum(internal);
  sums.hourglass += sum(hourglass);
  sums.hourglass_dissipated += sum(hourglass_dissipated);
  sums.viscous_dissipated += sum(viscous_dissipated);
  sums.failed += static_cast<int>(sum(failed) + 0.5);
  for (int lane = 0; lane < kLanes; ++lane) {
    const double step = std::sqrt(step_squared[lane]);
    const int element = static_cast<int>(critical_group[lane]) * kLanes + lane;
    const bool is_first = step == sums.stable_step && element < sums.critical_element;
    if (element < 0 || !(step < sums.stable_step || is_first)) continue;
    sums.stable_step = step;
    sums.critical_element = element;
  }
}

Lanes ElementBlock::lane_mask(int group) const {
  if ((group + 1) * kLanes <= element_count()) return Lanes::Ones();
  Lanes mask;
  for (int lane = 0; lane < kLanes; ++lane)
    mask[lane] = group * kLanes + lane < element_count() ? 1.0 : 0.0;
  return mask;
}

}  // namespace crosswalk::fe
