// The coupling schemes on the lattice neck: against the neck whole in the finite-element solver,
// with three bodies on joints, in free flight, and after a save and a restore.
#include <gtest/gtest.h>

#include "tests/coupler/neck_run.h"

namespace crosswalk::coupling {
namespace {

class NeckOnOneBody : public testing::TestWithParam<double> {};

TEST_P(NeckOnOneBody, MicFollowsTheNeckThatIsWholeInTheSolver) {
  const NeckCase c{.body_mass = GetParam(), .push = std::min(1500.0, 300 * GetParam() + 200)};
  constexpr double kEnd = 40e-3;
  const WholeNeck whole = run_whole(c, kEnd);
  const NeckOutcome coupled = CoupledNeck(c, Scheme::Mic).run(20000, kEnd);
  ASSERT_TRUE(coupled.is_stable);
  // The head travels millimetres; what is left is the first-order step of the multibody side.
  EXPECT_LT((coupled.head - whole.head).norm(), 20e-6);
  EXPECT_NEAR(coupled.energy, whole.energy, 0.005 * whole.peak_energy);
  EXPECT_NEAR(coupled.drift, 0, 0.005 * whole.peak_energy);
  EXPECT_LT(coupled.gap, 0.1e-3);
}

INSTANTIATE_TEST_SUITE_P(Masses, NeckOnOneBody, testing::Values(15.0, 1.0, 0.3, 0.1));

TEST(NeckOnOneBody, ImplicitFollowsItToo) {
  const NeckCase c{.body_mass = 0.3, .push = 300};
  const WholeNeck whole = run_whole(c, 10e-3);
  const NeckOutcome coupled = CoupledNeck(c, Scheme::Implicit).run(20000, 10e-3);
  ASSERT_TRUE(coupled.is_stable);
  EXPECT_LT((coupled.head - whole.head).norm(), 20e-6);
  EXPECT_NEAR(coupled.energy, whole.energy, 0.005 * whole.peak_energy);
}

TEST(NeckOnThreeBodies, MicKeepsToAFineReferenceWithJointsAndAWall) {
  for (const bool has_wall : {false, true}) {
    NeckCase c{.has_clavicles = true, .has_wall = has_wall, .push = 4000};
    const NeckOutcome coupled = CoupledNeck(c, Scheme::Mic).run(20000, 30e-3);
    c.mb_step = 2e-6;
    const NeckOutcome fine = CoupledNeck(c, Scheme::Mic).run(2000, 30e-3);
    ASSERT_TRUE(coupled.is_stable && fine.is_stable);
    // 10 us steps of the multibody side leave some ten micrometres, a wall several times that.
    EXPECT_LT((coupled.head - fine.head).norm(), has_wall ? 150e-6 : 30e-6);
    EXPECT_NEAR(coupled.energy, fine.energy, 0.005 * fine.peak_energy);
    EXPECT_LT(coupled.gap, 0.1e-3);
  }
}

TEST(NeckOnThreeBodies, SpinningFreelyKeepsItsMomenta) {
  std::vector<double> errors;
  for (const double step : {10e-6, 5e-6}) {
    const NeckCase c{.has_clavicles = true, .push = 0, .spin = {4, 2, 5}, .mb_step = step};
    CoupledNeck neck(c, Scheme::Mic);
    const NeckOutcome before = neck.run(20000, 20e-6), after = neck.run(20000, 50e-3);
    ASSERT_TRUE(after.is_stable);
    EXPECT_LT((after.momentum - before.momentum).norm(), 1e-9 * before.momentum.norm());
    errors.push_back((after.angular_momentum - before.angular_momentum).norm() /
                     before.angular_momentum.norm());
  }
  // First order in the multibody step.
  EXPECT_LT(errors[0], 1e-3);
  EXPECT_NEAR(errors[1], errors[0] / 2, 0.1 * errors[0]);
}

TEST(NeckOnThreeBodies, SavedAndRestoredWindowsAreTheSameBits) {
  const NeckCase c{.has_clavicles = true};
  CoupledNeck neck(c, Scheme::Mic);
  neck.run(20000, 2e-3);
  const auto mb = neck.mb().save_state(), fe = neck.fe().save_state();
  const CouplingState coupling = neck.state();
  neck.run(20000, 100e-6);
  const auto mb_after = neck.mb().save_state(), fe_after = neck.fe().save_state();
  ASSERT_NE(fe_after, fe);
  neck.mb().load_state(mb);
  neck.fe().load_state(fe);
  neck.state() = coupling;
  neck.run(20000, 100e-6);
  EXPECT_EQ(neck.mb().save_state(), mb_after);
  EXPECT_EQ(neck.fe().save_state(), fe_after);
}

}  // namespace
}  // namespace crosswalk::coupling
