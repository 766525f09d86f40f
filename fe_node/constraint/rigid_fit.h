// The rigid motion nearest to that of a set of points in the least-squares sense.
#pragma once

#include <span>

#include "common/spatial.h"

namespace crosswalk::fe {

/// X with present ~ X * reference, by Horn's quaternion method [horn1987].
Pose fit_pose(std::span<const Vec3> reference, std::span<const Vec3> present,
              std::span<const double> weight);
/// Twist at the point `about` nearest to the velocities v of points at x. Fewer than three points
/// off a line leave the turning about the line at zero.
Twist fit_twist(std::span<const Vec3> x, std::span<const Vec3> v, std::span<const double> weight,
                const Vec3& about);

}  // namespace crosswalk::fe
