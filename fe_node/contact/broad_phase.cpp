#include "fe_node/contact/broad_phase.h"

#include <algorithm>
#include <cmath>

namespace crosswalk::fe {

BoxGrid::BoxGrid(std::span<const Box3> boxes, const Box3& region) : boxes_(boxes), region_(region) {
  // places beyond all numbers are left to the watch on energies, which stops the run
  if (boxes.empty() || region.is_empty() || !region.low.allFinite() || !region.high.allFinite()) {
    begin_.assign(2, 0);
    return;
  }
  // cells of the mean box, at most a few per box
  Vec3 mean = Vec3::Zero();
  for (const Box3& box : boxes)
    if (!box.is_empty()) mean += (box.high - box.low) / static_cast<double>(boxes.size());
  const Vec3 extent = (region.high - region.low).cwiseMax(1e-12);
  double cell = std::max(1e-12, mean.maxCoeff());  // also when the mean is no number
  const double limit = 4.0 * static_cast<double>(boxes.size()) + 64;
  auto count = [&] {
    double total = 1;
    for (int axis = 0; axis < 3; ++axis) total *= std::floor(extent[axis] / cell) + 1;
    return total;
  };
  while (count() > limit) cell *= 1.26;
  for (int axis = 0; axis < 3; ++axis) {
    cells_[axis] = static_cast<int>(extent[axis] / cell) + 1;
    inverse_cell_[axis] = 1 / cell;
  }

  begin_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
  auto for_each_cell = [&](auto&& visit) {
    for (int b = 0; b < static_cast<int>(boxes.size()); ++b) {
      const Box3& box = boxes[b];
      if (box.is_empty() || (box.low.array() > region.high.array()).any() ||
          (box.high.array() < region.low.array()).any())
        continue;
      int low[3], high[3];
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = cell_of(box.low[axis], axis);
        high[axis] = cell_of(box.high[axis], axis);
      }
      for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
          for (int i = low[0]; i <= high[0]; ++i) visit((k * cells_[1] + j) * cells_[0] + i, b);
    }
  };
  for_each_cell([&](int cell_index, int) { ++begin_[cell_index + 1]; });
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  items_.resize(begin_.back());
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for_each_cell([&](int cell_index, int box) { items_[next[cell_index]++] = box; });
}

int BoxGrid::cell_of(double coordinate, int axis) const {
  const double place = (coordinate - region_.low[axis]) * inverse_cell_[axis];
  if (!(place > 0)) return 0;  // also when it is no number
  return static_cast<int>(std::min(place, static_cast<double>(cells_[axis] - 1)));
}

void BoxGrid::find(const Vec3& p, std::vector<int>& out) const {
  if (items_.empty() || !region_.contains(p)) return;
  const int cell =
      (cell_of(p.z(), 2) * cells_[1] + cell_of(p.y(), 1)) * cells_[0] + cell_of(p.x(), 0);
  for (int k = begin_[cell]; k < begin_[cell + 1]; ++k)
    if (boxes_[items_[k]].contains(p)) out.push_back(items_[k]);
}

}  // namespace crosswalk::fe
