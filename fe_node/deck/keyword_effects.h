// What leaving a keyword out does to a run, for keywords the reader does not interpret.
#pragma once

#include <string_view>

#include "fe_node/deck/control_records.h"

namespace crosswalk::fe {

struct KeywordEffect {
  Effect effect;
  std::string_view reason;  ///< completes "ignored: ..." or "changes the physics: ..."
};

/// `keyword` in upper case, without the star.
KeywordEffect effect_of(std::string_view keyword);

}  // namespace crosswalk::fe
