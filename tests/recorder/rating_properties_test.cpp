// What the ratings and criteria must satisfy whatever the numbers: invariances and closed forms.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/units.h"
#include "recorder/scoring/cora.h"
#include "recorder/scoring/iso18571.h"
#include "recorder/scoring/score_card.h"
#include "recorder/scoring/score_json.h"
#include "recorder/signal.h"

namespace crosswalk::recording {
namespace {

constexpr double kStep = 1e-4;  // s

/// A pulse train that resembles a head acceleration, m/s2.
Series pulses(double late = 0, double scale = 1) {
  Series s;
  for (int i = 0; i < 1001; ++i) {
    const double t = i * kStep;
    s.t.push_back(t);
    const double main = std::exp(-std::pow((t - 0.05 - late) / 0.004, 2));
    const double second = 0.4 * std::exp(-std::pow((t - 0.065 - late) / 0.008, 2));
    s.y.push_back(scale * 800 * (main + second));
  }
  return s;
}

Series mapped(Series s, double scale, double time_shift) {
  for (double& y : s.y) y *= scale;
  for (double& t : s.t) t += time_shift;
  return s;
}

TEST(Cora, ScaleSignAndTimeOriginDoNotMatter) {
  const Series x = pulses();
  const Series y = pulses(0.002, 1.1);
  const double C = cora(x, y, {}).C;
  EXPECT_NEAR(cora(mapped(x, 3, 0), mapped(y, 3, 0), {}).C, C, 1e-12);
  EXPECT_NEAR(cora(mapped(x, -1, 0), mapped(y, -1, 0), {}).C, C, 1e-12);
  EXPECT_NEAR(cora(mapped(x, 1, 5.0), mapped(y, 1, 5.0), {}).C, C, 1e-9);
}

TEST(Cora, PureScaleEntersOnlySizeAndCorridor) {
  const CoraResult r = cora(pulses(), pulses(0, 0.8), {});
  EXPECT_NEAR(r.V, 1, 1e-12);
  EXPECT_EQ(r.P, 1);
  EXPECT_NEAR(r.G, 0.64, 1e-12);
}

TEST(Cora, PureShiftEntersOnlyPhaseAndCorridor) {
  const double share = 0.06;  // of the 0.1 s interval
  const CoraResult r = cora(pulses(), pulses(share * 0.1), {});
  EXPECT_NEAR(r.V, 1, 1e-6);
  EXPECT_NEAR(r.G, 1, 1e-6);
  EXPECT_NEAR(r.P, (0.12 - share) / 0.11, 1e-9);
  EXPECT_LT(r.delta, 0);
}

TEST(Cora, WorkedExampleOfTwoConstants) {
  Series x, y;
  for (int i = 0; i < 100; ++i) {
    x.t.push_back(i * kStep);
    y.t.push_back(i * kStep);
    x.y.push_back(2.0);
    y.y.push_back(2.4);
  }
  const CoraResult r = cora(x, y, {});
  EXPECT_NEAR(r.C1, std::pow(0.30 / 0.45, 2), 1e-12);
  EXPECT_NEAR(r.C2, 0.75 + 0.25 / 1.44, 1e-12);
  EXPECT_NEAR(r.C, 0.6840, 5e-5);
}

TEST(Cora, SwappedRolesKeepProgressionSizeAndLag) {
  const CoraResult a = cora(pulses(), pulses(0.003, 1.2), {});
  const CoraResult b = cora(pulses(0.003, 1.2), pulses(), {});
  EXPECT_NEAR(a.V, b.V, 1e-12);
  EXPECT_NEAR(a.G, b.G, 1e-12);
  EXPECT_EQ(a.m, -b.m);
}

TEST(Iso18571, ScaleSignAndTimeOriginDoNotMatter) {
  const Series x = pulses();
  const Series y = pulses(0.002, 1.1);
  const double R = iso18571(x, y, {}).R;
  // Rounding decides near-ties of the warping path, hence 1e-9.
  EXPECT_NEAR(iso18571(mapped(x, 3, 0), mapped(y, 3, 0), {}).R, R, 1e-9);
  EXPECT_NEAR(iso18571(mapped(x, -1, 2), mapped(y, -1, 2), {}).R, R, 1e-9);
}

TEST(Cora, ControlFileKeysOfTheIntervalAreUnderstood) {
  EXPECT_EQ(cora_parameters({{"T_MIN", "automatic"}, {"T_MAX", "automatic"}}).interval,
            CoraInterval::Automatic);
  const CoraParameters manual = cora_parameters({{"T_MIN", 0.01}, {"WF_NORM", "YES"}});
  EXPECT_EQ(manual.interval, CoraInterval::Manual);
  EXPECT_EQ(manual.t_min, 0.01);
  EXPECT_EQ(cora_parameters({{"t_max", 0.1}}).interval, CoraInterval::Manual);
  EXPECT_FALSE(cora_parameters({{"Y_NORM", "extremum"}}).Y_norm);
  EXPECT_THROW(cora_parameters({{"interval", "full"}, {"t_min", 0.1}}), SignalError);
  EXPECT_THROW(cora_parameters({{"WF_NORM", "NO"}}), SignalError);
  EXPECT_THROW(cora_parameters({{"MIN_NORM", 0.3}}), SignalError);
}

/// A given edge stands, the other one is found.
TEST(Cora, OneEdgeOfTheIntervalMayBeAutomatic) {
  CoraParameters p = cora_parameters({{"T_MIN", 0.0}, {"T_MAX", "automatic"}});
  const CoraResult r = cora(pulses(), pulses(), p);
  EXPECT_EQ(r.t_min, 0);
  EXPECT_LT(r.t_max, 0.09);
}

TEST(Cora, AStepThatGivesTooManySamplesIsRefused) {
  CoraParameters p;
  p.dt = 1e-12;
  EXPECT_THROW(cora(pulses(), pulses(), p), SignalError);
}

TEST(Iso18571, IrregularTimesAreMadeUniform) {
  Series x = pulses(), irregular;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i % 5 == 2) continue;
    irregular.t.push_back(x.t[i]);
    irregular.y.push_back(x.y[i]);
  }
  Series same = irregular;
  align_grids(irregular, same);
  EXPECT_TRUE(is_uniform(irregular.t));
  EXPECT_EQ(irregular.t, same.t);
}

TEST(Iso18571, DifferentGridsAreAlignedFirst) {
  Series x = pulses();
  Series coarse;
  for (std::size_t i = 0; i < x.size(); i += 4) {
    coarse.t.push_back(x.t[i]);
    coarse.y.push_back(x.y[i]);
  }
  align_grids(x, coarse);
  EXPECT_EQ(x.size(), coarse.size());
  EXPECT_GT(iso18571(x, coarse, {}).R, 0.99);
}

TEST(Hic, ScalesWithPowerTwoAndAHalfAndIgnoresTimeOrigin) {
  const Series a = pulses();
  const double one = hic(a, 0.015).value;
  EXPECT_NEAR(hic(mapped(a, 2, 0), 0.015).value / one, std::pow(2.0, 2.5), 1e-9);
  EXPECT_NEAR(hic(mapped(a, 1, -3.0), 0.015).value / one, 1, 1e-9);
}

/// Unrestricted window: HIC of a half sine is 0.41465 A^2.5 T, its window 0.670 T.
TEST(Hic, HalfSineClosedForm) {
  const double T = 0.010, A = 100;
  Series a;
  for (int i = 0; i <= 2000; ++i) {
    a.t.push_back(i * 1e-5);
    a.y.push_back(i <= 1000 ? A * kStandardGravity * std::sin(kPi * i * 1e-5 / T) : 0.0);
  }
  const WindowMaximum w = hic(a, 0.015);
  EXPECT_NEAR(w.value, 0.41465 * std::pow(A, 2.5) * T, 0.2);
  EXPECT_NEAR(*w.t2 - *w.t1, 0.670 * T, 1e-4);
}

VectorSeries spin() {
  const Series s = pulses();
  VectorSeries v{s.t, s.y, s.y, s.y};
  for (std::size_t i = 0; i < s.size(); ++i) {
    v.y[i] *= 0.5;
    v.z[i] *= -0.3;
  }
  return v;
}

TEST(Damage, IsLinearAndFeelsTheSenseOfXAgainstZ) {
  const VectorSeries a = spin();
  VectorSeries doubled = a, flipped = a;
  for (std::size_t i = 0; i < a.t.size(); ++i) {
    doubled.x[i] *= 2;
    doubled.y[i] *= 2;
    doubled.z[i] *= 2;
    flipped.z[i] *= -1;
  }
  EXPECT_NEAR(damage(doubled).value, 2 * damage(a).value, 1e-6);
  EXPECT_GT(std::abs(damage(flipped).value / damage(a).value - 1), 1e-3);
}

/// Constant 1000 rad/s2 about y settles at beta * 1000 / 23493.
TEST(Damage, ConstantAccelerationSettlesAtTheStaticValue) {
  VectorSeries a;
  for (int i = 0; i <= 5000; ++i) {
    a.t.push_back(i * kStep);
    a.x.push_back(0);
    a.y.push_back(1000);
    a.z.push_back(0);
  }
  EXPECT_NEAR(damage(a).value, 0.15304, 1e-5);
}

TEST(Cfc, ThreeDecibelsAtTheClassCorner) {
  // CFC 180: -3 dB of the four-pole filter at 1.667 * CFC for the J211 form.
  const double dt = 1e-5, f = 1.667 * 180;
  std::vector<double> x(60000);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = std::sin(2 * kPi * f * dt * static_cast<double>(i));
  const std::vector<double> y = cfc_filter(x, dt, 180, FilterForm::SaeJ211);
  double peak = 0;
  for (std::size_t i = 20000; i < 40000; ++i) peak = std::max(peak, y[i]);
  EXPECT_NEAR(20 * std::log10(peak), -3.0, 0.1);
}

TEST(Cfc, IsLinearAndReversibleInTime) {
  const std::vector<double> x = pulses().y;
  std::vector<double> reversed(x.rbegin(), x.rend());
  const std::vector<double> y = cfc_filter(x, kStep, 600);
  const std::vector<double> z = cfc_filter(reversed, kStep, 600);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], z[y.size() - 1 - i], 1e-6 * 800);
}

TEST(Cfc, RefusesARateTooLowForTheClass) {
  EXPECT_THROW(cfc_coefficients(1000, 1e-3, FilterForm::Iso6487), SignalError);
  EXPECT_FALSE(is_sampled_for_cfc(1000, 2e-4));
  EXPECT_TRUE(is_sampled_for_cfc(1000, 1e-4));
}

TEST(Signal, DerivativeOfAParabolaIsExactInsideOnUnequalSteps) {
  const std::vector<double> t = {0, 0.1, 0.3, 0.4, 1.0};
  std::vector<double> y;
  for (const double at : t) y.push_back(3 * at * at - at);
  const std::vector<double> d = derivative(t, y);
  for (std::size_t i = 1; i + 1 < t.size(); ++i) EXPECT_NEAR(d[i], 6 * t[i] - 1, 1e-12);
}

TEST(ScoreCard, IrregularSignalsAreResampledBeforeFiltering) {
  const Series s = pulses();
  VectorSeries a;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (i % 7 == 3) continue;
    a.t.push_back(s.t[i]);
    a.x.push_back(s.y[i]);
    a.y.push_back(0);
    a.z.push_back(0);
  }
  HeadSignals irregular, regular;
  irregular.acceleration = a;
  regular.acceleration =
      VectorSeries{s.t, s.y, std::vector<double>(s.size()), std::vector<double>(s.size())};
  const double expected = score_card(filtered(regular)).linear->HIC15.value;
  EXPECT_NEAR(score_card(filtered(irregular)).linear->HIC15.value / expected, 1, 2e-3);
}

TEST(ScoreCard, SaysWhatFilteringDidBesides) {
  HeadSignals signals;
  for (const double t : {0.0, 3e-4, 6e-4, 9e-4, 12e-4, 15e-4}) {
    if (!signals.acceleration) signals.acceleration.emplace();
    signals.acceleration->t.push_back(t);
  }
  signals.acceleration->x.assign(6, 1);
  signals.acceleration->y = signals.acceleration->z = signals.acceleration->x;
  EXPECT_THROW(filtered(signals), SignalError);  // CFC 1000 needs more than 4630 samples per second
  for (double& t : signals.acceleration->t) t *= 0.5;
  signals.acceleration->t.back() += 1e-4;
  signals.angular_velocity = signals.angular_acceleration = signals.acceleration;
  const std::vector<std::string> notes = score_card(filtered(signals)).notes;
  ASSERT_EQ(notes.size(), 4U);
  EXPECT_NE(notes[0].find("acceleration: samples are irregular"), std::string::npos);
  EXPECT_NE(notes[1].find("CFC 1000 asks for 10000"), std::string::npos);
  EXPECT_NE(notes[3].find("is not used"), std::string::npos);
}

TEST(BrainMetrics, RefuseWhatIsNotANumber) {
  VectorSeries w = spin();
  w.y[3] = std::nan("");
  EXPECT_THROW(bric(w), SignalError);
  EXPECT_THROW(ubric(spin(), w, UbricPeak::PeakToPeak), SignalError);
}

TEST(ScoreCard, NamesChannelAndSampleOfANan) {
  HeadSignals signals;
  signals.acceleration = VectorSeries{{0, 1e-4}, {0, std::nan("")}, {0, 0}, {0, 0}};
  try {
    score_card(signals);
    FAIL() << "NaN was accepted";
  } catch (const SignalError& error) {
    EXPECT_EQ(error.fault(), SignalFault::NotFinite);
    EXPECT_NE(std::string(error.what()).find("acceleration x: sample 1"), std::string::npos);
  }
}

}  // namespace
}  // namespace crosswalk::recording
