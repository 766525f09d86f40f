#include "fe_node/boundary.h"

#include <algorithm>

#include "common/error.h"
#include "common/schedule.h"

namespace crosswalk::fe {
namespace {

/// Twists of all interface bodies, six numbers each.
Eigen::VectorXd stacked_velocities(const FeGrant& grant) {
  Eigen::VectorXd V(6 * grant.drives.size());
  for (std::size_t k = 0; k < grant.drives.size(); ++k)
    V.segment<6>(6 * k) = stack(grant.drives[k].V_WB);
  return V;
}

/// Puts the drives' starting values into the state and returns the gaps.
std::vector<BodyLoad> begin_window(const Boundary& boundary, const FeGrant& grant, State& state) {
  std::vector<BodyLoad> loads(boundary.bodies.size());
  for (std::size_t k = 0; k < boundary.bodies.size(); ++k) {
    BodyState& body = state.bodies[boundary.bodies[k]];
    const BodyDrive& drive = grant.drives[k];
    loads[k].gap_position = drive.X_WB.p - body.X_WB.p;
    loads[k].gap_rotation = log_rotation(drive.X_WB.q * body.X_WB.q.conjugate());
    body.V_WB = drive.V_WB;
    if (static_cast<int>(k) >= boundary.attached) body.X_WB = drive.X_WB;
  }
  return loads;
}

double kick_length(const State& state, double dt) { return 0.5 * (state.last_dt + dt); }

double stable_step_of(const Model& model, State& state, Scratch& scratch) {
  if (model.settings.fixed_step > 0) return model.settings.fixed_step;
  if (state.stable_step <= 0) {
    State trial = state;  // forces of the start, without touching histories
    state.stable_step = compute_forces(model, trial, scratch).stable_step;
  }
  return model.settings.step_scale * state.stable_step;
}

Vec3 mass_centre(const Model& model, const State& state, int body) {
  return state.bodies[body].X_WB * model.bodies[body].inertia.com;
}

}  // namespace

std::vector<Inertia> rebase_bodies(const Boundary& boundary,
                                   const std::vector<InterfaceBody>& partners, Model& model,
                                   State& state) {
  std::vector<Inertia> handed_over;
  for (std::size_t k = 0; k < boundary.bodies.size(); ++k) {
    RigidBody& body = model.bodies[boundary.bodies[k]];
    BodyState& moved = state.bodies[boundary.bodies[k]];
    const Pose& X_WP = partners[k].motion.X_WB;
    const Pose X_PB = X_WP.inverse() * moved.X_WB;
    for (Vec3& p : body.p_BN) p = X_PB * p;
    body.inertia = body.inertia.in(X_PB);
    moved.X_WB = X_WP;
    moved.V_WB = partners[k].motion.V_WB;
    Inertia about_point = body.inertia.in({X_WP.q, Vec3::Zero()});
    if (static_cast<int>(k) >= boundary.attached) about_point = Inertia{};
    handed_over.push_back(about_point);
  }
  return handed_over;
}

WindowLoads advance_window(const Model& model, const Boundary& boundary, const FeGrant& grant,
                           State& state, Scratch& scratch, ExplosionWatch* watch) {
  const int count = static_cast<int>(boundary.bodies.size()), attached = boundary.attached;
  CW_ASSERT(static_cast<int>(grant.drives.size()) == count);
  const bool yields = grant.mobility.size() > 0;  // else the blocks follow the drives exactly
  CW_ASSERT(!yields ||
            (grant.mobility.rows() == 6 * attached && grant.mobility.cols() == 6 * attached));
  const double window = grant.id.length_s();
  const int substeps = substep_count(window, stable_step_of(model, state, scratch));
  const double dt = window / substeps;

  WindowLoads result;
  result.substeps = substeps;
  result.step = dt;
  result.blocks.resize(attached);
  result.loads = begin_window(boundary, grant, state);
  Eigen::VectorXd V = stacked_velocities(grant);
  Eigen::VectorXd excess(6 * attached);
  std::vector<Vec3> before(attached);
  const double gap_time = std::max(kGapTime, window);
  for (int j = 0; j < substeps; ++j) {
    if (watch) watch->look(model, state, scratch);
    const StepReport report = compute_forces(model, state, scratch);
    state.stable_step = report.stable_step;
    if (watch) watch->require_step(model, state, scratch, report);
    const double kick = kick_length(state, dt);
    for (int k = 0; k < count; ++k) {
      const Vec6 F = stack(scratch.body_wrench[boundary.bodies[k]]);
      result.loads[k].impulse += kick * F;
      V.segment<6>(6 * k) += dt / window * grant.drives[k].twist_change;
      if (k < attached) excess.segment<6>(6 * k) = F - grant.drives[k].bias;
    }
    if (yields) V.head(6 * attached).noalias() += kick * (grant.mobility * excess);
    for (int k = 0; k < count; ++k) {
      Twist command = twist_from(V.segment<6>(6 * k));
      if (k < attached) {
        command.v += result.loads[k].gap_position / gap_time;
        command.w += result.loads[k].gap_rotation / gap_time;
      }
      scratch.body_command[boundary.bodies[k]] = command;
    }
    const bool is_shown = j == 0 || j == substeps - 1;
    for (int k = 0; k < attached && is_shown; ++k)
      before[k] = mass_centre(model, state, boundary.bodies[k]);
    move(model, state, scratch, dt);
    for (int k = 0; k < attached && is_shown; ++k) {
      const int body = boundary.bodies[k];
      BlockTwists& block = result.blocks[k];
      block.last = {(mass_centre(model, state, body) - before[k]) / dt, state.bodies[body].V_WB.w};
      if (j == 0) block.first = block.last;
    }
  }
  for (int k = 0; k < count; ++k) result.loads[k].twist_end = twist_from(V.segment<6>(6 * k));
  return result;
}

}  // namespace crosswalk::fe
