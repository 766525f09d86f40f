// The common time base of a run's channels: sample i is at i * dt relative to time zero.
#pragma once

#include <cmath>
#include <limits>

#include "recorder/channel.h"

namespace crosswalk::recording {

struct TimeGrid {
  double dt = 0;
  long first = 0, last = -1;  ///< sample numbers; time zero is number 0
  std::size_t size() const { return last < first ? 0 : static_cast<std::size_t>(last - first + 1); }
  double time(std::size_t i) const {
    return static_cast<double>(first + static_cast<long>(i)) * dt;
  }
};

/// Linear interpolation onto the grid; NaN outside the series (beyond rounding).
inline std::vector<double> sampled(const Series& series, const TimeGrid& grid) {
  std::vector<double> out(grid.size(), std::numeric_limits<double>::quiet_NaN());
  if (series.size() < 2) return out;
  const double slack = 1e-6 * grid.dt;
  std::size_t k = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double at = grid.time(i);
    if (at < series.t.front() - slack || at > series.t.back() + slack) continue;
    while (k + 2 < series.size() && series.t[k + 1] < at) ++k;
    const double share = (at - series.t[k]) / (series.t[k + 1] - series.t[k]);
    out[i] = series.y[k] + share * (series.y[k + 1] - series.y[k]);
  }
  return out;
}

}  // namespace crosswalk::recording
