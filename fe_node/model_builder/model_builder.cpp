#include "fe_node/model_builder/model_builder.h"

#include <fmt/format.h>

#include "fe_node/model_builder/build_context.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

UnitFactors units_of(const Deck& deck, const BuildOptions& options) {
  const UnitSystem system = options.units != UnitSystem::Unknown ? options.units : deck.units;
  if (system == UnitSystem::Unknown)
    throw UserError(Problem{deck.files.names.empty() ? Place{} : Place{deck.files.names[0]},
                            "unit system", "one stated", "none",
                            "add a line `$ crosswalk: unit_system=mm-tonne-s` or give --units"});
  return unit_factors(system);
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
  if (control.time_step) settings.step_scale = control.time_step->scale;
  c.built.field_interval = interval_of(c.deck, "DATABASE_BINARY_D3PLOT", c.units.time);
  c.built.history_interval = interval_of(c.deck, "DATABASE_GLSTAT", c.units.time);
}

}  // namespace

int BuiltModel::part_set(std::string_view name) const {
  for (std::size_t i = 0; i < part_sets.size(); ++i)
    if (part_sets[i].first == name) return static_cast<int>(i);
  return -1;
}

void finish_model(BuiltModel& built) {
  const double step = built.model.settings.step_scale * initial_stable_step(built.model);
  for (RigidSurfaceSpec& wall : built.walls) {
    for (RigidPatch& patch : wall.patches) std::get<PenaltyLaw>(patch.law).reference_step = step;
    built.model.contacts.push_back(make_rigid_surface_contact(wall));
  }
  built.model.finish();
}

BuiltModel build_model(const Deck& deck, const BuildOptions& options) {
  BuiltModel built;
  BuildContext context{deck, options, units_of(deck, options), built};
  index_by_id(deck.sections, context.sections);
  index_by_id(deck.materials, context.materials);
  index_by_id(deck.curves, context.curves);
  index_by_id(deck.hourglasses, context.hourglasses);
  for (const DeckSet& set : deck.sets) context.sets[{set.kind, set.id}] = &set;
  build_mesh(context);
  build_bodies(context);
  build_blocks(context);
  build_conditions(context);
  build_contacts(context);
  read_controls(context);
  context.problems.finish();
  return built;
}

}  // namespace crosswalk::fe
