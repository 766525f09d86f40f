// Stops a run that makes energy: an unstable contact or step multiplies it within a few steps, and
// everything after that is noise.
#pragma once

#include "fe_node/model.h"
#include "fe_node/solver.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

/// Energy from nowhere beyond which a run has no meaning, as a share of the largest entry. Ten
/// times what an accepted run may show (5 %) would already be half; a fifth leaves room for coarse
/// runs to finish with a bad balance in their report [E].
inline constexpr double kExplosionShare = 0.2;

/// For so many steps on end: work is booked a step after the motion it makes, which leaves a gap of
/// a step's work where a load sets in on a model at rest.
inline constexpr int kExplosionSteps = 100;

class ExplosionWatch {
 public:
  /// Once a step. Throws NumericalError with the time, the fastest node, an element and part it
  /// belongs to, and what the contacts hold, when energy has come from nowhere or is not a number.
  void look(const Model& model, const State& state, const Scratch& scratch);

 private:
  int steps_ = 0;
};

/// Share of the first stable step below which a run will never end: an element that is crushed flat
/// needs ever smaller steps and is never quite inverted [E].
inline constexpr double kLeastStepShare = 1e-4;

/// Throws NumericalError with the element and part, or the contact, that asks for less.
void require_step(const Model& model, const State& state, const Scratch& scratch,
                  const StepReport& report, double first_step);

}  // namespace crosswalk::fe
