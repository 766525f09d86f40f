#include "fe_node/state.h"

#include "common/rigid_fit.h"
#include "fe_node/model.h"

namespace crosswalk::fe {
namespace {

bool moves_freely(const Model& model, int node) {
  return model.body_of_node[node] < 0 && model.mass[node] > 0;
}

bool turns_freely(const Model& model, int node) {
  return model.body_of_node[node] < 0 && model.has_rotations() && model.inertia[node] > 0;
}

BodyState initial_body(const RigidBody& body, const Pose& X_WD, const Twist& V_WD) {
  BodyState state;
  state.X_WB = X_WD * Pose{Quat::Identity(), body.origin};
  state.V_WB = V_WD.shifted(X_WD.q * body.origin);
  state.angular_momentum = angular_momentum(body, state.X_WB, state.V_WB.w);
  return state;
}

/// A body of which nodes were given velocities starts with the rigid motion nearest to them.
void start_body(const RigidBody& body, const std::vector<char>& is_started, const State& state,
                BodyState& moved) {
  std::vector<Vec3> x, v;
  for (int n : body.nodes)
    if (is_started[n]) {
      x.push_back(state.nodes[n].position());
      v.push_back(state.nodes[n].velocity());
    }
  if (x.empty()) return;
  moved.V_WB = fit_twist(x, v, std::vector<double>(x.size(), 1.0), moved.X_WB.p);
  moved.angular_momentum = angular_momentum(body, moved.X_WB, moved.V_WB.w);
}

}  // namespace

State initial_state(const Model& model, const Pose& X_WD, const Twist& V_WD) {
  State state;
  const int node_count = model.mesh.node_count();
  state.nodes.resize(node_count);
  if (model.has_rotations()) state.spin.assign(node_count, V_WD.w);
  for (int n = 0; n < node_count; ++n) {
    const Vec3& p_DN = model.mesh.position[n];
    state.nodes[n].set_position(X_WD * p_DN);
    state.nodes[n].set_velocity(V_WD.shifted(X_WD.q * p_DN).v);
    state.nodes[n].inverse_mass = moves_freely(model, n) ? 1.0 / model.mass[n] : 0.0;
    state.nodes[n].inverse_inertia = turns_freely(model, n) ? 1.0 / model.inertia[n] : 0.0;
  }
  std::vector<char> is_started(node_count, 0);
  for (const StartVelocity& start : model.start_velocities)
    for (int n : start.nodes) {
      state.nodes[n].set_velocity(X_WD.q * start.velocity);
      is_started[n] = 1;
    }
  for (const FixedNode& fixed : model.fixed)
    for (int axis = 0; axis < 3; ++axis)
      if (fixed.translation[axis]) state.nodes[fixed.node].v[axis] = 0;
  for (const RigidBody& body : model.bodies) {
    state.bodies.push_back(initial_body(body, X_WD, V_WD));
    start_body(body, is_started, state, state.bodies.back());
  }
  for (const auto& block : model.blocks) {
    state.history.emplace_back(
        static_cast<std::size_t>(block->history_per_group()) * block->group_count(), 0.0);
    block->initialise(state.history.back());
  }
  state.contacts.resize(model.contacts.size());
  return state;
}

}  // namespace crosswalk::fe
