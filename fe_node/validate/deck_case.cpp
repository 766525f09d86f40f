#include "fe_node/validate/deck_case.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.h"
#include "common/log.h"
#include "fe_node/deck/deck_writer.h"
#include "fe_node/deck/runnable.h"
#include "fe_node/generate/deck_export.h"

namespace crosswalk::fe::validate {

DeckCase::DeckCase(const generate::ModelDraft& draft, UnitSystem units)
    : deck(generate::to_deck(draft, units)), units_(unit_factors(units)) {}

DeckId DeckCase::add_curve(const Points& points, double y_unit) {
  DeckCurve curve;
  curve.id = DeckId(next_++);
  for (const auto& [t, y] : points) curve.points.emplace_back(t / units_.time, y / y_unit);
  deck.curves.push_back(curve);
  return curve.id;
}

DeckId DeckCase::add_set(const std::vector<int>& nodes) {
  DeckSet set;
  set.kind = SetKind::Node;
  set.id = DeckId(next_++);
  std::vector<int> sorted = nodes;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (int n : sorted) set.ids.push_back(deck.nodes[n].id);
  deck.sets.push_back(set);
  return set.id;
}

void DeckCase::guide_part(int part, int axis, const Points& velocity) {
  PrescribedMotion motion;
  motion.kind = MotionTarget::Rigid;
  motion.target = DeckId(part);
  motion.dof = axis < 3 ? axis + 1 : axis + 2;
  motion.curve = add_curve(velocity, axis < 3 ? units_.velocity() : 1 / units_.time);
  deck.prescribed_motions.push_back(motion);
}

void DeckCase::guide_nodes(const std::vector<int>& nodes, int axis, const Points& velocity) {
  PrescribedMotion motion;
  motion.kind = MotionTarget::NodeSet;
  motion.target = add_set(nodes);
  motion.dof = axis + 1;
  motion.curve = add_curve(velocity, units_.velocity());
  deck.prescribed_motions.push_back(motion);
}

void DeckCase::fix_nodes(const std::vector<int>& nodes) {
  Spc spc;
  spc.kind = NodeTarget::Set;
  spc.target = add_set(nodes);
  spc.fixed = {1, 1, 1, 1, 1, 1};
  deck.spcs.push_back(spc);
}

void DeckCase::load_nodes(const std::vector<int>& nodes, int axis, const Points& total_force) {
  LoadNode load;
  load.kind = NodeTarget::Set;
  load.target = add_set(nodes);
  load.dof = axis + 1;
  load.curve = add_curve(total_force, units_.force());
  load.scale = 1.0 / static_cast<double>(nodes.size());
  deck.nodal_loads.push_back(load);
}

void DeckCase::start_velocity(const Vec3& velocity) {
  InitialVelocity start;
  start.velocity = velocity / units_.velocity();
  deck.initial_velocities.push_back(start);
}

void DeckCase::start_velocity(const std::vector<int>& nodes, const Vec3& velocity) {
  InitialVelocity start;
  start.set = add_set(nodes);
  start.velocity = velocity / units_.velocity();
  deck.initial_velocities.push_back(start);
}

void DeckCase::add_plane(const Vec3& point, const Vec3& normal, const std::vector<int>& nodes,
                         double friction) {
  RigidWall wall;
  wall.id = DeckId(next_++);
  wall.node_set = add_set(nodes);
  wall.tail = point / units_.length;
  wall.head = wall.tail + 0.1 / units_.length * normal;
  wall.friction = friction;
  deck.rigid_walls.push_back(wall);
}

void DeckCase::add_sphere(const Vec3& centre, double radius, const std::vector<int>& nodes,
                          double friction) {
  RigidWall wall;
  wall.shape = RigidWall::Shape::Sphere;
  wall.id = DeckId(next_++);
  wall.node_set = add_set(nodes);
  wall.tail = centre / units_.length;
  wall.head = wall.tail + Vec3(0, 0, 0.1 / units_.length);
  wall.radius = radius / units_.length;
  wall.friction = friction;
  deck.rigid_walls.push_back(wall);
}

void DeckCase::end_at(double time) { deck.control.end_time = time / units_.time; }

DeckRun::DeckRun(const Deck& deck, const std::filesystem::path& folder, const Computing& computing,
                 double added_mass_limit) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = folder / "case.k";
  write_deck(path, deck);
  ReadDeck read = read_deck(path);
  require_runnable(read, MissingPolicy::Refuse);
  BuildOptions options;
  options.mass_scaling_step = 0;
  options.precision = computing.precision;
  built_ = build_model(read.deck, options);
  if (added_mass_limit > 0) {
    options.mass_scaling_step = mass_scaling_step_for(built_.model, added_mass_limit);
    built_ = build_model(read.deck, options);
  }
  finish_model(built_);
  const std::vector<DeckId>& id = built_.model.mesh.node_id;
  node_of_.resize(deck.nodes.size(), -1);
  for (std::size_t n = 0; n < id.size(); ++n)
    if (id[n].value > 0 && id[n].value <= static_cast<int>(node_of_.size()))
      node_of_[id[n].value - 1] = static_cast<int>(n);
  state_ = initial_state(built_.model);
  scratch_ = std::make_unique<Scratch>(built_.model, computing.threads);
  for (const std::string& note : built_.notes) log_info("{}: {}", path.string(), note);
  log_info("{}: {} nodes, mass {:.4g} kg, added {:.3f} %, stable step {:.3f} us", path.string(),
           built_.model.mesh.node_count(), built_.model.total_mass(), 100 * added_mass_share(),
           1e6 * initial_stable_step(built_.model));
}

double DeckRun::added_mass_share() const {
  double added = 0;
  for (double m : built_.model.added_mass) added += m;
  return added / built_.model.total_mass();
}

void DeckRun::run(double end, double interval, const std::function<void(const State&)>& watch) {
  double next = state_.time;
  while (true) {
    const StepReport report = compute_forces(built_.model, state_, *scratch_);
    largest_internal_ = std::max(largest_internal_, state_.energies.internal);
    largest_hourglass_ = std::max(largest_hourglass_, state_.energies.hourglass());
    if (state_.time >= next - 1e-12) {
      watch(state_);
      next += interval;
    }
    if (state_.time >= end * (1 - 1e-12)) return;
    const double dt = std::min(next_step(built_.model, state_, report), end - state_.time);
    for (std::size_t b = 0; b < built_.model.bodies.size(); ++b)
      scratch_->body_command[b] = state_.bodies[b].V_WB;
    set_log_time(state_.time);
    move(built_.model, state_, *scratch_, dt);
  }
}

}  // namespace crosswalk::fe::validate
