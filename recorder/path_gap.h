// How far apart the head paths of two runs are: before the head strikes, where a neck of another
// length or place would show, or to the end, for two couplings of one model.
#pragma once

#include <optional>

#include "recorder/analysis.h"

namespace crosswalk::recording {

enum class PathSpan { BeforeHeadContact, Whole };

struct PathGap {
  double largest_mm = 0;
  double time = 0;   ///< s after first leg contact
  double until = 0;  ///< s: the shorter run's end, or the first head contact of either
};

/// Distance of the head's centres of mass, displacements since first leg contact.
std::optional<PathGap> path_gap(const Analysis& a, const Analysis& b,
                                PathSpan span = PathSpan::BeforeHeadContact);

}  // namespace crosswalk::recording
