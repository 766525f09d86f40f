// For every node the places of its element corners in a block-wise force array, in a fixed order.
#pragma once

#include <cstdint>
#include <vector>

namespace crosswalk::fe {

struct CornerTable {
  std::vector<int> begin;           ///< node_count + 1 offsets into `slot`
  std::vector<std::uint32_t> slot;  ///< index of the x component; y and z follow
};

}  // namespace crosswalk::fe
