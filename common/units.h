// Constants and factors at the edges; inside, everything is SI.
#pragma once

#include <numbers>

namespace crosswalk {

inline constexpr double kPi = std::numbers::pi;
/// Standard gravity [ISO 80000-3], m/s2.
inline constexpr double kStandardGravity = 9.80665;
inline constexpr double kDegree = kPi / 180.0;  ///< rad per degree
inline constexpr double kMilli = 1e-3;

}  // namespace crosswalk
