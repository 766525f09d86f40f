// How far apart the head paths of two runs are before the head strikes: a neck of another length or
// place would show here.
#pragma once

#include <optional>

#include "recorder/analysis.h"

namespace crosswalk::recording {

struct PathGap {
  double largest_mm = 0;
  double time = 0;   ///< s after first leg contact
  double until = 0;  ///< s: the first head contact of either run, or the shorter run's end
};

/// Distance of the head's centres of mass, displacements since first leg contact.
std::optional<PathGap> path_gap(const Analysis& a, const Analysis& b);

}  // namespace crosswalk::recording
