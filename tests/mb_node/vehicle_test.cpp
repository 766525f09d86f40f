// How the car moves: prescribed speeds in closed form, a free mass by the pedestrian's push.
#include "mb_node/vehicle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/units.h"
#include "mb_node/mb_node.h"
#include "tests/mb_node/mb_fixture.h"

namespace crosswalk::mb {
namespace {

constexpr double kStep = 1e-4;

VehicleState driven(const Vehicle& vehicle, double duration, double push = 0) {
  VehicleState state = initial_state(vehicle, 0);
  const int steps = static_cast<int>(std::lround(duration / kStep));
  for (int i = 0; i < steps; ++i) advance_vehicle(vehicle, i * kStep, kStep, push, state);
  return state;
}

Vehicle car(VehicleMotion motion) {
  Vehicle vehicle;
  vehicle.motion = motion;
  vehicle.speed = 10;
  vehicle.mass = 1300;
  vehicle.deceleration = 7;
  vehicle.braking_start = 0.1;
  vehicle.dive = 1.5 * kDegree;
  vehicle.speed_table = Curve({0, 1}, {10, 4}, Curve::Outside::Hold);
  return vehicle;
}

TEST(Car, AtConstantSpeedCannotBePushed) {
  const VehicleState state = driven(car(VehicleMotion::Constant), 0.5, -5000);
  EXPECT_EQ(state.v, 10);
  EXPECT_NEAR(state.y, 5, 1e-9);
  EXPECT_EQ(state.dive, 0);
}

TEST(Car, BrakesToRestWithItsNoseDown) {
  const Vehicle vehicle = car(VehicleMotion::Braking);
  const VehicleState braking = driven(vehicle, 0.6);
  EXPECT_NEAR(braking.v, 10 - 7 * 0.5, 1e-9);
  EXPECT_NEAR(braking.y, 10 * 0.6 - 7 * 0.5 * 0.5 / 2, 1e-6);
  EXPECT_NEAR(braking.dive, 1.5 * kDegree, 1e-12);
  const VehicleState resting = driven(vehicle, 3);
  EXPECT_EQ(resting.v, 0);
  EXPECT_NEAR(resting.y, 1 + 10 * 10 / (2 * 7.0), 1e-3);
  // The nose goes down about the rear axle.
  EXPECT_LT((vehicle_pose(vehicle, resting) * Vec3(0, 0, 0.5)).z(), 0.5 - 0.05);
}

TEST(Car, TwistIsTheDerivativeOfItsPose) {
  const Vehicle vehicle = car(VehicleMotion::Braking);
  VehicleState state = driven(vehicle, 0.15);  // while the nose goes down
  const Vec3 p_F(0.3, -0.8, 0.9);
  const Pose before = vehicle_pose(vehicle, state);
  advance_vehicle(vehicle, 0.15, kStep, 0, state);
  const Pose after = vehicle_pose(vehicle, state);
  EXPECT_GT(state.dive_rate, 0.01);
  const Vec3 velocity = vehicle_twist(vehicle, state).shifted(after * p_F - after.p).v;
  EXPECT_LT((velocity - (after * p_F - before * p_F) / kStep).norm(), 1e-3);
}

TEST(Car, FollowsASpeedTable) {
  const VehicleState state = driven(car(VehicleMotion::Table), 0.5);
  EXPECT_NEAR(state.v, 7, 1e-9);
  EXPECT_NEAR(state.y, 10 * 0.5 - 6 * 0.25 / 2, 1e-9);
}

TEST(Car, OfFreeMassLosesTheMomentumOfThePush) {
  const VehicleState state = driven(car(VehicleMotion::Free), 0.5, -2600);
  EXPECT_NEAR(state.v, 10 - 2600 * 0.5 / 1300, 1e-9);
}

TEST(Car, OfFreeMassPaysForThePedestriansEnergy) {
  MbNode node(
      load_config("v2370", RunMode::Multibody, "[vehicle]\nmotion = \"free\"\nmass_kg = 1300.0\n"));
  KeptRecords sink;
  const double start = node.state().vehicle.v;
  for (int k = 0; k < 750; ++k) node.advance(grant(k), sink);  // 15 ms
  const double end = node.state().vehicle.v;
  const double given = 0.5 * 1300 * (start * start - end * end);
  EXPECT_GT(given, 100);
  EXPECT_NEAR(node.energies().car_work, given, 1e-3 * given);
}

}  // namespace
}  // namespace crosswalk::mb
