// Rigid-body world: closed forms of free and joined bodies, mobility, bit-exact restore.
#include "mb_node/ode_world.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/error.h"
#include "common/units.h"

namespace crosswalk::mb {
namespace {

constexpr double kStep = 1e-5;
const Vec3 kInertia(0.02, 0.03, 0.04);

Mat3 diagonal(const Vec3& moments) { return moments.asDiagonal(); }

// Two bodies of general attitude joined by a ball at the origin.
OdeWorld two_body_chain(Stepper stepper) {
  OdeWorld world(stepper, 200);
  world.add_body(15, diagonal({0.3, 0.25, 0.2}),
                 {exp_rotation({0.3, -0.2, 0.5}), Vec3(-0.1, 0.05, 0.2)});
  world.add_body(0.3, diagonal({4e-4, 3e-4, 5e-4}),
                 {exp_rotation({-0.4, 0.1, 0.2}), Vec3(0.06, 0.02, -0.03)});
  world.add_joint(JointKind::Ball, 0, 1, Vec3::Zero());
  return world;
}

TEST(OdeWorld, FreeFallFollowsSemiImplicitEuler) {
  OdeWorld world(Stepper::Direct);
  world.add_body(2, diagonal(kInertia), {});
  world.set_gravity({0, 0, -kStandardGravity});
  const int steps = 1000;
  for (int i = 0; i < steps; ++i) world.step(kStep);
  const double t = steps * kStep;
  EXPECT_NEAR(world.twist(0).v.z(), -kStandardGravity * t, 1e-12);
  EXPECT_NEAR(world.position(0).z(), -0.5 * kStandardGravity * t * (t + kStep), 1e-12);
}

TEST(OdeWorld, ForceAtAPointGivesTheMomentAboutTheCentreOfMass) {
  OdeWorld world(Stepper::Direct);
  world.add_body(2, diagonal(kInertia), {Quat::Identity(), Vec3(1, 2, 3)});
  world.add_force_at(0, {0, 10, 0}, Vec3(1.5, 2, 3));
  world.step(kStep);
  EXPECT_NEAR(world.twist(0).v.y(), 10.0 / 2 * kStep, 1e-15);
  EXPECT_NEAR(world.twist(0).w.z(), 0.5 * 10 / kInertia.z() * kStep, 1e-13);
}

TEST(OdeWorld, PendulumOnAHingeHasItsPeriod) {
  // Physical pendulum, small swing: T = 2 pi sqrt((I + m l^2) / (m g l)) (1 + a^2/16).
  OdeWorld world(Stepper::Direct);
  const double mass = 2, arm = 0.4, start = 0.1;
  world.add_body(mass, diagonal(kInertia),
                 {exp_rotation({start, 0, 0}), exp_rotation({start, 0, 0}) * Vec3(0, 0, -arm)});
  world.add_joint(JointKind::Hinge, -1, 0, Vec3::Zero(), Vec3::UnitX());
  world.set_gravity({0, 0, -kStandardGravity});
  const double period =
      2 * kPi * std::sqrt((kInertia.x() + mass * arm * arm) / (mass * kStandardGravity * arm)) *
      (1 + start * start / 16);
  // Quarter period: the pendulum passes the vertical.
  const double dt = 1e-4;
  double t = 0;
  double before = world.position(0).y();
  while ((world.position(0).y() > 0) == (before > 0)) {
    before = world.position(0).y();
    world.step(dt);
    t += dt;
  }
  EXPECT_NEAR(t, period / 4, 2 * dt);
  EXPECT_LT(world.joint_drift().distance, 1e-6);
}

TEST(OdeWorld, SliderLeavesOneTranslationFree) {
  OdeWorld world(Stepper::Direct);
  world.add_body(3, diagonal(kInertia), {});
  world.add_body(1, diagonal(kInertia), {Quat::Identity(), Vec3(0.2, 0, 0)});
  world.add_joint(JointKind::Slider, 0, 1, Vec3::Zero(), Vec3::UnitY());
  world.add_force_at(1, {0, 8, 0}, world.position(1));
  world.step(kStep);
  // Along the slider body 1 moves alone, and body 0 not at all.
  EXPECT_NEAR(world.twist(1).v.y(), 8 * kStep, 1e-9);
  EXPECT_NEAR(world.twist(0).v.norm(), 0, 1e-9);
}

TEST(OdeWorldMobility, OfAFreeBodyIsItsInverseInertia) {
  OdeWorld world(Stepper::Direct);
  const Mat3 R = exp_rotation({0.3, 0.7, -0.2}).toRotationMatrix();
  world.add_body(0.3, diagonal(kInertia), {Quat(R), Vec3(1, 2, 3)});
  world.set_twist(0, {{3, 1, -2}, {4, -9, 7}});
  const Vec3 p_B(0.05, -0.02, 0.1);
  const std::vector<BodyPoint> points = {{0, p_B}};
  const Eigen::MatrixXd W = measure_mobility(world, points, kStep, 0);
  const Mat3 inverse = R * diagonal(kInertia).inverse() * R.transpose();
  const Mat3 arm = skew(R * p_B);
  Eigen::Matrix<double, 6, 6> expected;
  expected << Mat3::Identity() / 0.3 - arm * inverse * arm, -arm * inverse, inverse * arm, inverse;
  EXPECT_LT((W - expected).norm() / expected.norm(), 1e-6);
}

TEST(OdeWorldMobility, OfATwoBodyChainIsTheConstrainedInverse) {
  for (const Stepper stepper : {Stepper::Direct, Stepper::Quick}) {
    OdeWorld world = two_body_chain(stepper);
    // Unconstrained inverse mass, ball constraint G v = 0: W = M^-1 - M^-1 G^T (G M^-1 G^T)^-1 G
    // M^-1.
    Eigen::Matrix<double, 12, 12> inverse = Eigen::Matrix<double, 12, 12>::Zero();
    Eigen::Matrix<double, 3, 12> G;
    for (int i = 0; i < 2; ++i) {
      const Mat3 R = world.rotation(i);
      inverse.block<3, 3>(6 * i, 6 * i) = Mat3::Identity() / world.mass(i);
      inverse.block<3, 3>(6 * i + 3, 6 * i + 3) = R * world.inertia(i).inverse() * R.transpose();
      const double sign = i == 0 ? 1 : -1;
      G.block<3, 3>(0, 6 * i) = sign * Mat3::Identity();
      G.block<3, 3>(0, 6 * i + 3) = -sign * skew(-world.position(i));
    }
    const Eigen::Matrix<double, 12, 12> expected =
        inverse - inverse * G.transpose() * (G * inverse * G.transpose()).inverse() * G * inverse;
    // Both bodies together have 9 freedoms for 12 rows: W is singular, and still right.
    const std::vector<BodyPoint> points = {{0, Vec3::Zero()}, {1, Vec3::Zero()}};
    const Eigen::MatrixXd W = measure_mobility(world, points, kStep, 0);
    EXPECT_LT((W - expected).norm() / expected.norm(), 1e-6);
  }
}

TEST(OdeWorldMobility, LeavesTheWorldAsFound) {
  OdeWorld world = two_body_chain(Stepper::Quick);
  world.set_twist(0, {{1, 2, 3}, {-5, 4, 3}});
  const WorldState before = world.save();
  const std::vector<BodyPoint> one = {{1, Vec3(0.01, 0, 0)}};
  measure_mobility(world, one, kStep, 0);
  const WorldState after = world.save();
  EXPECT_EQ(before.bodies, after.bodies);
  EXPECT_EQ(before.random_seed, after.random_seed);
}

TEST(OdeWorld, RestoreRepeatsStepsBitByBit) {
  for (const Stepper stepper : {Stepper::Direct, Stepper::Quick}) {
    OdeWorld world = two_body_chain(stepper);
    world.set_twist(1, {{0, 0, 0}, {30, -20, 10}});
    const auto run = [&world] {
      for (int i = 0; i < 50; ++i) {
        world.add_force_at(1, {5, -3, 2}, world.position(1) + Vec3(0.01, 0.02, 0));
        world.step(kStep);
      }
      return world.save().bodies;
    };
    run();
    const WorldState state = world.save();
    const std::vector<double> first = run();
    world.restore(state);
    EXPECT_EQ(first, run());
  }
}

TEST(OdeWorld, FreeTumblingChainKeepsMomentum) {
  OdeWorld world = two_body_chain(Stepper::Direct);
  // Velocities that the ball joint allows: rigid motion, then a spin of body 1 about the joint.
  const Vec3 w0(3, -2, 5), w1(10, 4, -6), joint_velocity(1, 2, 3);
  world.set_twist(0, {joint_velocity + w0.cross(world.position(0)), w0});
  world.set_twist(1, {joint_velocity + w1.cross(world.position(1)), w1});
  const Vec3 linear = world.linear_momentum();
  const Vec3 angular = world.angular_momentum(Vec3::Zero());
  const double energy = world.kinetic_energy();
  for (int i = 0; i < 2000; ++i) world.step(kStep);
  EXPECT_LT((world.linear_momentum() - linear).norm() / linear.norm(), 1e-10);
  EXPECT_LT((world.angular_momentum(Vec3::Zero()) - angular).norm() / angular.norm(), 1e-4);
  EXPECT_NEAR(world.kinetic_energy() / energy, 1, 1e-4);
}

}  // namespace
}  // namespace crosswalk::mb
