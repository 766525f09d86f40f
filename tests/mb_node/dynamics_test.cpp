// Physics of the assembled pedestrian: momentum in free flight, energy books through an impact.
#include "mb_node/dynamics.h"

#include <gtest/gtest.h>

#include "mb_node/mb_node.h"
#include "mb_node/world_builder.h"
#include "tests/mb_node/mb_fixture.h"

namespace crosswalk::mb {
namespace {

struct Flight {
  double linear = 0, angular = 0, drift = 0;
};

/// Whole body thrown and spun, all restraints acting, no gravity, no car near; relative errors.
Flight tumble(double duration) {
  MbModel model = build_model(load_config("v2370", RunMode::Multibody,
                                          "[vehicle]\nspeed_km_h = 0.0\ngap_mm = 900.0\n"
                                          "[environment]\ngravity_m_s2 = 0.0\n"));
  MbState state = initial_state(model);
  OdeWorld world = build_world(model, std::vector<Inertia>(model.config.body.segments.size()));
  const Vec3 centre = world.position(0), w(3, 1, 5), v(0, 8, 6);
  for (int i = 0; i < world.body_count(); ++i) {
    world.set_twist(i, {v + w.cross(world.position(i) - centre), w});
  }
  Dynamics dynamics(model, world);
  const auto angular = [&world] {
    Vec3 centre_now = Vec3::Zero();
    double mass = 0;
    for (int i = 0; i < world.body_count(); ++i) {
      centre_now += world.mass(i) * world.position(i);
      mass += world.mass(i);
    }
    return world.angular_momentum(centre_now / mass);
  };
  const Vec3 P0 = world.linear_momentum(), L0 = angular();
  const double dt = 1e-5;
  Flight worst;
  for (int k = 0; k * dt < duration; ++k) {
    dynamics.substep(state, dt, {});
    if (k % 100 != 99) continue;
    worst.linear = std::max(worst.linear, (world.linear_momentum() - P0).norm() / P0.norm());
    worst.angular = std::max(worst.angular, (angular() - L0).norm() / L0.norm());
    worst.drift = std::max(worst.drift, world.joint_drift());
  }
  return worst;
}

TEST(FreeFlight, KeepsMomentumWithAllRestraintsActing) {
  const Flight flight = tumble(0.02);
  EXPECT_LT(flight.linear, 1e-10);
  EXPECT_LT(flight.angular, 1e-5);
  EXPECT_LT(flight.drift, 1e-5);
}

TEST(Impact, EnergyBooksClose) {
  MbNode node(load_config("v2370", RunMode::Multibody));
  KeptRecords sink;
  double largest = 0, worst = 0, dissipated = 0;
  for (int k = 0; k < 500; ++k) {  // 10 ms: leg and bumper
    const MbReply r = node.advance(grant(k), sink);
    largest = std::max(largest, r.kinetic);
    worst = std::max(worst, std::abs(node.energy_balance()));
    EXPECT_GE(r.joint_dissipated, dissipated - 1e-3 * (1 + dissipated)) << "at window " << k;
    dissipated = std::max(dissipated, r.joint_dissipated);
  }
  EXPECT_GT(largest, 100);
  EXPECT_LT(worst, 0.01 * largest);
}

}  // namespace
}  // namespace crosswalk::mb
