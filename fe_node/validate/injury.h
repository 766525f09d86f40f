// Head injury criterion of a sampled resultant, for tables of component tests; the run's own scores
// belong to the recorder.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/units.h"

namespace crosswalk::fe::validate {

/// Largest (mean g)^2.5 times duration over windows of at most `longest` s; samples hold until the
/// next one.
inline double hic(const std::vector<double>& time, const std::vector<double>& acceleration,
                  double longest) {
  double best = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    double integral = 0;
    for (std::size_t j = i + 1; j < time.size() && time[j] - time[i] <= longest; ++j) {
      integral += acceleration[j] / kStandardGravity * (time[j] - time[j - 1]);
      const double span = time[j] - time[i];
      best = std::max(best, std::pow(integral / span, 2.5) * span);
    }
  }
  return best;
}

}  // namespace crosswalk::fe::validate
