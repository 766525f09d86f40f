// Forces against the slope of the energy they are made of.
#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "fe_node/state.h"

namespace crosswalk::fe {

/// Central differences of energy() over steps of `h` at every `stride`-th node against minus the
/// force there.
template <class Energy>
void expect_slope(State& state, const std::vector<Vec3>& force, Energy energy, double h,
                  double tolerance, std::size_t stride = 1) {
  for (std::size_t n = 0; n < state.nodes.size(); n += stride)
    for (int i = 0; i < 3; ++i) {
      const double kept = state.nodes[n].x[i];
      state.nodes[n].x[i] = kept + h;
      const double up = energy();
      state.nodes[n].x[i] = kept - h;
      const double down = energy();
      state.nodes[n].x[i] = kept;
      EXPECT_NEAR(force[n][i], -(up - down) / (2 * h), tolerance);
    }
}

}  // namespace crosswalk::fe
