#include "fe_node/output/head_motion.h"

#include <algorithm>

#include "common/rigid_fit.h"

namespace crosswalk::fe {

HeadMotion::HeadMotion(const Model& model, std::vector<int> nodes, const Pose& X_DH)
    : nodes_(std::move(nodes)), weight_(nodes_.size(), 1.0), X_DH_(X_DH) {
  const Pose X_HD = X_DH.inverse();
  for (int n : nodes_) reference_.push_back(X_HD * model.mesh.position[n]);
}

HeadMotion::Fit HeadMotion::fit(const State& state) const {
  std::vector<Vec3> x, v;
  x.reserve(nodes_.size());
  v.reserve(nodes_.size());
  for (int n : nodes_) {
    x.push_back(state.nodes[n].position());
    v.push_back(state.nodes[n].velocity());
  }
  Fit result;
  result.X_WH = fit_pose(reference_, x, weight_);
  result.V_WH = fit_twist(x, v, weight_, result.X_WH.p);
  return result;
}

Twist HeadMotion::twist(const State& state) const { return fit(state).V_WH; }

HeadSample HeadMotion::sample(const State& state, std::int64_t t_ns, const Twist& before,
                              double interval) const {
  const Fit now = fit(state);
  HeadSample sample;
  sample.t_ns = t_ns;
  sample.X_WH = now.X_WH;
  sample.V_WH = now.V_WH;
  sample.acceleration = (now.V_WH.v - before.v) / interval;
  sample.angular_acceleration = (now.V_WH.w - before.w) / interval;
  return sample;
}

Inertia inertia_of_parts(const Model& model, const std::vector<int>& parts) {
  const auto is_wanted = [&](int part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  Inertia sum;
  std::vector<char> is_inside(model.mesh.node_count(), 0);
  for (const auto& block : model.blocks) {
    if (!is_wanted(block->part())) continue;
    for (int e = 0; e < block->element_count(); ++e)
      for (int corner = 0; corner < block->corners(); ++corner) {
        const int n = block->node(e / kLanes, corner, e % kLanes);
        is_inside[n] = 1;
        sum = sum + Inertia::of_point(block->corner_mass(e), model.mesh.position[n]);
      }
  }
  for (const RigidBody& body : model.bodies)
    if (!body.parts.empty() && std::all_of(body.parts.begin(), body.parts.end(), is_wanted)) {
      sum = sum + body.own;
      for (int n : body.nodes) is_inside[n] = 1;
    }
  if (!model.point_mass.empty())
    for (int n = 0; n < model.mesh.node_count(); ++n)
      if (is_inside[n] && model.point_mass[n] > 0)
        sum = sum + Inertia::of_point(model.point_mass[n], model.mesh.position[n]);
  return sum;
}

}  // namespace crosswalk::fe
