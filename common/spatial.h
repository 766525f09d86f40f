// Spatial algebra with monogram names: p_WB is the position of B measured in W, R_WB the rotation
// with v_W = R_WB v_B, X_WB the pose of frame B in W, V_WB the twist of B in W (expressed in W),
// F_Bo_W a wrench about the point Bo expressed in W. SI units, right-handed frames.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace crosswalk {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// The matrix of the cross product: skew(a) * b == a.cross(b).
Mat3 skew(const Vec3& a);
/// Rotation vector (axis times angle, rad) to quaternion, and back with |angle| <= pi.
Quat exp_rotation(const Vec3& rotation_vector);
Vec3 log_rotation(const Quat& q);

/// X_AB: maps B coordinates into A: p_AQ = X_AB * p_BQ.
struct Pose {
  Quat q = Quat::Identity();  ///< unit
  Vec3 p = Vec3::Zero();      ///< m
  Mat3 R() const { return q.toRotationMatrix(); }
  Vec3 operator*(const Vec3& p_BQ) const { return q * p_BQ + p; }
  Pose operator*(const Pose& X_BC) const { return {q * X_BC.q, q * X_BC.p + p}; }
  Pose inverse() const;
};

/// Velocity of a frame whose origin is the stated point.
struct Twist {
  Vec3 v = Vec3::Zero();  ///< m/s, of the reference point
  Vec3 w = Vec3::Zero();  ///< rad/s
  /// The twist of the same rigid body seen at a point offset by p_PQ from the present one.
  Twist shifted(const Vec3& p_PQ) const { return {v + w.cross(p_PQ), w}; }
};

/// Force and the moment about the stated point.
struct Wrench {
  Vec3 f = Vec3::Zero();    ///< N
  Vec3 tau = Vec3::Zero();  ///< N m
  /// The same load with its moment taken about a point offset by p_PQ from the present one.
  Wrench shifted(const Vec3& p_PQ) const { return {f, tau - p_PQ.cross(f)}; }
  double power(const Twist& V) const { return f.dot(V.v) + tau.dot(V.w); }
  Wrench& operator+=(const Wrench& other);
};

/// Stacked as (linear, angular), the order of every 6-vector and 6x6 block in Crosswalk.
Vec6 stack(const Twist& V);
Vec6 stack(const Wrench& F);
Twist twist_from(const Vec6& a);
Wrench wrench_from(const Vec6& a);

/// Mass, centre of mass and rotational inertia about that centre, all in one named frame.
struct Inertia {
  double mass = 0;                ///< kg
  Vec3 com = Vec3::Zero();        ///< m
  Mat3 about_com = Mat3::Zero();  ///< kg m2
  Inertia operator+(const Inertia& other) const;
  /// Rotational inertia about another point of the same frame.
  Mat3 about(const Vec3& point) const;
  /// Re-expressed: this is given in B, the result in A.
  Inertia in(const Pose& X_AB) const;
  static Inertia of_point(double mass, const Vec3& position);
};

}  // namespace crosswalk
