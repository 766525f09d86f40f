#include "fe_node/guided_body.h"

namespace crosswalk::fe {

Wrench guided_wrench(const Model& model, State& state, int body, Wrench wrench, const Vec3& gravity,
                     double kick, double dt) {
  const Inertia& inertia = model.bodies[body].inertia;
  const BodyState& now = state.bodies[body];
  for (const GuidedBody& guide : model.guided_bodies) {
    if (guide.body != body) continue;
    const int axis = guide.axis % 3;
    const bool is_turn = guide.axis >= 3;
    const double before = is_turn ? now.V_WB.w[axis] : now.V_WB.v[axis];
    const double wanted = guided_velocity(guide, state.time, dt, before);
    double reaction = 0;
    if (is_turn) {
      const Vec3 L = angular_momentum(model.bodies[body], now.X_WB, wanted * Vec3::Unit(axis));
      reaction = (L[axis] - now.angular_momentum[axis]) / kick - wrench.tau[axis];
      wrench.tau[axis] += reaction;
    } else {
      reaction = inertia.mass * ((wanted - before) / kick - gravity[axis]) - wrench.f[axis];
      wrench.f[axis] += reaction;
    }
    state.energies.external_work += 0.5 * kick * reaction * (before + wanted);
  }
  return wrench;
}

void move_prescribed_body(const Model& model, State& state, int body, const Wrench& wrench,
                          const Vec3& gravity, double kick, double dt) {
  const RigidBody& rigid = model.bodies[body];
  const double mass = rigid.inertia.mass;
  BodyState& moved = state.bodies[body];
  const Twist before = moved.V_WB;
  const Vec3 momentum = moved.angular_momentum;
  Twist wanted;
  for (const GuidedBody& guide : model.guided_bodies) {
    if (guide.body != body) continue;
    double& into = guide.axis < 3 ? wanted.v[guide.axis] : wanted.w[guide.axis - 3];
    into = guided_velocity(guide, state.time, dt,
                           guide.axis < 3 ? before.v[guide.axis] : before.w[guide.axis - 3]);
  }
  move_with_twist(wanted, dt, moved);
  moved.angular_momentum = angular_momentum(rigid, moved.X_WB, wanted.w);
  const Twist mean{0.5 * (before.v + wanted.v), 0.5 * (before.w + wanted.w)};
  const Wrench reaction{mass * ((wanted.v - before.v) / kick - gravity) - wrench.f,
                        (moved.angular_momentum - momentum) / kick - wrench.tau};
  state.energies.kinetic += 0.5 * mass * before.v.dot(wanted.v) +
                            0.25 * (momentum + moved.angular_momentum).dot(wanted.w);
  state.energies.external_work += kick * (reaction.power(mean) + mass * gravity.dot(mean.v));
}

}  // namespace crosswalk::fe
