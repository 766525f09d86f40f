#include "common/spatial.h"

#include <cmath>

namespace crosswalk {

Mat3 skew(const Vec3& a) {
  Mat3 s;
  s << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return s;
}

Quat exp_rotation(const Vec3& rotation_vector) {
  const double angle = rotation_vector.norm();
  // sin(x/2)/x by its series near zero, where the quotient loses digits.
  const double half_sinc =
      angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  Quat q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = half_sinc * rotation_vector;
  return q;
}

Vec3 log_rotation(const Quat& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const Vec3 v = sign * q.vec();
  const double sine = v.norm();
  if (sine < 1e-9) return 2.0 * v;
  return 2.0 * std::atan2(sine, sign * q.w()) / sine * v;
}

Pose Pose::inverse() const {
  const Quat back = q.conjugate();
  return {back, -(back * p)};
}

Wrench& Wrench::operator+=(const Wrench& other) {
  f += other.f;
  tau += other.tau;
  return *this;
}

Vec6 stack(const Twist& V) { return (Vec6() << V.v, V.w).finished(); }
Vec6 stack(const Wrench& F) { return (Vec6() << F.f, F.tau).finished(); }
Twist twist_from(const Vec6& a) { return {a.head<3>(), a.tail<3>()}; }
Wrench wrench_from(const Vec6& a) { return {a.head<3>(), a.tail<3>()}; }

Inertia Inertia::of_point(double mass, const Vec3& position) {
  return {mass, position, Mat3::Zero()};
}

Mat3 Inertia::about(const Vec3& point) const {
  const Mat3 s = skew(com - point);
  return about_com - mass * s * s;
}

Inertia Inertia::operator+(const Inertia& other) const {
  Inertia sum;
  sum.mass = mass + other.mass;
  if (sum.mass <= 0) return sum;
  sum.com = (mass * com + other.mass * other.com) / sum.mass;
  sum.about_com = about(sum.com) + other.about(sum.com);
  return sum;
}

Inertia Inertia::in(const Pose& X_AB) const {
  const Mat3 R = X_AB.R();
  return {mass, X_AB * com, R * about_com * R.transpose()};
}

}  // namespace crosswalk
