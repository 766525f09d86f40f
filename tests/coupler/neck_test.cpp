// The coupling schemes on the lattice neck by direct calls: `implicit` against the neck whole in
// the finite-element solver, `mic` with three bodies on joints, a save and a restore. The other
// rows of the acceptance table run as processes (tests/system/coupling_rows_test.cpp).
#include <gtest/gtest.h>

#include "tests/coupler/neck_run.h"

namespace crosswalk::coupling {
namespace {

TEST(NeckOnOneBody, ImplicitFollowsTheNeckThatIsWholeInTheSolver) {
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
