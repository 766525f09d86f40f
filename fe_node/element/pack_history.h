// Where each pack of a block (the elements in one number of type N) keeps its history.
#pragma once

#include <span>

#include "fe_node/element/element_block.h"

namespace crosswalk::fe {

template <class N>
class PackHistory {
 public:
  /// `numbers`: that each element keeps. Every group gets the same share of its pack's.
  explicit PackHistory(int numbers)
      : numbers_((numbers + kGroupsPerPack<N> - 1) / kGroupsPerPack<N> * kGroupsPerPack<N>) {}

  /// See ElementBlock::history_per_group().
  int per_group() const { return numbers_ * kLanes / kGroupsPerPack<N>; }
  N* of(std::span<double> history, int pack) const {
    return reinterpret_cast<N*>(history.data()) + std::size_t(numbers_) * pack;
  }
  const N* of(std::span<const double> history, int pack) const {
    return reinterpret_cast<const N*>(history.data()) + std::size_t(numbers_) * pack;
  }

 private:
  int numbers_;
};

}  // namespace crosswalk::fe
