// What the parts of renumber.h share: moving one id, whatever it is kept as.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "fe_node/deck/renumber.h"

namespace crosswalk::fe {

inline constexpr double kLargestId = std::numeric_limits<std::int32_t>::max();

/// Moves ids one by one and remembers whether all of them could be moved.
class Renumbering {
 public:
  explicit Renumbering(const IdOffsets& offsets) : by(offsets) {}

  void operator()(DeckId& id, int offset) { add(id.value, offset); }
  void add(std::int32_t& value, int offset) {
    if (value == 0 || offset == 0) return;
    const std::int64_t size = std::abs(static_cast<std::int64_t>(value)) + offset;
    if (size <= 0 || size > std::numeric_limits<std::int32_t>::max()) {
      fits = false;
      return;
    }
    value = static_cast<std::int32_t>(value < 0 ? -size : size);
  }
  template <class Ids>
  void all(Ids& ids, int offset) {
    for (DeckId& id : ids) (*this)(id, offset);
  }
  /// An id kept as a number: of its size the offset is added, its sign stays.
  void add_to_number(double& value, int offset) {
    if (value == 0 || offset == 0) return;
    if (std::abs(value) + offset > kLargestId || std::abs(value) + offset < 1)
      fits = false;
    else
      value += value < 0 ? -offset : offset;
  }
  /// A field that is a value when positive and minus an id when negative.
  void if_negative(double& value, int offset) {
    if (value < 0) add_to_number(value, offset);
  }

  const IdOffsets& by;
  bool fits = true;
};

/// Materials, equations of state and erosions.
void renumber_materials(Deck& deck, Renumbering& move);

}  // namespace crosswalk::fe
