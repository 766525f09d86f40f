#include "fe_node/sleeper.h"

#include <algorithm>

#include "common/error.h"
#include "fe_node/model.h"
#include "fe_node/state.h"

namespace crosswalk::fe {
namespace {

void place_nodes(const Model& model, const Pose& X_WD, const Twist& V_WD, State& state) {
  for (int n = model.sleeper->first_node; n < model.mesh.node_count(); ++n) {
    const Vec3& p_DN = model.mesh.position[n];
    state.nodes[n].set_position(X_WD * p_DN);
    state.nodes[n].set_velocity(V_WD.shifted(X_WD.q * p_DN).v);
    if (!state.spin.empty()) state.spin[n] = V_WD.w;
  }
}

}  // namespace

double Sleeper::kinetic(const Pose& X_WB, const Twist& V_WB) const {
  const Pose X_WD = X_WB * X_BD;
  const Vec3 v = V_WB.shifted(X_WD * inertia.com - X_WB.p).v;
  const Vec3 w = X_WD.q.conjugate() * V_WB.w;
  return 0.5 * inertia.mass * v.squaredNorm() + 0.5 * w.dot(inertia.about_com * w);
}

Sleeper make_sleeper(const Model& model, const std::vector<int>& parts, int body,
                     const std::string& contact) {
  const auto holds = [&parts](int part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  Sleeper sleeper;
  sleeper.body = body;
  for (const auto& block : model.blocks) sleeper.blocks.push_back(holds(block->part()));
  for (const auto& c : model.contacts) sleeper.contacts.push_back(c->name() == contact);
  int first = model.mesh.node_count();
  for (ElementKind kind : kElementKinds) {
    const ElementTable& table = model.mesh.table(kind);
    for (int e = 0; e < table.size(); ++e)
      if (holds(table.part[e]))
        for (int n : model.mesh.corners(kind, e)) first = std::min(first, n);
  }
  sleeper.first_node = first;
  for (int n = first; n < model.mesh.node_count(); ++n) {
    CW_ASSERT(model.body_of_node[n] < 0 || model.body_of_node[n] == body);
    if (model.body_of_node[n] < 0)
      sleeper.inertia = sleeper.inertia + Inertia::of_point(model.mass[n], model.mesh.position[n]);
  }
  return sleeper;
}

bool is_asleep(const Model& model, const State& state) {
  return model.sleeper && state.step < state.awake_from;
}

int awake_node_count(const Model& model, const State& state) {
  return is_asleep(model, state) ? model.sleeper->first_node : model.mesh.node_count();
}

void place_sleeper(const Model& model, const Pose& X_WD, const Twist& V_WD, State& state) {
  place_nodes(model, X_WD, V_WD, state);
  const RigidBody& body = model.bodies[model.sleeper->body];
  BodyState& moved = state.bodies[model.sleeper->body];
  moved.X_WB = X_WD * Pose{Quat::Identity(), body.origin};
  moved.V_WB = V_WD.shifted(X_WD.q * body.origin);
}

void carry_sleeper(const Model& model, State& state) {
  const BodyState& body = state.bodies[model.sleeper->body];
  const Pose X_WD = body.X_WB * model.sleeper->X_BD;
  place_nodes(model, X_WD, body.V_WB.shifted(X_WD.p - body.X_WB.p), state);
}

void wake_sleeper(const Model& model, State& state) {
  carry_sleeper(model, state);
  state.awake_from = state.step;
}

}  // namespace crosswalk::fe
