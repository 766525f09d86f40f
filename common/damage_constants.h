// Constants of DAMAGE, three damped oscillators for the lag of the brain in a turning head
// [gabler2019, Table 2]; unit masses, axes of the head: x forward, y right, z down.
#pragma once

#include <array>

namespace crosswalk::damage {

inline constexpr std::array<double, 3> kStiffness{32142, 23493, 16935};  ///< N/m about x, y, z
inline constexpr double kStiffnessXZ = 1636.3;                           ///< N/m; the others are 0
inline constexpr double kStiffnessDamping = 5.9148e-3;                   ///< s, C = a1 K
inline constexpr double kScale = 2.9903;                                 ///< 1/m

}  // namespace crosswalk::damage
