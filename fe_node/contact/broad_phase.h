// Uniform-grid search: which boxes contain which points. The cost grows with the number of points
// and boxes only, wherever they are.
#pragma once

#include <span>
#include <vector>

#include "common/spatial.h"

namespace crosswalk::fe {

struct Box3 {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void grow(double by) {
    low.array() -= by;
    high.array() += by;
  }
  bool contains(const Vec3& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
  bool is_empty() const { return (low.array() > high.array()).any(); }
};

class BoxGrid {
 public:
  /// Boxes outside `region` are left out.
  BoxGrid(std::span<const Box3> boxes, const Box3& region);
  /// Appends the boxes that contain p, rising.
  void find(const Vec3& p, std::vector<int>& out) const;

 private:
  int cell_of(double coordinate, int axis) const;
  std::span<const Box3> boxes_;
  Box3 region_;
  Vec3 inverse_cell_ = Vec3::Ones();
  int cells_[3] = {1, 1, 1};
  std::vector<int> begin_, items_;
};

}  // namespace crosswalk::fe
