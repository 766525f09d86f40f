// The rows of the coupling's acceptance table, each with its solvers as processes and the coupler
// program between them over LCM. What the processes leave in their last checkpoint is judged.
#include <Eigen/Dense>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mb_node/mb_node.h"
#include "tests/coupler/neck_run.h"
#include "tests/coupler/pair_rows.h"
#include "tests/system/neck_processes.h"

namespace crosswalk::system_test {
namespace {

using namespace coupling;

constexpr double kShort = kWindowsPerFlush * 20e-6;  // s, windows of 20 us

ToyScenario pair_scenario(const Pair& p) {
  const toy::MbBody body = body_of(p);
  const toy::FePoint point = point_of(p);
  const SchemeSettings settings = settings_of(p);
  return {.tables = fmt::format(
              "scheme = \"{}\"\nmobility_every_windows = {}\ntolerance = {}\n"
              "accepted_residual = {}\n[[interfaces]]\nbody = \"block\"\n"
              "[multibody]\nmass_kg = {}\nspeed_m_s = {}\nstep_s = {}\n"
              "[fe]\nmass_kg = {}\nstiffness_N_per_m = {}\ndamping_N_s_per_m = {}\nstretch_m = {}\n"
              "step_s = {}\nblock_mass_kg = 0\n",
              scheme_name(p.scheme), settings.mobility_every, settings.tolerance,
              settings.accepted_residual, body.mass, body.v, body.step, point.mass, point.stiffness,
              point.damping, point.x, point.step),
          .window_ns = kPairWindow,
          .windows = windows_of(p, kWindowsPerFlush)};
}

TEST(CouplingRows, PairsGrowAsTheirSchemeMayAndAsByDirectCalls) {
  const TemporaryFolder folder;
  const std::vector<Pair> rows = pair_rows();
  std::vector<ToyScenario> scenarios;
  for (const Pair& row : rows) scenarios.push_back(pair_scenario(row));
  const std::vector<ToyOutcome> outcomes = run_toys(folder.path(), scenarios);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Pair& row = rows[i];
    const std::string name = name_of(row);
    toy::WatchedFe fe{toy::FePoint{}};
    fe.load_state(outcomes[i].fe);
    ASSERT_EQ(fe.stretches().size(), static_cast<std::size_t>(scenarios[i].windows)) << name;
    const double growth = growth_per_period(row, fe.stretches());
    EXPECT_GE(growth, growth_limits(row).least) << name;
    EXPECT_LE(growth, growth_limits(row).largest) << name;
    EXPECT_EQ(outcomes[i].fe, direct_run(row, scenarios[i].windows).save_state()) << name;
    fmt::print("{}: {:.6f} per period\n", name, growth);
  }
}

TEST(CouplingRows, TheNeckStaysWithTheNeckThatIsWholeInTheSolver) {
  std::vector<NeckCase> cases;
  for (const double mass : {15.0, 1.0, 0.3, 0.1}) {
    cases.push_back(pushed_neck(mass));
    cases.back().fe_step = kProcessFeStep;
  }
  expect_near_whole(cases, {20});
}

TEST(CouplingRows, SpinningFreelyTheNeckOnThreeBodiesKeepsItsMomenta) {
  const TemporaryFolder folder;
  std::vector<NeckCase> cases;
  std::vector<ToyScenario> scenarios;
  for (const double step : {10e-6, 5e-6}) {
    cases.push_back({.has_clavicles = true,
                     .push = 0,
                     .spin = {4, 2, 5},
                     .mb_step = step,
                     .fe_step = kProcessFeStep});
    scenarios.push_back(scenario_of(cases.back(), 20, 200e-3));
  }
  const std::vector<ToyOutcome> outcomes = run_toys(folder.path(), scenarios);
  std::vector<double> errors;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const NeckOutcome before = CoupledNeck(cases[i], Scheme::Mic).run(20000, 20e-6);
    const NeckOutcome after = neck_after(cases[i], outcomes[i]);
    EXPECT_LT((after.momentum - before.momentum).norm(), 1e-9 * before.momentum.norm());
    errors.push_back((after.angular_momentum - before.angular_momentum).norm() /
                     before.angular_momentum.norm());
  }
  // First order in the multibody step.
  EXPECT_LT(errors[0], 1e-3);
  EXPECT_NEAR(errors[1], errors[0] / 2, 0.1 * errors[0]);
}

// The masses of the blocks go from the one solver through the coupler to the other.
TEST(CouplingRows, BlocksMovedToTheBodiesLeaveTheSumOfTheParts) {
  const TemporaryFolder folder;
  const NeckCase c{.has_clavicles = true};
  const ToyOutcome outcome = run_toys(folder.path(), {scenario_of(c, 20, kShort)}).at(0);
  NeckBodies bodies(c);
  std::vector<Pose> places;
  Inertia parts;
  for (int i = 0; i < bodies.world().body_count(); ++i) {
    places.push_back(bodies.world().pose(i));  // no block yet: the reference points
    Inertia own = Inertia::of_point(bodies.world().mass(i), Vec3::Zero());
    own.about_com = bodies.world().inertia(i);
    parts = parts + own.in(places.back());
  }
  const fe::Model neck = neck_model(c, 0);
  Inertia assembly;
  for (int n = 0; n < neck.mesh.node_count(); ++n) {
    if (neck.body_of_node[n] >= 0) continue;
    const Inertia node = Inertia::of_point(neck.mass[n], neck.mesh.position[n]);
    parts = parts + node;
    assembly = assembly + node;
  }
  for (const fe::RigidBody& block : neck.bodies)
    parts = parts + block.inertia.in({Quat::Identity(), block.origin});
  CoupledNeck told(c, Scheme::Mic);
  told.mb().load_state(outcome.mb);
  for (std::size_t i = 0; i < places.size(); ++i)
    assembly = assembly + told.mb().inertia()[i].in(places[i]);
  EXPECT_GT(told.mb().inertia()[0].mass, c.body_mass);
  EXPECT_NEAR(assembly.mass, parts.mass, 1e-12 * parts.mass);
  EXPECT_LT((assembly.com - parts.com).norm(), 1e-12);
  EXPECT_LT((assembly.about_com - parts.about_com).norm(), 1e-12 * parts.about_com.norm());
}

/// J M^-1 J^T of the attached bodies at rest in their first places, each with its block, about
/// their reference points; ball joints as constraints G v = 0.
Eigen::MatrixXd mobility_in_closed_form(const NeckCase& c, const std::vector<Inertia>& inertia,
                                        const std::vector<BallJoint>& joints) {
  const NeckBodies bodies(c);
  const int n = bodies.world().body_count();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  for (int i = 0; i < n; ++i) {
    const Inertia& own = inertia[static_cast<std::size_t>(i)];
    const Mat3 arm = skew(own.com);
    M.block<3, 3>(6 * i, 6 * i) = own.mass * Mat3::Identity();
    M.block<3, 3>(6 * i, 6 * i + 3) = -own.mass * arm;
    M.block<3, 3>(6 * i + 3, 6 * i) = own.mass * arm;
    M.block<3, 3>(6 * i + 3, 6 * i + 3) = own.about(Vec3::Zero());
  }
  Eigen::MatrixXd W = M.inverse();
  if (!joints.empty()) {
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(3 * static_cast<int>(joints.size()), 6 * n);
    for (int j = 0; j < static_cast<int>(joints.size()); ++j) {
      const BallJoint& joint = joints[static_cast<std::size_t>(j)];
      for (const auto& [body, sign] : {std::pair{joint.parent, 1.0}, {joint.child, -1.0}}) {
        G.block<3, 3>(3 * j, 6 * body) = sign * Mat3::Identity();
        G.block<3, 3>(3 * j, 6 * body + 3) = -sign * skew(joint.p - bodies.world().position(body));
      }
    }
    const Eigen::MatrixXd WG = W * G.transpose();
    W -= WG * (G * WG).inverse() * WG.transpose();
  }
  return W.topLeftCorner(6 * bodies.attached(), 6 * bodies.attached());
}

// The mobility that reaches the coupler (in single precision: 6e-8 of each number), without the
// safety factor.
TEST(CouplingRows, MobilityIsThatOfTheClosedForm) {
  const TemporaryFolder folder;
  const std::vector<NeckCase> cases = {{.body_mass = 0.3}, {.has_clavicles = true}};
  std::vector<ToyScenario> scenarios;
  for (const NeckCase& c : cases) scenarios.push_back(scenario_of(c, 20, kShort));
  const std::vector<ToyOutcome> outcomes = run_toys(folder.path(), scenarios);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    CoupledNeck told(cases[i], Scheme::Mic);
    told.mb().load_state(outcomes[i].mb);
    const Eigen::MatrixXd expected =
        mobility_in_closed_form(cases[i], told.mb().inertia(), ball_joints(cases[i]));
    const Eigen::MatrixXd W = outcomes[i].coupling.mobility / mb::kMobilitySafety;
    ASSERT_EQ(W.rows(), expected.rows());
    EXPECT_LT((W - expected).norm() / expected.norm(), 1e-6) << i;
    EXPECT_EQ(W, W.transpose());  // asymmetry of more than 1e-6 before this is refused
  }
}

TEST(CouplingRows, RestoredInOtherProcessesTheWindowsAreTheSameBits) {
  const TemporaryFolder folder;
  const NeckCase c{.has_clavicles = true, .push = 1500};
  const auto until = [&](int windows) {
    ToyScenario scenario = scenario_of(c, 20, windows * 20e-6);
    scenario.checkpoint_every = kWindowsPerFlush;
    return scenario;
  };
  const ToyOutcome whole = ToyProcesses(folder.path() / "whole", until(88)).outcome();
  const ToyOutcome early = ToyProcesses(folder.path() / "parts", until(80)).outcome();
  const ToyOutcome late = ToyProcesses(folder.path() / "parts", until(88), true).outcome();
  EXPECT_NE(early.fe, whole.fe);
  EXPECT_EQ(late.fe, whole.fe);
  EXPECT_EQ(late.mb, whole.mb);
  EXPECT_EQ(late.coupling.carry, whole.coupling.carry);
  EXPECT_EQ(late.coupling.mobility, whole.coupling.mobility);
}

}  // namespace
}  // namespace crosswalk::system_test
