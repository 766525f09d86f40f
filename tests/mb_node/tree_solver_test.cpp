// Joint forces along the tree against ODE's dense factorisation of the same equations.
#include <array>

#include <gtest/gtest.h>

#include "mb_node/world_builder.h"
#include "tests/mb_node/mb_fixture.h"

namespace crosswalk::mb {
namespace {

constexpr double kStep = 1e-5;

double largest_difference(const OdeWorld& a, const OdeWorld& b) {
  const std::vector<double> x = a.save().bodies, y = b.save().bodies;
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    worst = std::max(worst, std::abs(x[i] - y[i]) / std::max(1.0, std::abs(y[i])));
  }
  return worst;
}

/// Spins and pushes every body, reproducibly, with velocities that break the joints on purpose.
void drive(OdeWorld& world, int step) {
  for (int i = 0; i < world.body_count(); ++i) {
    const double a = i + 0.1 * step;
    world.add_force_at(i, 50 * Vec3(std::sin(a), std::cos(2 * a), std::sin(3 * a)),
                       world.position(i) + Vec3(0.01, -0.02, 0.03));
    world.add_torque(i, Vec3(std::cos(a), std::sin(a), 0.5));
  }
}

double march_both(OdeWorld& direct, OdeWorld& dense, int steps) {
  for (OdeWorld* world : {&direct, &dense}) {
    world->set_gravity({0, 0, -9.8});
    for (int i = 0; i < world->body_count(); ++i) {
      world->set_twist(i, {{0.1 * i, 1, -1}, {3 - 0.5 * i, 2, 0.4 * i}});
    }
    for (int k = 0; k < steps; ++k) {
      drive(*world, k);
      world->step(kStep);
    }
  }
  return largest_difference(direct, dense);
}

TEST(TreeSolver, StepsEachJointAsOdeDoes) {
  for (const JointKind kind :
       {JointKind::Ball, JointKind::Hinge, JointKind::Universal, JointKind::Slider}) {
    std::array<OdeWorld, 2> worlds = {OdeWorld(Stepper::Direct), OdeWorld(Stepper::Dense)};
    const Mat3 inertia = Vec3(0.02, 0.03, 0.04).asDiagonal();
    const Quat q = exp_rotation({0.3, -0.2, 0.5});
    for (OdeWorld& world : worlds) {
      world.add_body(3, inertia, {q, Vec3(0.1, 0.2, 0.3)});
      world.add_body(1, inertia, {q, Vec3(0.3, 0.1, 0.3)});
      world.add_body(0.5, inertia, {exp_rotation({-0.6, 0.1, 0.2}), Vec3(0.4, 0.1, 0.5)});
      world.add_joint(kind, 0, 1, {0.2, 0.2, 0.3}, q * Vec3::UnitX(), q * Vec3::UnitY());
      world.add_joint(JointKind::Ball, 0, 2, {0.3, 0.1, 0.4});
    }
    EXPECT_LT(march_both(worlds[0], worlds[1], 200), 1e-10) << static_cast<int>(kind);
  }
}

TEST(TreeSolver, StepsThePedestrianAsOdeDoes) {
  const auto build = [](const char* stepper) {
    MbModel model = build_model(load_config(
        "v2370", RunMode::Multibody, std::string("[multibody]\nstepper = \"") + stepper + "\"\n"));
    return build_world(model, std::vector<Inertia>(model.config.body.segments.size()));
  };
  OdeWorld direct = build("direct"), dense = build("dense");
  EXPECT_LT(march_both(direct, dense, 20), 1e-9);
}

TEST(TreeSolver, SwingsOnTheWorld) {
  std::array<OdeWorld, 2> worlds = {OdeWorld(Stepper::Direct), OdeWorld(Stepper::Dense)};
  const Mat3 inertia = Vec3(0.02, 0.03, 0.04).asDiagonal();
  for (OdeWorld& world : worlds) {
    world.add_body(3, inertia, {Quat::Identity(), Vec3(0, 0.1, -0.4)});
    world.add_joint(JointKind::Universal, -1, 0, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY());
  }
  EXPECT_LT(march_both(worlds[0], worlds[1], 200), 1e-10);
}

}  // namespace
}  // namespace crosswalk::mb
