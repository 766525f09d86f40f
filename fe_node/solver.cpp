#include "fe_node/solver.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.h"
#include "fe_node/element_forces.h"
#include "fe_node/guided_body.h"

namespace crosswalk::fe {
namespace {

constexpr int kNodesPerChunk = Scratch::kNodesPerChunk;

void forget_loads(Scratch& scratch) {
  for (int n : scratch.loaded) scratch.applied[n].setZero();
  scratch.loaded.clear();
}

void apply(Scratch& scratch, int node, const Vec3& force) {
  scratch.applied[node] += force;
  scratch.loaded.push_back(node);
}

/// Force on a node: its rows in the order of the tiles, the same bits for any number of threads,
/// and what has been applied.
Vec3 force_on(const Model& model, const Scratch& scratch, int node) {
  const Vec3 force = sum_of_rows(model.tiles.force_rows, scratch.force_rows.data(), node);
  return scratch.loaded.empty() ? force : Vec3(force + scratch.applied[node]);
}

Vec3 moment_on(const Model& model, const Scratch& scratch, int node) {
  return sum_of_rows(model.tiles.moment_rows, scratch.moment_rows.data(), node);
}

void contact_forces(const Model& model, State& state, Scratch& scratch, StepReport& report) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    scratch.body_views[b] = {state.bodies[b].X_WB, state.bodies[b].V_WB};
    scratch.contact_loads.on_body[b] = Wrench{};
  }
  scratch.contact_loads.nodal.clear();
  const ContactContext context{state.nodes,     model.contact_mass, scratch.body_views,
                               state.time,      state.last_dt,      state.step,
                               scratch.threads, &scratch.failed};
  state.energies.contact_stored = 0;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const bool sleeps = model.sleeper && model.sleeper->contacts[c];
    const std::int64_t first_step = sleeps ? state.awake_from : 0;
    scratch.contact_reports[c] = {};
    if (state.step < first_step) continue;
    if (state.step == first_step) model.contacts[c]->initialise(state.contacts[c], context);
    const ContactReport r =
        model.contacts[c]->forces(context, state.contacts[c], scratch.contact_loads);
    scratch.contact_reports[c] = r;
    state.contacts[c].friction_dissipated += r.friction_dissipated;
    state.contacts[c].damping_dissipated += r.damping_dissipated;
    state.energies.contact_stored += r.stored;
    state.energies.contact_dissipated += r.friction_dissipated + r.damping_dissipated;
    if (r.stable_step < report.stable_step) {
      report.stable_step = r.stable_step;
      report.critical_block = report.critical_element = -1;
    }
  }
  for (const NodalLoad& load : scratch.contact_loads.nodal) apply(scratch, load.node, load.force);
}

void nodal_loads(const Model& model, State& state, Scratch& scratch) {
  for (const NodalForce& load : model.nodal_forces) {
    const Vec3 force = load.scale * load.curve.value(state.time) * load.direction;
    for (int n : load.nodes) {
      apply(scratch, n, force);
      state.energies.external_work += state.last_dt * force.dot(state.nodes[n].velocity());
    }
  }
}

/// A quarter of p A on each corner of a quadrilateral, a third on a triangle's; the area vector is
/// exact for the bilinear facet.
void pressure_loads(const Model& model, State& state, Scratch& scratch) {
  for (const PressureLoad& load : model.pressures) {
    const double pressure = load.scale * load.curve.value(state.time);
    for (const std::array<int, 4>& n : load.facets) {
      const int corners = n[3] == n[2] ? 3 : 4;
      const Vec3 a = state.nodes[n[2]].position() - state.nodes[n[0]].position(),
                 b = state.nodes[n[3]].position() - state.nodes[n[1]].position();
      const Vec3 force = -pressure / (2.0 * corners) * a.cross(b);
      for (int c = 0; c < corners; ++c) {
        apply(scratch, n[c], force);
        state.energies.external_work += state.last_dt * force.dot(state.nodes[n[c]].velocity());
      }
    }
  }
}

/// A tied node hands its force to the nodes it follows.
void tied_loads(const Model& model, Scratch& scratch) {
  for (const TiedNode& tie : model.tied) {
    const Vec3 force = force_on(model, scratch, tie.node);
    for (int i = 0; i < tie.count; ++i) apply(scratch, tie.master[i], tie.weight[i] * force);
  }
}

/// Forces on the nodes that bodies, guides and supports ask for; the others' are added up as they
/// move.
void gather_constrained_forces(const Model& model, const State& state, Scratch& scratch) {
  const int node_count = awake_node_count(model, state);
  const int count = static_cast<int>(scratch.constrained.size());
#pragma omp parallel for schedule(static) num_threads(scratch.threads)
  for (int i = 0; i < count; ++i) {
    const int n = scratch.constrained[i];
    if (n >= node_count) continue;
    scratch.force[n] = force_on(model, scratch, n);
    if (model.has_rotations()) scratch.moment[n] = moment_on(model, scratch, n);
  }
}

bool carries_sleeper(const Model& model, const State& state, std::size_t body) {
  return is_asleep(model, state) && static_cast<int>(body) == model.sleeper->body;
}

void sum_body_wrenches(const Model& model, const State& state, Scratch& scratch) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    Wrench wrench = scratch.contact_loads.on_body[b];
    scratch.body_wrench[b] = wrench;
    if (carries_sleeper(model, state, b)) continue;
    for (int n : model.bodies[b].nodes) {
      const Vec3& f = scratch.force[n];
      wrench.f += f;
      wrench.tau += (state.nodes[n].position() - state.bodies[b].X_WB.p).cross(f);
      if (model.has_rotations()) wrench.tau += scratch.moment[n];
    }
    scratch.body_wrench[b] = wrench;
  }
}

/// Factors of a kick with mass damping alpha on the mean of both velocities, so that damping costs
/// no stable step: v+ = keep v- + gain a.
struct Kick {
  double length, keep, gain;
  Kick(double length_s, double alpha)
      : length(length_s),
        keep((1 - 0.5 * length_s * alpha) / (1 + 0.5 * length_s * alpha)),
        gain(length_s / (1 + 0.5 * length_s * alpha)) {}
};

Vec3 gravity_at(const Model& model, double time) {
  Vec3 sum = model.settings.gravity;
  for (const BaseAcceleration& a : model.base_accelerations)
    sum += a.scale * a.curve.value(time) * a.direction;
  return sum;
}

/// Adds the reactions that make constrained nodes do what they must; the work of guided ones is
/// booked.
void apply_constraints(const Model& model, State& state, Scratch& scratch, const Kick& kick,
                       double dt) {
  const Vec3 gravity = gravity_at(model, state.time);
  for (const GuidedNodes& guide : model.guided)
    for (int n : guide.nodes) {
      const double before = state.nodes[n].velocity().dot(guide.direction);
      const double wanted = guided_velocity(guide, state.time, dt, before);
      const double needed = model.mass[n] * ((wanted - kick.keep * before) / kick.gain -
                                             gravity.dot(guide.direction));
      const double reaction = needed - scratch.force[n].dot(guide.direction);
      scratch.force[n] += reaction * guide.direction;
      state.energies.external_work += 0.5 * kick.length * reaction * (before + wanted);
    }
  for (std::size_t i = 0; i < model.fixed.size(); ++i) {
    const FixedNode& fixed = model.fixed[i];
    scratch.held[i] = state.nodes[fixed.node].position();
    for (int axis = 0; axis < 3; ++axis) {
      if (fixed.translation[axis])
        scratch.force[fixed.node][axis] = -model.mass[fixed.node] * gravity[axis];
      if (fixed.rotation[axis] && model.has_rotations()) scratch.moment[fixed.node][axis] = 0;
    }
  }
}

/// Takes the round-off out of fixed directions.
void hold_fixed_nodes(const Model& model, State& state, const Scratch& scratch) {
  for (std::size_t i = 0; i < model.fixed.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (model.fixed[i].translation[axis]) {
        NodeRecord& node = state.nodes[model.fixed[i].node];
        node.v[axis] = 0;
        node.x[axis] = scratch.held[i][axis];
      }
}

/// Kick and drift of the nodes that no body carries, in one pass through memory; constrained ones
/// are put right afterwards.
void integrate(const Model& model, State& state, Scratch& scratch, const Kick& kick, double dt) {
  const Vec3 gravity = gravity_at(model, state.time);
  const bool has_gravity = !gravity.isZero(0);
  const double damping = model.settings.mass_damping;
  const int node_count = awake_node_count(model, state);
  const int weighed = model.sleeper ? model.sleeper->first_node : node_count;
  const int chunk_count = (node_count + kNodesPerChunk - 1) / kNodesPerChunk;
#pragma omp parallel for schedule(static) num_threads(scratch.threads)
  for (int c = 0; c < chunk_count; ++c) {
    double kinetic = 0, gravity_work = 0, damped = 0;
    const int last = std::min((c + 1) * kNodesPerChunk, node_count);
    for (int n = c * kNodesPerChunk; n < last; ++n) {
      NodeRecord& node = state.nodes[n];
      const bool is_constrained = scratch.is_constrained[n];
      if (node.inverse_mass > 0) {
        const Vec3 force = is_constrained ? scratch.force[n] : force_on(model, scratch, n);
        Eigen::Map<Vec3> velocity(node.v), position(node.x);
        const Vec3 before = velocity;
        Vec3 a = node.inverse_mass * force;
        if (has_gravity && n < weighed) a += gravity;
        const Vec3 after = kick.keep * before + kick.gain * a;
        const double half_mass = 0.5 / node.inverse_mass;
        kinetic += half_mass * before.dot(after);
        if (has_gravity && n < weighed)
          gravity_work += kick.length * half_mass * gravity.dot(before + after);
        if (damping > 0)
          damped += 0.5 * kick.length * damping * half_mass * (before + after).squaredNorm();
        velocity = after;
        position += dt * after;
      }
      if (node.inverse_inertia > 0) {
        const Vec3 moment = is_constrained ? scratch.moment[n] : moment_on(model, scratch, n);
        const Vec3 before = state.spin[n];
        state.spin[n] = kick.keep * before + kick.gain * node.inverse_inertia * moment;
        kinetic += 0.5 / node.inverse_inertia * before.dot(state.spin[n]);
      }
    }
    scratch.node_sums[c] = {kinetic, gravity_work, damped};
  }
  state.energies.kinetic = 0;
  for (int c = 0; c < chunk_count; ++c) {
    const auto& [kinetic, gravity_work, damped] = scratch.node_sums[c];
    state.energies.kinetic += kinetic;
    state.energies.external_work += gravity_work;
    state.energies.damping += damped;
  }
}

void move_nodes_of(const RigidBody& body, const BodyState& moved, double dt, State& state) {
  const Mat3 R = moved.X_WB.R();
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    NodeRecord& node = state.nodes[body.nodes[i]];
    const Vec3 x = moved.X_WB.p + R * body.p_BN[i];
    node.set_velocity((x - node.position()) / dt);
    node.set_position(x);
    if (!state.spin.empty()) state.spin[body.nodes[i]] = moved.V_WB.w;
  }
}

void move_bodies(const Model& model, State& state, Scratch& scratch, double kick, double dt) {
  const Vec3 gravity = gravity_at(model, state.time);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const RigidBody& body = model.bodies[b];
    BodyState& moved = state.bodies[b];
    const BodyState start = moved;
    const Twist& before = start.V_WB;
    if (body.role == BodyRole::Free) {
      const Vec3 momentum = moved.angular_momentum;
      const Wrench wrench = guided_wrench(model, state, static_cast<int>(b), scratch.body_wrench[b],
                                          gravity, kick, dt);
      move_free_body(body, wrench, gravity, kick, dt, moved);
      state.energies.kinetic += 0.5 * body.inertia.mass * before.v.dot(moved.V_WB.v) +
                                0.25 * (momentum + moved.angular_momentum).dot(moved.V_WB.w);
      state.energies.external_work +=
          0.5 * kick * body.inertia.mass * gravity.dot(before.v + moved.V_WB.v);
    } else if (body.role == BodyRole::Prescribed) {
      move_prescribed_body(model, state, static_cast<int>(b), scratch.body_wrench[b], gravity, kick,
                           dt);
    } else {
      move_with_twist(scratch.body_command[b], dt, moved);
      const Twist mean{0.5 * (before.v + moved.V_WB.v), 0.5 * (before.w + moved.V_WB.w)};
      state.energies.interface_work -= kick * scratch.body_wrench[b].power(mean);
    }
    if (carries_sleeper(model, state, b)) {
      const double kinetic = model.sleeper->kinetic(moved.X_WB, moved.V_WB);
      state.energies.kinetic += kinetic;
      state.energies.external_work += kinetic - model.sleeper->kinetic(start.X_WB, before);
      continue;
    }
    move_nodes_of(body, moved, dt, state);
  }
}

void move_tied_nodes(const Model& model, State& state, double dt) {
  for (const TiedNode& tie : model.tied) {
    Vec3 v = Vec3::Zero();
    for (int i = 0; i < tie.count; ++i) v += tie.weight[i] * state.nodes[tie.master[i]].velocity();
    NodeRecord& node = state.nodes[tie.node];
    node.set_velocity(v);
    node.set_position(node.position() + dt * v);
  }
}

}  // namespace

StepReport compute_forces(const Model& model, State& state, Scratch& scratch) {
  forget_loads(scratch);
  element_forces(model, state, scratch);
  StepReport report = sum_blocks(model, state, scratch);
  find_failed(model, state, scratch);
  contact_forces(model, state, scratch, report);
  nodal_loads(model, state, scratch);
  pressure_loads(model, state, scratch);
  tied_loads(model, scratch);
  gather_constrained_forces(model, state, scratch);
  sum_body_wrenches(model, state, scratch);
  return report;
}

void move(const Model& model, State& state, Scratch& scratch, double dt) {
  // Velocities sit at mid-steps: the kick spans half of the last step and half of this one. The
  // very first one is a half kick, from the velocities at t = 0.
  const Kick kick(0.5 * (state.last_dt + dt), model.settings.mass_damping);
  apply_constraints(model, state, scratch, kick, dt);
  integrate(model, state, scratch, kick, dt);
  hold_fixed_nodes(model, state, scratch);
  move_bodies(model, state, scratch, kick.length, dt);
  move_tied_nodes(model, state, dt);
  if (state.step == 0) {
    state.energies.initial = 0;
    state.energies.initial = state.energies.total();
  }
  state.time += dt;
  state.last_dt = dt;
  ++state.step;
}

StepReport advance_step(const Model& model, State& state, Scratch& scratch, double dt) {
  const StepReport report = compute_forces(model, state, scratch);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    scratch.body_command[b] = state.bodies[b].V_WB;
  move(model, state, scratch, dt);
  return report;
}

std::vector<Vec3> nodal_forces(const Model& model, const Scratch& scratch) {
  std::vector<Vec3> forces;
  for (int n = 0; n < model.mesh.node_count(); ++n) forces.push_back(force_on(model, scratch, n));
  return forces;
}

double next_step(const Model& model, const State& state, const StepReport& report) {
  const double step = model.settings.step_scale * report.stable_step;
  if (model.settings.step_limit.empty()) return step;
  return std::min(step, model.settings.step_limit.value(state.time));
}

std::string describe_element(const Model& model, int block, int element) {
  const ElementBlock& b = *model.blocks[block];
  const MeshPart& part = model.mesh.parts[b.part()];
  const DeckId id = model.mesh.table(b.kind()).id[b.mesh_element(element)];
  return fmt::format("element {} (part {} '{}', {})", id.value, part.id.value, part.name,
                     name(b.kind()));
}

}  // namespace crosswalk::fe
