#include "common/anthropometry.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/body_scaling.h"
#include "common/units.h"
#include "tests/common/subject_fixture.h"

namespace crosswalk {
namespace {

TEST(Anthropometry, HoldsAll35MeasuresOnce) {
  EXPECT_EQ(anthropometry_measures().size(), 35u);
  for (std::size_t i = 0; i < 35; ++i) {
    EXPECT_EQ(anthropometry_measures()[i].number, static_cast<int>(i) + 1);
  }
}

TEST(Anthropometry, FillsMissingMeasuresFromStatureAndMass) {
  const Anthropometry male = load_subject("male_50").measures;
  EXPECT_DOUBLE_EQ(male.knee_height_seated, 0.552);  // the reference itself
  const Anthropometry tall =
      load_subject("male_50", "standing_height_mm = 1914\nmass_kg = 83.27\n").measures;
  EXPECT_NEAR(tall.knee_height_seated, 1.1 * 0.552, 1e-12);
  EXPECT_NEAR(tall.thigh_circumference, 0.540, 1e-12);  // mass per stature unchanged
}

TEST(Anthropometry, SexAndAgeShiftTheProportionsOfWhatIsMissing) {
  const std::string size = "standing_height_mm = 1740\nmass_kg = 75.7\n";
  const Anthropometry man = load_subject("male_50", size).measures;
  const Anthropometry woman = load_subject("male_50", size + "sex = \"female\"\n").measures;
  EXPECT_NEAR(woman.hip_breadth_standing / man.hip_breadth_standing, 1.085, 1e-12);
  EXPECT_NEAR(woman.neck_circumference / man.neck_circumference, 0.90, 1e-12);
  EXPECT_EQ(woman.knee_height_seated, man.knee_height_seated);
  const auto head_at = [](int years) {
    return load_subject("male_50", "standing_height_mm = 1170\nmass_kg = 23.0\nage_years = " +
                                       std::to_string(years) + "\n")
        .measures.head_length;
  };
  EXPECT_NEAR(head_at(6), 0.181, 1e-3);  // [snyder1977]
  EXPECT_NEAR(head_at(12), (head_at(6) + head_at(18)) / 2, 1e-12);
  EXPECT_EQ(head_at(30), head_at(18));
}

TEST(Anthropometry, RefusesContradictionsWithTheMeasureAndTheAmount) {
  try {
    load_subject("v2370", "knee_height_seated_mm = 1200.0\nhead_length_mm = 20.0\n");
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("subject.knee_height_seated"));
    EXPECT_THAT(error.what(), testing::HasSubstr("1200.0 mm"));
    EXPECT_THAT(error.what(), testing::HasSubstr("subject.head_length"));
  }
  EXPECT_THROW(load_subject("v2370", "foot_length_mm = -3.0\n"), UserError);
}

std::string refusal(const std::string& subject, const std::string& more) {
  try {
    load_subject(subject, more);
  } catch (const UserError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Anthropometry, RefusesASeatedHeightThatLeavesNoLegs) {
  const std::string text = refusal("male_50", "seated_height_mm = 1300\n");
  EXPECT_THAT(text, testing::HasSubstr("subject.seated_height"));
  EXPECT_THAT(text, testing::HasSubstr("1300.0 mm"));
}

TEST(Anthropometry, RefusesEveryNegativeMeasureByName) {
  for (const Measure& m : anthropometry_measures()) {
    const std::string name(m.name), unit = m.kind == MeasureKind::Mass ? "_kg" : "_mm";
    EXPECT_THAT(refusal("male_50", name + unit + " = -500\n"), testing::HasSubstr(name)) << name;
    EXPECT_THAT(refusal("male_50", name + unit + " = 0\n"), testing::HasSubstr(name)) << name;
  }
}

TEST(Anthropometry, RefusesAHeightThatTheOthersContradict) {
  // All within 30 % of what stature predicts, but no person's: the others leave it no room.
  struct Case {
    const char* measure;
    double mm;
    const char* direction;
  };
  for (const Case& c :
       {Case{"knee_height_seated", 700, "much"}, Case{"knee_height_seated", 430, "little"},
        Case{"seated_height", 1080, "much"}, Case{"waist_height", 950, "little"},
        Case{"armpit_height", 1290, "little"}}) {
    const std::string name(c.measure);
    const std::string text = refusal("v2370", name + "_mm = " + std::to_string(c.mm) + "\n");
    EXPECT_THAT(text, testing::HasSubstr("subject." + name));
    EXPECT_THAT(text, testing::HasSubstr(std::string("mm too ") + c.direction)) << name;
    EXPECT_THAT(text, testing::HasSubstr("standard deviations")) << name;
  }
}

TEST(Anthropometry, AContradictionIsTheDistanceFromWhatTheOthersSay) {
  // The knee has two equations: 0.285 H with 25 mm, measured with 8 mm.
  Anthropometry a = load_subject("male_50").measures;
  a.knee_height_seated = 0.285 * a.standing_height + a.knee_circumference / (2 * kPi) + 0.1;
  for (const HeightContradiction& c : height_contradictions(a)) {
    if (c.measure != "knee_height_seated") continue;
    EXPECT_NEAR(c.excess, 0.1, 1e-9);
    EXPECT_NEAR(c.sigmas, 100 / std::hypot(25, 8), 1e-9);
  }
}

TEST(Anthropometry, PublishedSubjectsAreFarFromContradiction) {
  for (const char* subject :
       {"v2370", "v2371", "v2374", "male_50", "male_95", "female_05", "child_6"}) {
    const std::vector<HeightContradiction> all =
        height_contradictions(load_subject(subject).measures);
    EXPECT_EQ(all.size(), 6u);
    for (const HeightContradiction& c : all) {
      EXPECT_LT(c.sigmas, 2) << subject << " " << c.measure;
    }
  }
}

// Heights in mm from an independent computation of the same 16 equations.
struct HeightCase {
  const char* subject;
  double ankle, knee, hip, L5S1, waist, C7T1, SJC, OC;
};

class ReconciledHeights : public testing::TestWithParam<HeightCase> {};

TEST_P(ReconciledHeights, SolveTheWeightedEquations) {
  const HeightCase& c = GetParam();
  const BodyDescription body = load_subject(c.subject);
  const JointHeights z = solve_heights(body.measures);
  constexpr double kPrinted = 0.051e-3;  // the last digit of the table
  EXPECT_NEAR(z.ankle, 1e-3 * c.ankle, kPrinted);
  EXPECT_NEAR(z.knee, 1e-3 * c.knee, kPrinted);
  EXPECT_NEAR(z.hip, 1e-3 * c.hip, kPrinted);
  EXPECT_NEAR(z.L5S1, 1e-3 * c.L5S1, kPrinted);
  EXPECT_NEAR(z.waist, 1e-3 * c.waist, kPrinted);
  EXPECT_NEAR(z.C7T1, 1e-3 * c.C7T1, kPrinted);
  EXPECT_NEAR(z.SJC, 1e-3 * c.SJC, kPrinted);
  EXPECT_NEAR(z.OC, 1e-3 * c.OC, kPrinted);
  for (const HeightResidual& row : z.residuals) {
    EXPECT_LT(std::abs(row.residual), 1.2 * row.sigma) << row.equation;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Subjects, ReconciledHeights,
    testing::Values(
        HeightCase{"male_50", 74.9, 492.6, 910.0, 996.1, 1059.2, 1486.4, 1423.7, 1599.2},
        HeightCase{"v2370", 74.3, 527.8, 937.2, 1026.2, 1093.3, 1533.7, 1468.9, 1661.6},
        HeightCase{"v2371", 74.6, 511.7, 954.4, 1047.2, 1120.7, 1600.7, 1535.9, 1717.4},
        HeightCase{"v2374", 72.1, 503.9, 916.5, 1004.7, 1072.9, 1527.6, 1464.3, 1634.1}),
    [](const auto& test) { return std::string(test.param.subject); });

}  // namespace
}  // namespace crosswalk
