#include "common/schedule.h"

#include <cmath>

#include "common/error.h"

namespace crosswalk {

int substep_count(double window_s, double stable_step_s) {
  CW_ASSERT(window_s > 0 && stable_step_s > 0);
  // The tolerance keeps a window that is an exact multiple of the step from gaining a substep.
  const double n = std::ceil(window_s / stable_step_s - 1e-9);
  return n < 1 ? 1 : static_cast<int>(n);
}

}  // namespace crosswalk
