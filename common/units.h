// Constants, dimensions and unit suffixes at the edges; inside, everything is SI.
//
// A quantity's key in a scenario file ends in its unit: `standing_height_mm`, `speed_km_h`. An
// underscore reads "per" in speeds, accelerations and densities (`_m_s`, `_m_s2`, `_kg_m3`),
// "times" in moments (`_N_m`); stiffness and damping say `_per_` (`_kN_per_m`), so that none reads
// two ways.
#pragma once

#include <numbers>
#include <span>
#include <string>
#include <string_view>

namespace crosswalk {

inline constexpr double kPi = std::numbers::pi;
/// Standard gravity [ISO 80000-3], m/s2.
inline constexpr double kStandardGravity = 9.80665;
inline constexpr double kDegree = kPi / 180.0;  ///< rad per degree
inline constexpr double kMilli = 1e-3;

enum class Dimension {
  None,
  Length,
  Mass,
  Time,
  Angle,
  Speed,
  Acceleration,
  AngularSpeed,
  Force,
  Moment,
  Stress,
  Density,
  Stiffness,
  AngularStiffness,
  Damping,
  AngularDamping,
  Inertia,
  Frequency,
  Energy,
  Temperature
};
inline constexpr int kDimensionCount = static_cast<int>(Dimension::Temperature) + 1;

/// SI value = factor * written value + offset.
struct Unit {
  std::string_view suffix;  ///< of the key, without the leading underscore
  std::string_view symbol;  ///< as printed in messages
  double factor;
  double offset = 0;
};

/// The accepted units, the SI one first; empty for Dimension::None.
std::span<const Unit> units_of(Dimension dimension);
/// With its article: "a length", "an angle".
std::string_view dimension_name(Dimension dimension);
/// "_m, _cm or _mm".
std::string suffix_list(Dimension dimension);

}  // namespace crosswalk
