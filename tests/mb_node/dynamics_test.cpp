// Physics of the assembled pedestrian: momentum in free flight, energy books through an impact.
#include "mb_node/dynamics.h"

#include <gtest/gtest.h>

#include "mb_node/mb_node.h"
#include "mb_node/world_builder.h"
#include "tests/mb_node/mb_fixture.h"

namespace crosswalk::mb {
namespace {

struct Flight {
  double linear = 0, angular = 0, drift = 0, energy = 0, lost = 0;
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
  const double E0 = world.kinetic_energy(),
               V0 = P0.squaredNorm() / (2 * model.config.body.total_mass());
  const double dt = 1e-5;
  Flight worst;
  for (int k = 0; k * dt < duration; ++k) {
    dynamics.substep(state, dt, {});
    if (k % 100 != 99) continue;
    worst.linear = std::max(worst.linear, (world.linear_momentum() - P0).norm() / P0.norm());
    worst.angular = std::max(worst.angular, (angular() - L0).norm() / L0.norm());
    worst.drift = std::max(worst.drift, world.joint_drift().distance);
    const double held = world.kinetic_energy() + dynamics.joint_energy(state) +
                        dynamics.contact_energy(state) + state.energy.lost.sum();
    // Of the energy of tumbling, without the flight of the centre.
    worst.energy = std::max(worst.energy, std::abs(held - E0) / (E0 - V0));
  }
  worst.lost = (state.energy.lost.sum() - state.energy.lost[MbLoss::JointPassive]) / (E0 - V0);
  return worst;
}

TEST(FreeFlight, KeepsMomentumAndEnergyForHalfASecond) {
  const Flight flight = tumble(0.5);
  EXPECT_LT(flight.linear, 1e-10);
  EXPECT_LT(flight.angular, 1e-5);
  EXPECT_LT(flight.drift, 1e-5);
  EXPECT_LT(flight.energy, 2e-3) << "kinetic + stored + lost by each law";
  EXPECT_GT(flight.lost, 0.05) << "joints at their stops lose energy: the books were used";
}

TEST(Impact, EnergyBooksClose) {
  MbNode node(load_config("v2370", RunMode::Multibody));
  KeptRecords sink;
  double largest = 0, worst = 0;
  LossBooks lost;
  for (int k = 0; k < 500; ++k) {  // 10 ms: leg and bumper
    node.advance(grant(k), sink);
    const MbEnergies energies = node.energies();
    largest = std::max(largest, energies.kinetic);
    worst = std::max(worst, std::abs(node.energy_balance(energies)));
    if (k == 24) {  // 0.3 ms after the harness let go of feet that press 0.4 J into the ground
      EXPECT_LT(worst, 0.02);
    }
    for (std::size_t i = 0; i < kMbLosses; ++i) {
      if (static_cast<MbLoss>(i) == MbLoss::JointPassive) continue;  // this one gives back, too
      EXPECT_GE(energies.lost.J[i], lost.J[i] - 1e-6) << kMbLossNames[i] << " at window " << k;
    }
    lost = energies.lost;
  }
  EXPECT_GT(largest, 100);
  EXPECT_LT(worst, 0.01 * largest);
}

}  // namespace
}  // namespace crosswalk::mb
