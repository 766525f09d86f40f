// The finite-element windshield in a coupled run's node: asleep it rides on the car and costs no
// books, awake it takes the head's momentum to the car.
#include <gtest/gtest.h>

#include "fe_node/sleeper.h"
#include "tests/fe_node/node/node_fixture.h"

namespace crosswalk::fe {
namespace {

const Twist kCar{Vec3(0, 11.1, 0), Vec3::Zero()};

Vec3 momentum(const FeNode& node) {
  const Model& model = node.built().model;
  const State& state = node.state();
  Vec3 p = Vec3::Zero();
  for (int n = 0; n < awake_node_count(model, state); ++n)
    if (model.body_of_node[n] < 0) p += model.mass[n] * state.nodes[n].velocity();
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].role == BodyRole::Free)
      p += model.bodies[b].inertia.mass * state.bodies[b].V_WB.v;
  return p;
}

TEST(WindshieldRun, AsleepItRidesOnTheCar) {
  DrivenNode run(node_config("[windshield]\nmodel = \"panel\"\ncell_mm = 100\n"), {}, kCar);
  const Model& model = run.node.built().model;
  ASSERT_TRUE(model.sleeper.has_value());
  const FeReply reply = run.advance(5);
  EXPECT_TRUE(is_asleep(model, run.node.state()));
  EXPECT_NEAR(reply.kinetic, 0.5 * model.sleeper->inertia.mass * kCar.v.squaredNorm(), 1e-6);
  EXPECT_LT(std::abs(run.node.state().energies.balance_error()), 1e-9);
  EXPECT_LT(reply.internal, 1e-8);
  // Woken far from the head it goes on just so: no jump of energy, no strain, no force on the car.
  State awake = run.node.state();
  wake_sleeper(model, awake);
  const Vec3 corner = awake.nodes.back().position();
  Scratch scratch(model, 1);
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) advance_step(model, awake, scratch, 1e-6);
  EXPECT_LT(std::abs(awake.energies.balance_error()), 1e-9);
  EXPECT_LT(awake.energies.internal, 1e-9);
  EXPECT_LT((awake.nodes.back().position() - corner - kSteps * 1e-6 * kCar.v).norm(), 1e-9);
}

// A steep pane just before the head, so that they meet within a millisecond.
TEST(WindshieldRun, HeadsMomentumGoesIntoTheCar) {
  const std::string pane =
      "[windshield]\nmodel = \"panel\"\ncell_mm = 40\nwidth_mm = 800\nlower_x_mm = 0\nupper_x_mm = "
      "100\nlower_z_mm = 1450\nupper_z_mm = 1950\nwake_distance_mm = 20\n";
  // The head's side is about 80 mm before its centre plane, the pane's middle 60 mm behind the
  // car's front.
  DrivenNode run(node_config(pane), {}, kCar, Vec3(0, -0.045, 0));
  const Model& model = run.node.built().model;
  run.advance(5);
  ASSERT_FALSE(is_asleep(model, run.node.state()));
  const Vec3 before = momentum(run.node), given = run.impulse;
  const FeReply reply = run.advance(75);
  const Vec3 gained = momentum(run.node) - before, told = run.impulse - given;
  EXPECT_GT(reply.head_contact_force, 500);
  EXPECT_GT(gained.norm(), 0.2);  // N s; the pane gives up what it had, the head takes it
  EXPECT_LT((gained + told).norm(), 1e-9);
  EXPECT_LT(std::abs(run.node.state().energies.balance_error()), 2e-3);
  EXPECT_LT(run.node.state().energies.hourglass(), 0.1 * run.node.state().energies.internal);
}

}  // namespace
}  // namespace crosswalk::fe
