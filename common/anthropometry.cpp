#include "common/anthropometry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace crosswalk {
namespace {

using A = Anthropometry;
using K = MeasureKind;

// Last two numbers: sex and age beyond stature and mass. Women: ratios of survey means, 1629 mm and
// 62.0 kg against 1756 mm and 78.5 kg [gordon1989, recalled and rounded]. Six years: head and
// sitting height of the child survey [snyder1977, rounded], 1170 mm and 23 kg. Measures without a
// number follow stature and mass alone.
constexpr std::array<Measure, 35> kMeasures = {{
    {1, "mass", K::Mass, &A::mass},
    {2, "standing_height", K::Length, &A::standing_height},
    {3, "shoulder_height", K::Length, &A::shoulder_height},
    {4, "armpit_height", K::Length, &A::armpit_height},
    {5, "waist_height", K::Length, &A::waist_height},
    {6, "seated_height", K::Length, &A::seated_height, 1, 1.04},
    {7, "head_length", K::Length, &A::head_length, 1.02, 1.42},
    {8, "head_breadth", K::Length, &A::head_breadth, 1.03, 1.35},
    {9, "head_to_chin_height", K::Length, &A::head_to_chin_height, 1.01, 1.285},
    {10, "neck_circumference", K::Girth, &A::neck_circumference, 0.9},
    {11, "shoulder_breadth", K::Length, &A::shoulder_breadth, 0.985},
    {12, "chest_depth", K::Girth, &A::chest_depth, 1.07},
    {13, "chest_breadth", K::Girth, &A::chest_breadth, 0.95},
    {14, "waist_depth", K::Girth, &A::waist_depth},
    {15, "waist_breadth", K::Girth, &A::waist_breadth},
    {16, "buttock_depth", K::Girth, &A::buttock_depth},
    {17, "hip_breadth_standing", K::Girth, &A::hip_breadth_standing, 1.085},
    {18, "shoulder_to_elbow_length", K::Length, &A::shoulder_to_elbow_length, 0.98},
    {19, "forearm_hand_length", K::Length, &A::forearm_hand_length, 0.985},
    {20, "biceps_circumference", K::Girth, &A::biceps_circumference, 0.9},
    {21, "elbow_circumference", K::Girth, &A::elbow_circumference},
    {22, "forearm_circumference", K::Girth, &A::forearm_circumference},
    {23, "wrist_circumference", K::Girth, &A::wrist_circumference, 0.94},
    {24, "knee_height_seated", K::Length, &A::knee_height_seated},
    {25, "thigh_circumference", K::Girth, &A::thigh_circumference, 1.05},
    {26, "upper_leg_circumference", K::Girth, &A::upper_leg_circumference},
    {27, "knee_circumference", K::Girth, &A::knee_circumference},
    {28, "calf_circumference", K::Girth, &A::calf_circumference, 1.02},
    {29, "ankle_circumference", K::Girth, &A::ankle_circumference},
    {30, "ankle_height_outside", K::Length, &A::ankle_height_outside},
    {31, "foot_breadth", K::Length, &A::foot_breadth, 0.96},
    {32, "foot_length", K::Length, &A::foot_length, 0.975},
    {33, "hand_breadth", K::Length, &A::hand_breadth, 0.945},
    {34, "hand_length", K::Length, &A::hand_length},
    {35, "hand_depth", K::Length, &A::hand_depth},
}};

constexpr Range kMassRange{8, 300};        // kg, infant to heaviest adult
constexpr Range kStatureRange{0.6, 2.4};   // m
constexpr double kChild = 6, kAdult = 18;  // years
constexpr double kImplausible = 0.45;      // relative distance from the predicted measure [E]
// Heights keep close to stature: a six-year-old's seated height is 4 % more of it than an adult's,
// an infant's 25 % [E].
constexpr double kImplausibleHeight = 0.30;

Dimension dimension(const Measure& measure) {
  return measure.kind == K::Mass ? Dimension::Mass : Dimension::Length;
}

/// Shoulder to seated height, and the seated knee: shares of stature.
bool is_height(const Measure& measure) {
  return (measure.number >= 3 && measure.number <= 6) || measure.number == 24;
}

std::string doc(const Measure& measure) {
  return fmt::format("measure {} of [yu2020, Table 2]{}", measure.number,
                     measure.number <= 2 ? "" : "; from stature, mass, sex and age when absent");
}

void check_order(ConfigTable& table, const Anthropometry& a) {
  struct Rule {
    double low, high;
    std::string_view low_name, high_name;
  };
  const std::array<Rule, 7> rules = {{
      {a.ankle_height_outside, a.knee_height_seated, "ankle_height_outside", "knee_height_seated"},
      {a.knee_height_seated, a.waist_height, "knee_height_seated", "waist_height"},
      {a.waist_height, a.armpit_height, "waist_height", "armpit_height"},
      {a.armpit_height, a.shoulder_height, "armpit_height", "shoulder_height"},
      {a.shoulder_height, a.standing_height, "shoulder_height", "standing_height"},
      {a.seated_height, a.standing_height, "seated_height", "standing_height"},
      {a.hand_length, a.forearm_hand_length, "hand_length", "forearm_hand_length"},
  }};
  for (const Rule& rule : rules) {
    if (rule.low < rule.high) continue;
    table.problem(rule.low_name,
                  fmt::format("less than {} ({:.1f} mm)", rule.high_name, 1e3 * rule.high),
                  fmt::format("{:.1f} mm", 1e3 * rule.low),
                  fmt::format("{:.1f} mm too much", 1e3 * (rule.low - rule.high)));
  }
}

}  // namespace

std::span<const Measure> anthropometry_measures() { return kMeasures; }

double predicted_measure(const Measure& measure, const Anthropometry& reference,
                         const Person& person) {
  if (measure.kind == K::Mass) return person.mass;
  const double stature_ratio = person.standing_height / reference.standing_height;
  const double scale = measure.kind == K::Length
                           ? stature_ratio
                           : std::sqrt(person.mass / reference.mass / stature_ratio);
  const double grown = std::clamp((person.age - kChild) / (kAdult - kChild), 0.0, 1.0);
  const double woman = person.sex == Sex::Female ? measure.woman : 1;
  return reference.*measure.value * scale * (grown * woman + (1 - grown) * measure.six_years);
}

Anthropometry read_complete_anthropometry(ConfigTable table) {
  Anthropometry a;
  for (const Measure& measure : kMeasures) {
    a.*measure.value = table.quantity(measure.name, dimension(measure), kPositive, doc(measure));
  }
  return a;
}

Anthropometry read_anthropometry(ConfigTable subject, const Anthropometry& reference) {
  Anthropometry a;
  a.mass = subject.quantity("mass", Dimension::Mass, kMassRange, doc(kMeasures[0]));
  a.standing_height =
      subject.quantity("standing_height", Dimension::Length, kStatureRange, doc(kMeasures[1]));
  // What is refused is replaced, so that the rest of the document is still read.
  if (!(a.mass > 0)) a.mass = reference.mass;
  if (!(a.standing_height > 0)) a.standing_height = reference.standing_height;
  const Person person{a.mass, a.standing_height,
                      subject.choice_or("sex", {"male", "female"}, "male",
                                        "proportions of measures that are not given") == "female"
                          ? Sex::Female
                          : Sex::Male,
                      static_cast<double>(subject.integer_or(
                          "age_years", 2, 110, 40, "the same; no effect beyond 18 years"))};
  for (const Measure& measure : kMeasures) {
    if (measure.number <= 2) continue;
    const double predicted = predicted_measure(measure, reference, person);
    const double given =
        subject.quantity_or(measure.name, dimension(measure), kPositive, predicted, doc(measure));
    a.*measure.value = given > 0 ? given : predicted;
    const double allowed = is_height(measure) ? kImplausibleHeight : kImplausible;
    if (std::abs(given / predicted - 1) > allowed) {
      subject.problem(
          measure.name,
          fmt::format("within {:.0f} % of {:.0f} mm, the value for this stature and mass",
                      100 * allowed, 1e3 * predicted),
          fmt::format("{:.1f} mm", 1e3 * given));
      a.*measure.value = predicted;
    }
  }
  check_order(subject, a);
  return a;
}

}  // namespace crosswalk
