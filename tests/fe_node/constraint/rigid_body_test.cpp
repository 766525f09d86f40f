#include "fe_node/constraint/rigid_body.h"

#include <gtest/gtest.h>

namespace crosswalk::fe {
namespace {

RigidBody plate() {
  RigidBody body;
  body.inertia.mass = 2;
  body.inertia.about_com = Vec3(0.01, 0.03, 0.05).asDiagonal();
  return body;
}

TEST(RigidBody, FreeSpinKeepsAngularMomentumAndEnergy) {
  // About the middle axis, the unstable one: the body tumbles.
  const RigidBody body = plate();
  BodyState state;
  state.V_WB.w = Vec3(0.1, 40, 0.1);
  state.angular_momentum = angular_momentum(body, state.X_WB, state.V_WB.w);
  const Vec3 L = state.angular_momentum;
  const double energy = 0.5 * L.dot(state.V_WB.w);
  double worst = 0, turned = 1;
  for (int i = 0; i < 20000; ++i) {
    move_free_body(body, {}, Vec3::Zero(), 1e-4, 1e-4, state);
    worst = std::max(worst, std::abs(0.5 * L.dot(state.V_WB.w) / energy - 1));
    turned = std::min(turned, (state.X_WB.q * Vec3::UnitY()).y());
  }
  EXPECT_EQ(state.angular_momentum, L);
  EXPECT_LT(worst, 1e-4);   // second order in |omega| dt = 4e-3
  EXPECT_LT(turned, -0.9);  // it did tumble
}

TEST(RigidBody, TorqueFreeSymmetricTopPrecessesAtTheKnownRate) {
  // Precession rate L / I1 about the fixed momentum [goldstein2002, 5.6].
  RigidBody body = plate();
  body.inertia.about_com = Vec3(0.02, 0.02, 0.05).asDiagonal();
  BodyState state;
  state.V_WB.w = Vec3(3, 0, 20);
  state.angular_momentum = angular_momentum(body, state.X_WB, state.V_WB.w);
  const Vec3 axis = state.angular_momentum.normalized();
  const Vec3 start = Vec3::UnitZ() - axis * axis.z();
  const double rate = state.angular_momentum.norm() / 0.02;
  const double dt = 1e-5;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) move_free_body(body, {}, Vec3::Zero(), dt, dt, state);
  const Vec3 symmetry = state.X_WB.q * Vec3::UnitZ();
  const Vec3 now = symmetry - axis * axis.dot(symmetry);
  const double angle = std::atan2(axis.dot(start.cross(now)), start.dot(now));
  EXPECT_NEAR(std::remainder(angle - rate * dt * steps, 2 * M_PI), 0, 1e-3);
}

TEST(RigidBody, LockedAxesStayStill) {
  RigidBody body = plate();
  body.locked = {true, false, false, false, true, true};
  BodyState state;
  move_free_body(body, {{5, 6, 7}, {1, 2, 3}}, Vec3::Zero(), 1e-3, 1e-3, state);
  EXPECT_EQ(state.V_WB.v.x(), 0);
  EXPECT_NEAR(state.V_WB.v.y(), 3e-3, 1e-12);
  EXPECT_EQ(state.V_WB.w.y(), 0);
  EXPECT_EQ(state.V_WB.w.z(), 0);
  EXPECT_NEAR(state.V_WB.w.x(), 0.1, 1e-12);
}

}  // namespace
}  // namespace crosswalk::fe
