// The 35 body measures of [yu2020, Table 2] (the GEBOD list and three hand dimensions), SI.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "common/config.h"

namespace crosswalk {

struct Anthropometry {
  double mass = 0;
  double standing_height = 0, shoulder_height = 0, armpit_height = 0, waist_height = 0;
  double seated_height = 0, head_length = 0, head_breadth = 0, head_to_chin_height = 0;
  double neck_circumference = 0, shoulder_breadth = 0, chest_depth = 0, chest_breadth = 0;
  double waist_depth = 0, waist_breadth = 0, buttock_depth = 0, hip_breadth_standing = 0;
  double shoulder_to_elbow_length = 0, forearm_hand_length = 0, biceps_circumference = 0;
  double elbow_circumference = 0, forearm_circumference = 0, wrist_circumference = 0;
  double knee_height_seated = 0, thigh_circumference = 0, upper_leg_circumference = 0;
  double knee_circumference = 0, calf_circumference = 0, ankle_circumference = 0;
  double ankle_height_outside = 0, foot_breadth = 0, foot_length = 0, hand_breadth = 0;
  double hand_length = 0, hand_depth = 0;
};

enum class MeasureKind {
  Mass,
  Length,  ///< grows with stature
  Girth    ///< a breadth, depth or circumference: grows with sqrt(mass / stature)
};

struct Measure {
  int number = 0;         ///< row of [yu2020, Table 2]
  std::string_view name;  ///< scenario key without its unit
  MeasureKind kind = MeasureKind::Length;
  double Anthropometry::*value = nullptr;
  /// A woman's and a six-year-old's measure over the reference man's scaled to their stature and
  /// mass.
  double woman = 1, six_years = 1;
};

enum class Sex { Male, Female };

/// What missing measures are predicted from.
struct Person {
  double mass = 0, standing_height = 0;
  Sex sex = Sex::Male;
  double age = 40;  ///< years
};

/// All 35, in the order of the table.
std::span<const Measure> anthropometry_measures();

/// Reads the measures of `subject`. Mass and standing height are required; missing ones are
/// predicted. Contradicting measures (a chest deeper than it is wide twice over, a knee above the
/// hip, ...) are problems of the document.
Anthropometry read_anthropometry(ConfigTable subject, const Anthropometry& reference);
/// Reads all 35; none may miss.
Anthropometry read_complete_anthropometry(ConfigTable table);

/// The reference person's measure scaled by stature or by sqrt(mass / stature), times what sex and
/// age add to that; between 6 and 18 years the child's share fades out linearly and the woman's in.
double predicted_measure(const Measure& measure, const Anthropometry& reference,
                         const Person& person);

}  // namespace crosswalk
