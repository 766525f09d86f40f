// Rigid bodies that follow curves: single directions by the reactions that make them do so, all six
// by their twist itself.
#pragma once

#include "fe_node/model.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

/// Velocity over the next step of what follows a curve.
template <class Guide>
double guided_velocity(const Guide& guide, double time, double dt, double before) {
  switch (guide.kind) {
    case MotionKind::Velocity:
      return guide.scale * guide.curve.value(time + 0.5 * dt);
    case MotionKind::Acceleration:
      return before + guide.scale * guide.curve.value(time) * dt;
    case MotionKind::Displacement:
      return guide.scale * (guide.curve.value(time + dt) - guide.curve.value(time)) / dt;
  }
  return 0;
}

/// The wrench on a free body with the reactions that make its guided directions follow their
/// curves; their work is booked.
Wrench guided_wrench(const Model& model, State& state, int body, Wrench wrench, const Vec3& gravity,
                     double kick, double dt);

/// Moves a body of BodyRole::Prescribed and books its kinetic energy and the work that it takes.
void move_prescribed_body(const Model& model, State& state, int body, const Wrench& wrench,
                          const Vec3& gravity, double kick, double dt);

}  // namespace crosswalk::fe
