// The generated head and neck in the solver: at rest it stays at rest, and it falls freely with
// sound energies. Coarse mesh, a fraction of a millisecond: the model is the subject, not the
// solver.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "common/units.h"
#include "fe_node/generate/head_neck.h"
#include "fe_node/model_builder/model_builder.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

BuiltModel coarse(bool blocks_are_held) {
  BuildOptions options;
  if (blocks_are_held)
    options.driven_parts = {"block_torso_up", "block_clavicle_l", "block_clavicle_r"};
  options.mass_scaling_step = 0;
  return build_model(generate::generate_head_neck({}), options);
}

void run(const Model& model, State& state, double end) {
  Scratch scratch(model, 1);
  const double dt = 0.85 * initial_stable_step(model);
  while (state.time < end) advance_step(model, state, scratch, dt);
}

TEST(GeneratedModel, StableStepIsAboutOneMicrosecond) {
  BuiltModel built = coarse(true);
  built.model.finish();
  EXPECT_GT(initial_stable_step(built.model), 0.9e-6);
  for (const double added : built.model.added_mass) EXPECT_EQ(added, 0);
}

// 1.41 us is the step of a brain cell of the mean size, 3.5 mm, that were a cube of water.
TEST(GeneratedModel, ShapeOfMediumCellsCostsLittleOfTheStep) {
  generate::HeadNeckSpec spec;
  spec.fidelity = generate::Fidelity::Medium;
  spec.brain_bulk = generate::kWaterBulk;
  BuildOptions options;
  options.mass_scaling_step = 0;
  BuiltModel built = build_model(generate::generate_head_neck(spec), options);
  EXPECT_GT(mass_scaling_step_for(built.model, 0.01), 1.0e-6);
}

TEST(GeneratedModel, MassScalingSparesWhatFloats) {
  for (const double bulk : {generate::kBrainBulk, generate::kWaterBulk}) {
    generate::HeadNeckSpec spec;
    spec.brain_bulk = bulk;
    BuildOptions options;
    options.mass_scaling_step = 0;
    const BuiltModel built = build_model(generate::generate_head_neck(spec), options);
    const double step = mass_scaling_step_for(built.model, 0.01);
    const AddedMass added = added_mass_for(built.model, step);
    std::map<std::string, double> mass, share;
    for (const auto& block : built.model.blocks)
      for (int e = 0; e < block->element_count(); ++e)
        mass[built.model.mesh.parts[block->part()].name] +=
            block->corners() * block->corner_mass(e);
    for (std::size_t p = 0; p < added.parts.size(); ++p) {
      const std::string& name = built.model.mesh.parts[p].name;
      if (mass[name] > 0) share[name] = added.parts[p] / mass[name];
    }
    const bool is_water = bulk == generate::kWaterBulk;
    // One part is at its limit, the others below theirs.
    EXPECT_NEAR(share[is_water ? "csf" : "diploe"], is_water ? kNearFluidLimit : kPartLimit, 1e-5);
    for (const char* name : {"csf", "cerebrum_left", "cerebellum_left", "brainstem", "cord"})
      EXPECT_LT(share[name], kNearFluidLimit + 1e-6) << name;
    for (const auto& [name, value] : share) EXPECT_LT(value, kPartLimit + 1e-6) << name;
  }
}

TEST(GeneratedModel, IsTheSameInOtherUnits) {
  const auto built_in = [](UnitSystem units) {
    generate::HeadNeckSpec spec;
    spec.units = units;
    BuiltModel built = build_model(generate::generate_head_neck(spec), {});
    built.model.finish();
    return built;
  };
  const BuiltModel first = built_in(UnitSystem::MmTonneS), other = built_in(UnitSystem::MmKgMs);
  EXPECT_NEAR(other.model.total_mass() / first.model.total_mass(), 1, 1e-9);
  EXPECT_NEAR(initial_stable_step(other.model) / initial_stable_step(first.model), 1, 1e-9);
  ASSERT_EQ(first.model.mesh.node_count(), other.model.mesh.node_count());
  State a = initial_state(first.model), b = initial_state(other.model);
  // The same push on the head: springs, discs and strands must answer alike.
  for (State* state : {&a, &b})
    for (std::size_t body = 0; body < state->bodies.size(); ++body)
      state->bodies[body].V_WB.v.x() = static_cast<double>(body);
  Scratch scratch_a(first.model, 1), scratch_b(other.model, 1);
  for (int step = 0; step < 50; ++step) {
    advance_step(first.model, a, scratch_a, 0.9e-6);
    advance_step(other.model, b, scratch_b, 0.9e-6);
  }
  EXPECT_GT(a.energies.internal, 1e-6);
  EXPECT_NEAR(b.energies.internal / a.energies.internal, 1, 1e-6);
}

TEST(GeneratedModel, StaysAtRestWithoutLoad) {
  BuiltModel built = coarse(true);
  built.model.finish();
  State state = initial_state(built.model);
  run(built.model, state, 0.3e-3);
  // Coordinates are rounded on the deck's cards; nothing else may load the model.
  EXPECT_LT(state.energies.kinetic, 1e-12);
  EXPECT_LT(state.energies.internal, 1e-8);
}

TEST(GeneratedModel, FallsFreelyWithoutStrain) {
  BuiltModel built = coarse(false);
  built.model.settings.gravity = {0, 0, -kStandardGravity};
  built.model.finish();
  State state = initial_state(built.model);
  run(built.model, state, 0.5e-3);
  const double mass = built.model.total_mass();
  const double speed = kStandardGravity * state.time;
  EXPECT_NEAR(state.energies.kinetic / (0.5 * mass * speed * speed), 1, 0.01);
  EXPECT_LT(state.energies.internal + state.energies.hourglass(), 1e-3 * state.energies.kinetic);
}

TEST(GeneratedModel, ShakenTorsoKeepsTheBooks) {
  BuiltModel built = coarse(true);
  built.model.finish();
  State state = initial_state(built.model);
  for (std::size_t b = 0; b < built.model.bodies.size(); ++b)
    if (built.model.bodies[b].role == BodyRole::Driven) state.bodies[b].V_WB.v.y() = 5;
  run(built.model, state, 1e-3);
  const Energies& e = state.energies;
  EXPECT_GT(e.interface_work, 0.1);
  EXPECT_LT(std::abs(e.balance_error()), 0.02);
  EXPECT_LT(e.hourglass(), 0.1 * e.internal);
}

}  // namespace
}  // namespace crosswalk::fe
