// Runs a model in tests.
#pragma once

#include <cmath>

#include "fe_node/solver.h"

namespace crosswalk::fe {

/// Runs to `end` with equal steps of at most `scale` times the stable one of the start; calls
/// `watch` after each step.
template <class Watch>
void run_until(const Model& model, State& state, double end, double scale, Watch&& watch) {
  Scratch scratch(model, 1);
  const double start = state.time;
  const int steps =
      static_cast<int>(std::ceil((end - start) / (scale * initial_stable_step(model))));
  for (int i = 0; i < steps; ++i) {
    advance_step(model, state, scratch, (end - start) / steps);
    watch();
  }
}

}  // namespace crosswalk::fe
