// The rigid motion nearest to that of a set of weighted points (skull nodes) in the least-squares
// sense, about their weighted centre, in one frame.
//
// Pose: Horn's unit quaternion [horn1987], proper for flat sets too. Rates: with r = x - c and J =
// sum m (r.r 1 - r r^T), omega = J^-1 sum m r x (v - v_c) and alpha = J^-1 sum m r x (a - a_c -
// omega x (omega x r)).
#pragma once

#include <span>

#include "common/spatial.h"

namespace crosswalk {

Vec3 weighted_mean(std::span<const Vec3> x, std::span<const double> weight);
/// X with present ~ X * reference.
Pose fit_pose(std::span<const Vec3> reference, std::span<const Vec3> present,
              std::span<const double> weight);
/// Weighted root mean square distance (m) that X leaves; above 1 mm a skull is not rigid.
double fit_residual(std::span<const Vec3> reference, std::span<const Vec3> present,
                    std::span<const double> weight, const Pose& X);
/// Twist at the point `about` nearest to the velocities v of points at x. Fewer than three points
/// off a line leave the turning about the line at zero.
Twist fit_twist(std::span<const Vec3> x, std::span<const Vec3> v, std::span<const double> weight,
                const Vec3& about);
/// Angular acceleration (rad/s2) nearest to the accelerations a of points at x that turn at omega.
Vec3 fit_angular_acceleration(std::span<const Vec3> x, std::span<const Vec3> a,
                              std::span<const double> weight, const Vec3& omega);

}  // namespace crosswalk
