// Orders points along a Hilbert curve, so that nodes near in space are near in memory.
#pragma once

#include <vector>

#include "common/spatial.h"

namespace crosswalk::fe {

/// Indices of the points in Hilbert order; ties keep their order.
std::vector<int> hilbert_order(const std::vector<Vec3>& points);

}  // namespace crosswalk::fe
