// Stability and conservation of the coupling schemes on a pair with known answer, by direct calls.
#include "coupler/scheme.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "tests/coupler/pair_rows.h"

namespace crosswalk::coupling {
namespace {

class SchemeOnPair : public testing::TestWithParam<Pair> {};

TEST_P(SchemeOnPair, GrowsAsItMay) {
  const Pair pair = GetParam();
  const double growth = growth_per_period(pair, direct_run(pair, windows_of(pair)).stretches());
  EXPECT_GE(growth, growth_limits(pair).least);
  EXPECT_LE(growth, growth_limits(pair).largest);
}

INSTANTIATE_TEST_SUITE_P(Rows, SchemeOnPair, testing::ValuesIn(pair_rows()),
                         [](const auto& row) { return name_of(row.param); });

TEST(Mic, KeepsMomentumIncludingThePendingCarry) {
  toy::Mb mb({.mass = 0.3, .v = 2});
  toy::Fe fe({.mass = 4.5, .stiffness = 1e7, .x = 1e-4, .v = 2});
  toy::NoRecords sink;
  DirectMbLink mb_link(mb, sink);
  DirectFeLink fe_link(fe, sink);
  CouplingState state = start_state(mb.interface_bodies());
  const SchemeSettings settings{.n_attached = 1};
  const double before = 0.3 * 2 + 4.5 * 2;
  for (int i = 0; i < 10000; ++i) advance_window(settings, state, 20000, mb_link, fe_link);
  // What fe has given and mb has not yet got: the carry, and nothing else.
  const double after = 0.3 * mb.now().v + 4.5 * fe.now().v + state.carry[0][0];
  EXPECT_NEAR(after, before, 1e-9 * before);
}

TEST(Mic, InterfaceWorkOfBothSidesAgrees) {
  toy::Mb mb({.mass = 15, .push = 3000});
  toy::Fe fe({.mass = 4.5, .stiffness = 3e5, .damping = 50});
  toy::NoRecords sink;
  DirectMbLink mb_link(mb, sink);
  DirectFeLink fe_link(fe, sink);
  CouplingState state = start_state(mb.interface_bodies());
  const SchemeSettings settings{.n_attached = 1};
  double exchanged = 0, last = 0;
  WindowResult result;
  for (int i = 0; i < 5000; ++i) {
    result = advance_window(settings, state, 20000, mb_link, fe_link);
    exchanged += std::abs(result.fe.interface_work - last);
    last = result.fe.interface_work;
  }
  EXPECT_GT(exchanged, 10);
  EXPECT_NEAR(result.mb.energy.interface_work + result.fe.interface_work, 0, 0.001 * exchanged);
}

TEST(Mic, WindowLengthsFromTwoToAHundredMicrosecondsGiveTheSameMotion) {
  std::vector<double> heads;
  for (const std::int64_t window_ns : {2000, 5000, 10000, 20000, 50000, 100000}) {
    toy::Mb mb({.mass = 0.3, .push = 100, .step = 2e-6});
    toy::Fe fe({.mass = 4.5, .stiffness = 3e5, .damping = 30});
    toy::NoRecords sink;
    DirectMbLink mb_link(mb, sink);
    DirectFeLink fe_link(fe, sink);
    CouplingState state = start_state(mb.interface_bodies());
    const SchemeSettings settings{.n_attached = 1};
    for (std::int64_t t = 0; t < 50'000'000; t += window_ns) {
      advance_window(settings, state, window_ns, mb_link, fe_link);
    }
    heads.push_back(fe.now().x);
  }
  // The body travels 26 mm; the step of the multibody side alone (2 us) costs micrometres.
  for (const double x : heads) EXPECT_NEAR(x, heads.front(), 20e-6);
}

// Without acceleration the iteration contracts by a = k H^2 / (6 M): 2 for the window, 1/2 for its
// half. With a wrench constant over a half, b = k h^2 / M / (1 + k h^2 / (6 M)) = 2.1 and
// b x^2 + (1 - b/4) v^2 h^2 is kept, not the energy, which swings by 1.4. A window near zero force
// now and then needs quarters and starts another swing (how often depends on round-off): the energy
// wanders, but must not grow.
TEST(Implicit, DoesAWindowInPartsThatDoesNotConvergeAsAWhole) {
  const toy::FePoint point{.mass = 10, .stiffness = 1.2e9, .x = 1e-3};
  toy::Mb mb({.mass = 1, .step = 1e-6});
  toy::Fe fe(point);
  toy::NoRecords sink;
  DirectMbLink mb_link(mb, sink);
  DirectFeLink fe_link(fe, sink);
  CouplingState state = start_state(mb.interface_bodies());
  const SchemeSettings settings{.scheme = Scheme::Implicit,
                                .n_attached = 1,
                                .tolerance = 1e-8,
                                .accepted_residual = 1e-6,
                                .max_iterations = 40,
                                .anderson_depth = 0};
  const double energy = 0.5 * point.stiffness * point.x * point.x;
  double early = 0, late = 0;
  for (int i = 0; i < 400; ++i) {
    const WindowResult result = advance_window(settings, state, 100000, mb_link, fe_link);
    EXPECT_GT(result.parts, 1);
    EXPECT_EQ(result.id.window, i);
    const double now = result.mb.energy.kinetic + result.fe.kinetic + result.fe.internal;
    (i < 200 ? early : late) = std::max(i < 200 ? early : late, now);
    // Momentum, the pending impulse included.
    const double scale = 10 * std::abs(fe.now().v) + std::abs(mb.now().v);
    EXPECT_NEAR(mb.now().v + 10 * fe.now().v + state.carry[0][0], 0, 1e-9 * scale);
  }
  EXPECT_EQ(state.window, 400);
  EXPECT_LT(early, 2.5 * energy);
  EXPECT_LT(late, 1.2 * early);
}

TEST(Implicit, RefusesToGoOnWithoutConvergence) {
  toy::Mb mb({.mass = 0.1});
  toy::Fe fe({.mass = 10, .stiffness = 1e9, .x = 1e-3});
  toy::NoRecords sink;
  DirectMbLink mb_link(mb, sink);
  DirectFeLink fe_link(fe, sink);
  CouplingState state = start_state(mb.interface_bodies());
  const SchemeSettings settings{.scheme = Scheme::Implicit,
                                .n_attached = 1,
                                .tolerance = 1e-9,
                                .accepted_residual = 1e-9,
                                .max_iterations = 2};
  EXPECT_THROW(advance_window(settings, state, 100000, mb_link, fe_link), NumericalError);
}

}  // namespace
}  // namespace crosswalk::coupling
