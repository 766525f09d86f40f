#include "fe_node/solver.h"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/fe_node/box_model.h"
#include "tests/fe_node/solver/allocation_count.h"

namespace crosswalk::fe {
namespace {

const SolidLaw kTissue = Viscoelastic::from_single_term(1040, 2e6, 6e3, 1.2e3, 80);

Model shaken_box(int n) {
  Model model = box_model({n, n, n, {0.1, 0.1, 0.1}}, kTissue);
  std::vector<int> some;
  for (int i = 0; i < model.mesh.node_count(); i += 3) some.push_back(i);
  model.start_velocities.push_back({some, {0.4, -0.2, 0.3}});
  model.finish();
  return model;
}

State run(const Model& model, int threads, int steps) {
  State state = initial_state(model);
  Scratch scratch(model, threads);
  const double dt = 0.9 * initial_stable_step(model);
  for (int i = 0; i < steps; ++i) advance_step(model, state, scratch, dt);
  return state;
}

TEST(Solver, SameBitsForAnyNumberOfThreads) {
  const Model model = shaken_box(9);
  const State one = run(model, 1, 40);
  for (int threads : {2, 3}) {
    const State more = run(model, threads, 40);
    EXPECT_EQ(
        std::memcmp(one.nodes.data(), more.nodes.data(), one.nodes.size() * sizeof(NodeRecord)), 0);
    EXPECT_EQ(one.energies.internal, more.energies.internal);
    EXPECT_EQ(one.energies.kinetic, more.energies.kinetic);
  }
}

TEST(Solver, ACopiedStateContinuesBitIdentically) {
  const Model model = shaken_box(3);
  State state = run(model, 1, 20);
  State copy = state;
  Scratch first(model, 1), second(model, 1);
  for (int i = 0; i < 20; ++i) {
    advance_step(model, state, first, 1e-5);
    advance_step(model, copy, second, 1e-5);
  }
  EXPECT_EQ(
      std::memcmp(copy.nodes.data(), state.nodes.data(), copy.nodes.size() * sizeof(NodeRecord)),
      0);
}

TEST(Solver, NothingAllocatesInsideAStep) {
  const Model model = shaken_box(4);
  State state = initial_state(model);
  Scratch scratch(model, 1);
  advance_step(model, state, scratch, 1e-6);
  const long before = allocation_count();
  for (int i = 0; i < 10; ++i) advance_step(model, state, scratch, 1e-6);
  EXPECT_EQ(allocation_count(), before);
}

TEST(Solver, GravityWorkAndFallAreExact) {
  Model model = box_model({1, 1, 1, {1, 1, 1}}, Elastic::from_young(1000, 1e6, 0.3));
  model.settings.gravity = {0, 0, -9.80665};
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  const double dt = 1e-4;
  for (int i = 0; i < 1000; ++i) advance_step(model, state, scratch, dt);
  EXPECT_NEAR(state.nodes[0].x[2], -0.5 * 9.80665 * 0.01, 1e-12);
  EXPECT_NEAR(state.energies.external_work, 0.5 * 1000 * std::pow(9.80665 * (0.1 - dt / 2), 2),
              1e-9);
  EXPECT_LT(std::abs(state.energies.balance_error()), 2e-3);  // half a step apart
}

TEST(Solver, FixedAndGuidedNodesObeyAndTheirWorkIsBooked) {
  // A bar stretched slowly by its end: work in equals strain energy.
  const Box box{4, 1, 1, {0.4, 0.1, 0.1}};
  Model model = box_model(box, Elastic::from_young(1000, 1e6, 0.0));
  GuidedNodes pull;
  pull.curve = Curve({0, 0.2, 1}, {0, 0.004, 0.004});
  pull.kind = MotionKind::Displacement;
  for (int j = 0; j <= 1; ++j)
    for (int k = 0; k <= 1; ++k) {
      model.fixed.push_back({box.node(0, j, k), {true, true, true}, {}});
      pull.nodes.push_back(box.node(4, j, k));
    }
  model.guided.push_back(pull);
  model.settings.mass_damping = 200;
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  const double dt = 0.9 * initial_stable_step(model);
  while (state.time < 0.25) advance_step(model, state, scratch, dt);
  EXPECT_EQ(state.nodes[box.node(0, 0, 0)].x[0], 0.0);
  EXPECT_NEAR(state.nodes[box.node(4, 0, 0)].x[0], 0.404, 1e-12);
  const double strain_energy = 0.5 * 1e6 * 0.01 * 0.01 * 0.004;  // E e^2 V / 2, e = 1 %
  EXPECT_NEAR(state.energies.internal, strain_energy, 0.02 * strain_energy);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

TEST(Solver, TiedNodeFollowsAndHandsItsMassOver) {
  const Box box{1, 1, 1, {1, 1, 1}};
  Model model = box_model(box, Elastic::from_young(1000, 1e6, 0.3));
  model.mesh.position.push_back({0.5, 0.5, 1.0});
  model.mesh.node_id.push_back(DeckId{9});
  model.point_mass.assign(9, 0.0);
  model.point_mass[8] = 8;
  model.tied.push_back({8, 4, {4, 5, 6, 7}, {0.25, 0.25, 0.25, 0.25}});
  model.start_velocities.push_back({{0, 1, 2, 3, 4, 5, 6, 7}, {1, 2, 3}});
  model.finish();
  EXPECT_NEAR(model.mass[4], 127, 1e-9);
  State state = initial_state(model);
  Scratch scratch(model, 1);
  for (int i = 0; i < 100; ++i) advance_step(model, state, scratch, 1e-4);
  EXPECT_LT((state.nodes[8].position() - Vec3(0.51, 0.52, 1.03)).norm(), 1e-9);
}

TEST(Solver, RigidBoxInsideASoftOneCarriesItsShare) {
  // Two elements; the nodes of the first form a rigid body with its own mass.
  const Box box{2, 1, 1, {2, 1, 1}};
  Model model = box_model(box, Elastic::from_young(1000, 1e6, 0.3));
  RigidBody body;
  body.name = "block";
  body.own = Inertia::of_point(500, {0.5, 0.5, 0.5});
  body.own.about_com = 80 * Mat3::Identity();
  for (int j = 0; j <= 1; ++j)
    for (int k = 0; k <= 1; ++k)
      for (int i = 0; i <= 1; ++i) body.nodes.push_back(box.node(i, j, k));
  model.bodies.push_back(body);
  model.finish();
  EXPECT_NEAR(model.total_mass(), 2500, 1e-9);
  EXPECT_NEAR(model.bodies[0].inertia.mass, 500 + 1000 + 500, 1e-9);
  // The whole turns and flies free: momentum and angular momentum stay.
  State state = initial_state(model, {}, {{1, 2, 3}, {0.5, 0.2, -3}});
  Scratch scratch(model, 1);
  const auto momentum = [&] {
    Vec3 p = model.bodies[0].inertia.mass * state.bodies[0].V_WB.v;
    Vec3 L = state.bodies[0].angular_momentum + state.bodies[0].X_WB.p.cross(p);
    for (int n = 0; n < model.mesh.node_count(); ++n)
      if (model.body_of_node[n] < 0) {
        p += model.mass[n] * state.nodes[n].velocity();
        L += model.mass[n] * state.nodes[n].position().cross(state.nodes[n].velocity());
      }
    return std::pair(p, L);
  };
  const auto [p0, L0] = momentum();
  const double dt = 0.5 * initial_stable_step(model);
  for (int i = 0; i < 4000; ++i) advance_step(model, state, scratch, dt);
  const auto [p1, L1] = momentum();
  EXPECT_LT((p1 - p0).norm(), 1e-11 * p0.norm());
  EXPECT_LT((L1 - L0).norm(), 1e-11 * L0.norm());
  EXPECT_LT(std::abs(state.energies.balance_error()), 1e-3);
}

}  // namespace
}  // namespace crosswalk::fe
