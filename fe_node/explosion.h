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

/// Share of the first stable step below which a run will never end: an element that is crushed flat
/// needs ever smaller steps and is never quite inverted [E].
inline constexpr double kLeastStepShare = 1e-4;

/// Energy from nowhere that is let pass in a coupled run, J, a ten thousandth of what an impact
/// brings: its first windows hold so little that one step's late booking is a large share [E].
inline constexpr double kExplosionFloor = 0.1;

class ExplosionWatch {
 public:
  /// `floor`: energy from nowhere that is let pass, J.
  explicit ExplosionWatch(double floor = 0) : floor_(floor) {}

  /// Once a step. Throws NumericalError with the time, the fastest node, an element and part it
  /// belongs to, and what the contacts hold, when energy has come from nowhere or is not a number.
  void look(const Model& model, const State& state, const Scratch& scratch);
  /// After compute_forces(). Throws NumericalError with the element and part, or the contact, that
  /// asks for a step no run would ever end with.
  void require_step(const Model& model, const State& state, const Scratch& scratch,
                    const StepReport& report);

 private:
  double floor_ = 0;  ///< J
  int steps_ = 0;
  double first_step_ = 0;  ///< s
};

}  // namespace crosswalk::fe
