#include "fe_node/model_builder/model_builder.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "fe_node/deck/units_guess.h"
#include "fe_node/model_builder/build_context.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

Place place_of(const Deck& deck) {
  return deck.files.names.empty() ? Place{} : Place{deck.files.names[0]};
}

/// What the caller or the deck states; else a clear guess, which the user is told of.
UnitFactors units_of(const Deck& deck, const BuildOptions& options,
                     std::vector<std::string>& notes) {
  if (options.units != UnitSystem::Unknown) return unit_factors(options.units);
  const UnitsGuess guess = guess_units(deck);
  if (guess.certainty == UnitsGuess::Certainty::Likely) {
    std::string note = fmt::format(
        "units guessed as {0}; --units {0} or `$ crosswalk: unit_system={0}` states them",
        unit_system_name(guess.system));
    for (const std::string& reason : guess.reasons) note += "; " + reason;
    notes.push_back(std::move(note));
  } else if (guess.certainty != UnitsGuess::Certainty::Stated) {
    throw UserError(Problem{place_of(deck), "unit system", "one stated", "none",
                            "add a line `$ crosswalk: unit_system=mm-t-s` or give --units"});
  }
  return unit_factors(guess.system);
}

template <class Record>
void index_by_id(const std::vector<Record>& records,
                 std::unordered_map<DeckId, const Record*>& index) {
  for (const Record& record : records) index.emplace(record.id, &record);
}

double interval_of(const Deck& deck, std::string_view keyword, double time_unit) {
  for (const DatabaseRequest& request : deck.databases)
    if (request.keyword == keyword) return request.interval * time_unit;
  return 0;
}

void read_controls(BuildContext& c) {
  const Control& control = c.deck.control;
  SolverSettings& settings = c.model().settings;
  if (control.end_time) c.built.end_time = *control.end_time * c.units.time;
  if (control.time_step) {
    settings.step_scale = control.time_step->scale;
    // Beyond 1 the watch on energies decides: the stable step is a lower bound.
    if (!(settings.step_scale > 0 && settings.step_scale <= 10))
      c.problem({}, "*CONTROL_TIMESTEP field TSSFAC", "a multiple of the stable step in (0, 10]",
                fmt::format("{:g}", settings.step_scale));
    if (control.time_step->limit_curve.given())
      if (const auto limit = c.curve(control.time_step->limit_curve, c.units.time, c.units.time, {},
                                     "*CONTROL_TIMESTEP field LCTM"))
        settings.step_limit = *limit;
  }
  if (c.options.mass_scaling_step >= 0)
    settings.mass_scaling_step = c.options.mass_scaling_step;
  else if (control.time_step)
    settings.mass_scaling_step =
        std::abs(control.time_step->mass_scaled_step) * c.units.time / settings.step_scale;
  c.built.field_interval = interval_of(c.deck, "DATABASE_BINARY_D3PLOT", c.units.time);
  c.built.history_interval = interval_of(c.deck, "DATABASE_GLSTAT", c.units.time);
}

}  // namespace

int BuiltModel::part_set(std::string_view name) const {
  for (std::size_t i = 0; i < part_sets.size(); ++i)
    if (part_sets[i].first == name) return static_cast<int>(i);
  return -1;
}

namespace {

JointBody joint_body(const RigidBody& body) {
  if (body.role != BodyRole::Free) return {};
  const Eigen::SelfAdjointEigenSolver<Mat3> inertia(body.inertia.about_com);
  return {body.inertia.mass, inertia.eigenvalues()[0], body.origin};
}

/// A model of rigid bodies alone has no stable step of its own; its joints then define one.
void add_joints(BuiltModel& built, double step) {
  constexpr double kStepOfRigidModels = 1e-6;  // s
  if (!std::isfinite(step)) step = kStepOfRigidModels;
  for (JointSpec& joint : built.joints) {
    const std::vector<RigidBody>& bodies = built.model.bodies;
    const JointBody a = joint_body(bodies[joint.body_a]), b = joint_body(bodies[joint.body_b]);
    built.model.contacts.push_back(
        make_joint(std::move(joint), a, b, built.model.mesh.position, step));
  }
  built.joints.clear();
  for (JointStiffnessSpec& spec : built.joint_stiffnesses) {
    const std::vector<RigidBody>& bodies = built.model.bodies;
    spec.reference_origin = bodies[spec.reference_body].origin;
    const JointBody a = joint_body(bodies[spec.body_a]), b = joint_body(bodies[spec.body_b]);
    built.model.contacts.push_back(make_joint_stiffness(std::move(spec), a, b, step));
  }
  built.joint_stiffnesses.clear();
}

}  // namespace

void finish_model(BuiltModel& built) {
  built.model.finish();
  const double step = built.model.settings.step_scale * initial_stable_step(built.model);
  for (RigidSurfaceSpec& wall : built.walls) {
    for (RigidPatch& patch : wall.patches) std::get<PenaltyLaw>(patch.law).reference_step = step;
    built.model.contacts.push_back(make_rigid_surface_contact(wall));
  }
  for (MeshContactSpec& contact : built.mesh_contacts)
    built.model.contacts.push_back(make_mesh_contact(std::move(contact), step));
  built.mesh_contacts.clear();
  add_joints(built, step);
}

BuiltModel build_model(const Deck& deck, const BuildOptions& options) {
  if (deck.solids.empty() && deck.shells.empty() && deck.thick_shells.empty() &&
      deck.beams.empty() && deck.discretes.empty() && deck.seatbelts.empty())
    throw UserError(
        Problem{place_of(deck), "elements", "one or more", "none", "nothing can be run"});
  BuiltModel built;
  BuildContext context{deck, options, units_of(deck, options, built.notes), built};
  index_by_id(deck.sections, context.sections);
  index_by_id(deck.materials, context.materials);
  index_by_id(deck.curves, context.curves);
  index_by_id(deck.hourglasses, context.hourglasses);
  for (const DeckSet& set : deck.sets) context.sets[{set.kind, set.id}] = &set;
  build_mesh(context);
  build_bodies(context);
  build_blocks(context);
  build_conditions(context);
  build_pressures(context);
  build_joints(context);
  build_joint_stiffness(context);
  build_contacts(context);
  build_mesh_contacts(context);
  build_outputs(context);
  read_controls(context);
  check_model(context);
  if (!context.problems.empty()) throw UserError(context.problems.summary());
  return built;
}

}  // namespace crosswalk::fe
