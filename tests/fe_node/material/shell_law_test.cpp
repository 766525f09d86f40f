#include <random>

#include <gtest/gtest.h>

#include "fe_node/element/shell_section.h"

namespace crosswalk::fe {
namespace {

constexpr double kE = 200e9, kNu = 0.3;
constexpr double kG = 0.5 * kE / (1 + kNu);

/// One point of a law, driven by strain increments.
template <class Law>
struct Point {
  Law law;
  std::vector<double> history = std::vector<double>(law.history_size());
  PlaneTensor<double> stress{};
  double thinning = 0, alive = 1, work_done = 0;

  explicit Point(const Law& l) : law(l) { law.initialise(history.data()); }
  void strain(const PlaneTensor<double>& increment, double dt = 1e-6) {
    const PlaneStep<double> step{increment, stress, dt};
    const PlaneAnswer<double> answer = law.update(step, history.data());
    work_done += 0.5 * (work(stress, increment) + work(answer.stress, increment));
    stress = answer.stress;
    thinning += answer.thinning;
    alive = answer.alive;
  }
  /// Uniaxial stress along x: yy follows so that its stress vanishes.
  void pull(double xx, double dt = 1e-6) {
    const std::vector<double> kept = history;
    const PlaneTensor<double> stress_kept = stress;
    auto trial = [&](double yy) {
      history = kept;
      const PlaneStep<double> step{{xx, yy, 0, 0, 0}, stress_kept, dt};
      return law.update(step, history.data()).stress.yy;
    };
    double a = -kNu * xx, b = -0.5 * xx, fa = trial(a), fb = trial(b);
    for (int i = 0; i < 30 && std::abs(fb - fa) > 0; ++i) {
      const double c = b - fb * (b - a) / (fb - fa);
      a = b, fa = fb, b = c, fb = trial(c);
    }
    history = kept;
    strain({xx, b, 0, 0, 0}, dt);
  }
};

ShellPlastic steel() {
  ShellPlastic law{7850, kE, kNu, {}, 0, 0};
  const double strain[] = {0, 0.02, 0.1}, stress[] = {200e6, 260e6, 300e6};
  law.yield = YieldStress(HardeningCurve(strain, stress));
  return law;
}

TEST(ShellPlastic, UniaxialTensionFollowsTheCurve) {
  Point<ShellPlastic> point(steel());
  for (int i = 0; i < 400; ++i) point.pull(0.05 / 400);
  const double p = point.history[ShellPlastic::kPlasticStrain];
  EXPECT_NEAR(point.stress.xx, 260e6 + (p - 0.02) * 500e6, 1e-6 * 260e6);
  EXPECT_NEAR(p, 0.05 - point.stress.xx / kE, 1e-5);
  // plastic flow keeps its volume: e_z = -nu sigma / E - p / 2
  EXPECT_NEAR(point.thinning, -kNu * point.stress.xx / kE - 0.5 * p, 1e-6);
}

TEST(ShellPlastic, PureShearYieldsAtMisesStress) {
  Point<ShellPlastic> point(steel());
  point.strain({0, 0, 0.02, 0, 0});
  const double p = point.history[ShellPlastic::kPlasticStrain];
  EXPECT_NEAR(std::sqrt(3.0) * point.stress.xy, 200e6 + 3e9 * p, 1);
  EXPECT_NEAR(0.02, point.stress.xy / kG + std::sqrt(3.0) * p, 1e-12);
}

TEST(ShellPlastic, BiaxialStretchYieldsAtTheCurveWithTwiceTheThinning) {
  Point<ShellPlastic> point(steel());
  for (int i = 0; i < 100; ++i) point.strain({1e-4, 1e-4, 0, 0, 0});
  const double p = point.history[ShellPlastic::kPlasticStrain];
  EXPECT_NEAR(point.stress.xx, 200e6 + 3e9 * p, 1e3);
  EXPECT_NEAR(point.stress.yy, point.stress.xx, 1e-3);
  // equal biaxial: effective strain is the thinning, 2 e_p = p
  EXPECT_NEAR(2 * (0.01 - (1 - kNu) * point.stress.xx / kE), p, 1e-9);
}

TEST(ShellPlastic, KinematicHardeningYieldsEarlyInReverse) {
  ShellPlastic law{7850, kE, kNu, YieldStress(HardeningCurve::linear(200e6, 0)), 2e9, 0};
  Point<ShellPlastic> point(law);
  for (int i = 0; i < 200; ++i) point.pull(1e-4);
  const double top = point.stress.xx;
  EXPECT_NEAR(top, 200e6 + 2e9 * (0.02 - top / kE), 1e4);
  double reverse = top;
  for (int i = 0; i < 400; ++i) {  // unload until the stiffness drops
    const double before = point.stress.xx;
    point.pull(-1e-5);
    if (before - point.stress.xx < 0.5 * kE * 1e-5) break;
    reverse = point.stress.xx;
  }
  EXPECT_NEAR(top - reverse, 2 * 200e6, 2 * kE * 1e-5);  // the elastic range keeps its width
}

TEST(ShellPlastic, RateTableAndCowperSymondsRaiseTheYield) {
  ShellPlastic law = steel();
  law.yield =
      YieldStress({0, 100}, {HardeningCurve::linear(200e6, 0), HardeningCurve::linear(300e6, 0)});
  // pure shear at the effective rate gamma / sqrt(3) = 50 / s lies half-way between the curves
  Point<ShellPlastic> point(law);
  const double gamma = 0.02;
  point.strain({0, 0, gamma, 0, 0}, gamma / std::sqrt(3.0) / 50);
  EXPECT_NEAR(std::sqrt(3.0) * point.stress.xy, 250e6, 1);

  law.yield = YieldStress(HardeningCurve::linear(200e6, 0));
  law.yield.set_cowper_symonds(40, 5);
  Point<ShellPlastic> fast(law);
  fast.strain({0, 0, gamma, 0, 0}, gamma / std::sqrt(3.0) / 50);
  EXPECT_NEAR(std::sqrt(3.0) * fast.stress.xy, 200e6 * (1 + std::pow(50.0 / 40, 0.2)), 1);
}

TEST(ShellPlastic, FailsForGoodAtItsStrain) {
  ShellPlastic law = steel();
  law.failure_strain = 0.03;
  Point<ShellPlastic> point(law);
  for (int i = 0; i < 100; ++i) point.pull(2.5e-4);
  EXPECT_EQ(point.alive, 1);
  EXPECT_GT(point.stress.xx, 200e6);
  for (int i = 0; i < 100; ++i) point.strain({5e-4, -2e-4, 0, 0, 0});
  EXPECT_EQ(point.alive, 0);
  EXPECT_EQ(point.stress.xx, 0);
  point.strain({-0.05, 0, 0, 0, 0});
  EXPECT_EQ(point.stress.xx, 0);
}

TEST(ShellGlass, CracksAfterTheDelayAndStillCarriesCompression) {
  const ShellGlass glass{2500, 70e9, 0.23, 80e6, 50e-6, 20e-6};
  Point<ShellGlass> point(glass);
  const double at_strength = 80e6 / 70e9;
  for (int i = 0; i < 20; ++i) point.pull(1.1 * at_strength / 20);
  EXPECT_NEAR(point.stress.xx, 88e6, 1e3);  // above, but not for long enough
  for (int i = 0; i < 60; ++i) point.strain({}, 1e-6);
  EXPECT_LT(point.stress.xx, 80e6);
  for (int i = 0; i < 60; ++i) point.strain({}, 1e-6);
  EXPECT_NEAR(point.stress.xx, 0, 1);
  point.strain({2e-3, 0, 0, 0, 0});
  EXPECT_NEAR(point.stress.xx, 0, 1);
  // close it and go on: compression comes back where the crack closes, not before
  const double open = 1.1 * at_strength + 2e-3;
  point.strain({-open, 0, 0, 0, 0});
  const double yy = point.stress.yy;
  point.strain({-1e-3, 0, 0, 0, 0});
  EXPECT_NEAR(point.stress.xx, 70e9 / (1 - 0.23 * 0.23) * (-1e-3) + 0.23 * yy, 1e6);
}

TEST(ShellGlass, SecondCrackIsNormalToTheFirst) {
  const ShellGlass glass{2500, 70e9, 0.23, 80e6, 0, 1e-6};
  Point<ShellGlass> point(glass);
  const double e = 2 * 80e6 / 70e9;
  point.strain({e, 0, 0, 0, 0});
  for (int i = 0; i < 5; ++i) point.strain({}, 1e-6);
  EXPECT_NEAR(point.stress.xx, 0, 1);
  point.strain({0, e, 0, 0, 0});
  for (int i = 0; i < 5; ++i) point.strain({}, 1e-6);
  EXPECT_NEAR(point.stress.yy, 0, 1);
  EXPECT_NEAR(point.stress.xx, 0, 1);
}

TEST(ShellGlass, WideOpenCrackDoesNotOpenTheOther) {
  Point<ShellGlass> point(ShellGlass{2500, 70e9, 0.23, 80e6, 0, 1e-6});
  point.strain({2e-3, 0, 0, 0, 0});
  for (int i = 0; i < 5; ++i) point.strain({});
  point.strain({0.05, 0, 0, 0, 0});
  EXPECT_NEAR(point.stress.yy, 0, 1e3);
  point.strain({0, 1e-3, 0, 0, 0});
  EXPECT_NEAR(point.stress.yy, 70e6, 1e3) << "carried along the crack";
}

/// However time is cut into steps, the crack opens at the same time.
TEST(ShellGlass, OpensInsideAStep) {
  const auto left_after = [](int steps) {
    constexpr double kTime = 70e-6, kTension = 160e6;
    Point<ShellGlass> point(ShellGlass{2500, 70e9, 0.23, 80e6, 20e-6, 20e-6});
    for (int i = 0; i < steps; ++i) point.pull(kTension / 70e9 / steps, kTime / steps);
    return point.stress.xx;
  };
  // 80 MPa at 35 us, open from 55 us, a quarter left at 70 us
  EXPECT_NEAR(left_after(70), 20e6, 1e5);
  for (const int steps : {43, 59, 97, 131}) EXPECT_NEAR(left_after(steps), 20e6, 1e5);
}

TEST(ShellGlass, FacesSlideUnderFrictionAndStayWhereTheySlidTo) {
  const ShellGlass glass{2500, 70e9, 0.23, 80e6, 0, 1e-6};
  const double shear = 0.5 * 70e9 / 1.23, e = 2 * 80e6 / 70e9;
  Point<ShellGlass> point(glass);
  point.strain({e, 0, 0, 0, 0});
  for (int i = 0; i < 5; ++i) point.strain({});
  point.strain({0, 0, 0.01, 0, 0});
  EXPECT_NEAR(point.stress.xy, 0, 1) << "an open crack carries no shear";
  point.strain({-e, 0, 0, 0, 0});
  EXPECT_NEAR(point.stress.xy, 0, 1) << "nor does its closing bring back what it slid by";
  point.strain({-1e-3, 0, 0, 0, 0});
  const double pressure = -point.stress.xx;
  EXPECT_GT(pressure, 70e6);
  point.strain({0, 0, -1e-4, 0, 0});
  EXPECT_NEAR(point.stress.xy, -1e-4 * shear, 1) << "it sticks";
  point.strain({0, 0, -5e-3, 0, 0});
  EXPECT_NEAR(point.stress.xy, -glass.friction * pressure, 1) << "and slips";
}

/// Round a polygon of strains in small steps, cracked once or twice: work per volume, J/m3, must
/// not come out of it. The steps' own error is of their size squared.
TEST(ShellGlass, NoClosedPathOfStrainsGivesEnergy) {
  constexpr int kSteps = 2000;
  constexpr double kElastic = 0.5 * 70e9 * 4e-3 * 4e-3;
  std::mt19937 random(1);
  std::normal_distribution<double> size(0, 4e-3);
  for (int trial = 0; trial < 40; ++trial) {
    Point<ShellGlass> point(ShellGlass{2500, 70e9, 0.23, 80e6, 0, 1e-6});
    const auto crack = [&point](const PlaneTensor<double>& strain) {
      point.strain(strain);
      for (int i = 0; i < 5; ++i) point.strain({});
    };
    crack({4e-3, 0, 0, 0, 0});
    if (trial % 2) crack({0, 4e-3, 0, 0, 0});
    point.work_done = 0;
    PlaneTensor<double> back{};
    const auto go = [&](const PlaneTensor<double>& by) {
      for (int i = 0; i < kSteps; ++i)
        point.strain({by.xx / kSteps, by.yy / kSteps, by.xy / kSteps, 0, 0});
      back = {back.xx - by.xx, back.yy - by.yy, back.xy - by.xy, 0, 0};
    };
    for (int side = 0; side < 4; ++side) go({size(random), size(random), 2 * size(random), 0, 0});
    go(back);
    EXPECT_GT(point.work_done, -1e-5 * kElastic) << "trial " << trial;
  }
}

TEST(ShellGlass, SwitchedOffItIsElastic) {
  ShellGlass glass{2500, 70e9, 0.23, 80e6};
  glass.fracture = GlassFracture::Off;
  Point<ShellGlass> point(glass);
  for (int i = 0; i < 100; ++i) point.pull(1e-4);
  EXPECT_NEAR(point.stress.xx, 70e9 * 0.01, 1e3);
}

TEST(ShellViscoelastic, RelaxesFromTheShortToTheLongModulus) {
  const ShellViscoelastic pvb = ShellViscoelastic::make(1100, 20e9, 0.33e9, 0.69e6, 12.6);
  Point<ShellViscoelastic> point(pvb);
  point.strain({0, 0, 1e-3, 0, 0}, 1e-9);
  EXPECT_NEAR(point.stress.xy, 0.33e9 * 1e-3, 0.1);
  for (int i = 0; i < 1000; ++i) point.strain({}, 1e-4);
  const double G = 0.69e6 + (0.33e9 - 0.69e6) * std::exp(-12.6 * 0.1);
  EXPECT_NEAR(point.stress.xy, G * 1e-3, 1e-6 * G * 1e-3);
}

TEST(ShellTensionSheet, GoesSlackAndComesBackWhereItWrinkled) {
  Point<ShellTensionSheet> point({1100, 10e6, 0.45});
  for (int i = 0; i < 10; ++i) point.pull(1e-3);
  EXPECT_NEAR(point.stress.xx, 10e6 * 0.01, 1);
  point.strain({-0.03, 0, 0, 0, 0});
  EXPECT_NEAR(point.stress.xx, 0, 1e-6);
  EXPECT_NEAR(point.stress.yy, 0, 1e-6);
  point.strain({0.03, 0, 0, 0, 0});
  EXPECT_NEAR(point.stress.xx, 10e6 * 0.01, 1);
}

// Wrinkled shear: only the tension along one diagonal is left.
TEST(ShellTensionSheet, PureShearIsCarriedByOneDiagonal) {
  Point<ShellTensionSheet> point({1100, 10e6, 0.45});
  point.strain({0, 0, 0.02, 0, 0});
  EXPECT_NEAR(point.stress.xx, 0.5 * 10e6 * 0.01, 1);
  EXPECT_NEAR(point.stress.yy, 0.5 * 10e6 * 0.01, 1);
  EXPECT_NEAR(point.stress.xy, 0.5 * 10e6 * 0.01, 1);
}

/// Lanes give what as many single points give.
template <class N, class Law>
void expect_lanes_equal_points(const Law& law) {
  std::vector<N, Eigen::aligned_allocator<N>> history(law.history_size() + 1);
  law.initialise(history.data());
  PlaneTensor<N> stress{constant<N>(0), constant<N>(0), constant<N>(0), constant<N>(0),
                        constant<N>(0)};
  std::vector<Point<Law>> points(kWidth<N>, Point<Law>(law));
  for (int step = 0; step < 30; ++step) {
    PlaneStep<N> lanes;
    lanes.dt = 1e-5;
    lanes.stress = stress;
    auto increment = [&](int lane, int component) {
      return 2e-3 * std::sin(1.0 + lane + 3.0 * component + 0.1 * step);
    };
    for (int lane = 0; lane < kWidth<N>; ++lane) {
      lanes.strain.xx.set(lane, increment(lane, 0));
      lanes.strain.yy.set(lane, increment(lane, 1));
      lanes.strain.xy.set(lane, increment(lane, 2));
      lanes.strain.yz.set(lane, increment(lane, 3));
      lanes.strain.zx.set(lane, increment(lane, 4));
      points[lane].strain({increment(lane, 0), increment(lane, 1), increment(lane, 2),
                           increment(lane, 3), increment(lane, 4)},
                          lanes.dt);
    }
    stress = law.update(lanes, history.data()).stress;
    for (int lane = 0; lane < kWidth<N>; ++lane) {
      const double tolerance = std::max(1e-9, 10 * kRoundOff<N>) * law.youngs_modulus;
      EXPECT_NEAR(stress.xx[lane], points[lane].stress.xx, tolerance);
      EXPECT_NEAR(stress.xy[lane], points[lane].stress.xy, tolerance);
    }
  }
}

template <class N>
void expect_every_law_in_lanes() {
  ShellPlastic rated = steel();
  rated.yield.set_cowper_symonds(40, 5);
  ShellPlastic mixed = steel();
  mixed.kinematic_modulus = 1e9;
  expect_lanes_equal_points<N>(ShellElastic{7850, kE, kNu});
  expect_lanes_equal_points<N>(steel());
  expect_lanes_equal_points<N>(rated);
  expect_lanes_equal_points<N>(mixed);
  expect_lanes_equal_points<N>(ShellViscoelastic::make(1100, 20e9, 0.33e9, 0.69e6, 12.6));
  expect_lanes_equal_points<N>(ShellTensionSheet{1100, 10e6, 0.45});
  expect_lanes_equal_points<N>(ShellGlass{2500, 70e9, 0.23, 80e6});
}

TEST(ShellLaws, LanesEqualSinglePoints) { expect_every_law_in_lanes<Lanes>(); }
TEST(ShellLaws, SingleLanesEqualSinglePoints) { expect_every_law_in_lanes<SingleLanes>(); }

TEST(HardeningCurve, RefusesNonsense) {
  const double strain[] = {0, 0.1, 0.05}, stress[] = {1, 2, 3};
  EXPECT_THROW(HardeningCurve(strain, stress), std::invalid_argument);
  const double late[] = {0.1, 0.2}, two[] = {1, 2};
  EXPECT_THROW(HardeningCurve(late, two), std::invalid_argument);
  const double from_zero[] = {0, 0.2}, negative[] = {0, 2};
  EXPECT_THROW(HardeningCurve(from_zero, negative), std::invalid_argument);
}

}  // namespace
}  // namespace crosswalk::fe
