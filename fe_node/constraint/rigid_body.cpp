#include "fe_node/constraint/rigid_body.h"

namespace crosswalk::fe {

Vec3 angular_momentum(const RigidBody& body, const Pose& X_WB, const Vec3& omega) {
  return X_WB.q * (body.inertia.about_com * (X_WB.q.conjugate() * omega));
}

void move_free_body(const RigidBody& body, const Wrench& wrench, const Vec3& gravity, double kick,
                    double dt, BodyState& state) {
  Vec3 v = state.V_WB.v + kick * (wrench.f / body.inertia.mass + gravity);
  Vec3 L = state.angular_momentum + kick * wrench.tau;
  for (int axis = 0; axis < 3; ++axis) {
    if (body.locked[axis]) v[axis] = 0;
    if (body.locked[axis + 3]) L[axis] = 0;
  }
  const Mat3 inverse_inertia = body.inertia.about_com.inverse();
  Vec3 omega = state.V_WB.w;
  constexpr int kMidpointIterations = 4;  // contraction by |omega| dt, 1e-3 at 1000 rad/s and 1 us
  for (int i = 0; i < kMidpointIterations; ++i) {
    const Quat middle = exp_rotation(0.5 * dt * omega) * state.X_WB.q;
    omega = middle * (inverse_inertia * (middle.conjugate() * L));
    for (int axis = 0; axis < 3; ++axis)
      if (body.locked[axis + 3]) omega[axis] = 0;
  }
  state.angular_momentum = L;
  move_with_twist({v, omega}, dt, state);
}

void move_with_twist(const Twist& V, double dt, BodyState& state) {
  state.V_WB = V;
  state.X_WB.p += dt * V.v;
  state.X_WB.q = (exp_rotation(dt * V.w) * state.X_WB.q).normalized();
}

}  // namespace crosswalk::fe
