// The multibody pedestrian against published trends and bands, in whole impacts (label validation).
#include <cmath>

#include <gtest/gtest.h>

#include "mb_node/study.h"
#include "tests/source_folder.h"

namespace crosswalk::mb {
namespace {

constexpr const char* kFast = "[multibody]\nstepper = \"quick\"\nsubstep_us = 20.0\n";

SoloSummary impact(const std::string& test, const std::string& more = {}, double duration = 0.2) {
  const std::filesystem::path scenarios = source_folder() / "scenarios";
  return run_case({test, "", 0, "base = \"" + test + ".toml\"\n" + more + kFast, duration},
                  scenarios);
}

TEST(CadaverTests, HeadMeetsTheGlassInTimeAndInTheOrderOfStatures) {
  const SoloSummary a = impact("v2374"), b = impact("v2370"), c = impact("v2371");
  for (const SoloSummary* s : {&a, &b, &c}) {
    EXPECT_EQ(s->head_component, "windshield");
    EXPECT_GT(s->head_contact, 0.100);
    EXPECT_LT(s->head_contact, 0.150);
    EXPECT_GT(s->head_speed, 0.9 * s->car_speed);
    EXPECT_LT(s->head_speed, 1.4 * s->car_speed);
    EXPECT_GT(s->wrap_around, 1.12 * s->stature);
    EXPECT_LT(s->wrap_around, 1.25 * s->stature);
    EXPECT_LT(s->energy_error, 0.01);
  }
  EXPECT_LE(a.head_contact, b.head_contact);
  EXPECT_LT(b.head_contact, c.head_contact);
}

TEST(Trends, ShorterSubjectsAreStruckEarlierAndLower) {
  const auto sized = [](const char* subject) {
    return impact("walking_40",
                  std::string("[subject]\nbase = \"../subjects/") + subject + ".toml\"\n");
  };
  const SoloSummary child = sized("child_6"), woman = sized("female_05"), man = sized("male_50"),
                    large = sized("male_95");
  EXPECT_LT(child.head_contact, woman.head_contact);
  EXPECT_LT(woman.head_contact, man.head_contact);
  EXPECT_LT(man.head_contact, large.head_contact);
  EXPECT_LT(child.wrap_around, woman.wrap_around);
  EXPECT_LT(woman.wrap_around, man.wrap_around);
  EXPECT_LT(man.wrap_around, large.wrap_around);
}

TEST(Trends, LessFrictionMeansLaterContactFurtherBack) {
  const SoloSummary smooth = impact("v2370", "[vehicle]\nfriction = 0.0\n");
  const SoloSummary usual = impact("v2370");
  const SoloSummary rough = impact("v2370", "[vehicle]\nfriction = 0.6\n");
  EXPECT_GT(smooth.head_contact, usual.head_contact);
  EXPECT_GT(usual.head_contact, rough.head_contact);
  EXPECT_GT(smooth.wrap_around, usual.wrap_around);
  EXPECT_GT(usual.wrap_around, rough.wrap_around);
}

TEST(Trends, HeadSpeedIsNearLinearInCarSpeed) {
  double sum_vv = 0, sum_vh = 0;
  std::vector<std::pair<double, double>> points;
  for (const int speed : {30, 40, 50, 60}) {
    const SoloSummary s =
        impact("v2370", "[vehicle]\nspeed_km_h = " + std::to_string(speed) + ".0\n", 8.0 / speed);
    points.emplace_back(s.car_speed, s.head_speed);
    sum_vv += s.car_speed * s.car_speed;
    sum_vh += s.car_speed * s.head_speed;
  }
  for (const auto& [car, head] : points) EXPECT_NEAR(head, sum_vh / sum_vv * car, 0.12 * head);
}

TEST(Trends, StifferGlassRaisesThePeakAcceleration) {
  const auto with_glass = [](double factor) {
    std::string forces;
    for (const double f : {0.0, 2.8, 4.0, 2.2, 2.0, 2.4, 3.2, 5.0, 9.0}) {
      forces += std::to_string(factor * f) + ", ";
    }
    return impact("v2370", "[vehicle.component.windshield]\nforce_y_kN = [" + forces + "]\n")
        .head_peak;
  };
  EXPECT_LT(with_glass(0.7), with_glass(1.0));
  EXPECT_LT(with_glass(1.0), with_glass(1.5));
}

// Searle's relation has a launch and a slide of friction mu: s between v^2 / (2 mu g) and
// (1 + mu^2) times that. A wrapped pedestrian is carried by the hood first, at nearly the launch
// speed, while the car brakes away beneath: until the car has fallen back by the way from the
// head's place on the glass to the nose, that is for sqrt(2 L / a). Upper bound: all that way at
// the car's speed, then the slide.
TEST(Throw, LiesBetweenSearlesSlideAndARideOnTheBrakingHood) {
  constexpr double kMu = 0.66, g = 9.81;                 // as docs/validation.md
  constexpr double kBraking = 0.7 * g, kOnTheCar = 1.5;  // m behind the nose
  for (const double speed_km_h : {25.0, 40.0}) {
    const double v = speed_km_h / 3.6, slide = v * v / (2 * kMu * g);
    const double ride = v * std::min(v / kBraking, std::sqrt(2 * kOnTheCar / kBraking));
    const SoloSummary s =
        impact("throw_40", "[vehicle]\nspeed_km_h = " + std::to_string(speed_km_h) + "\n", 3.0);
    EXPECT_GT(s.throw_distance, slide) << speed_km_h;
    EXPECT_LT(s.throw_distance, slide + ride) << speed_km_h;
    EXPECT_LT(s.rest_speed, 0.2) << speed_km_h;
    EXPECT_LT(s.energy_error, 0.01) << speed_km_h;
  }
}

}  // namespace
}  // namespace crosswalk::mb
