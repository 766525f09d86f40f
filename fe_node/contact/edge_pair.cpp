#include "fe_node/contact/edge_pair.h"

#include <algorithm>
#include <cmath>

namespace crosswalk::fe {
namespace {

/// Places on both segments, 0..1.
std::array<double, 2> closest_places(const EdgeEnds& p, const EdgeEnds& q) {
  const Vec3 d1 = p[1] - p[0], d2 = q[1] - q[0], r = p[0] - q[0];
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r), c = d1.dot(r),
               b = d1.dot(d2), denominator = a * e - b * b;
  double s = 0;
  if (denominator > 1e-12 * a * e) s = std::clamp((b * f - c * e) / denominator, 0.0, 1.0);
  double t = (b * s + f) / e;
  if (t < 0) {
    t = 0;
    s = std::clamp(-c / a, 0.0, 1.0);
  } else if (t > 1) {
    t = 1;
    s = std::clamp((b - c) / a, 0.0, 1.0);
  }
  return {s, t};
}

}  // namespace

EdgePair closest_pair(const EdgeEnds& p, const EdgeEnds& q) {
  EdgePair pair;
  pair.along = closest_places(p, q);
  const auto& [s, t] = pair.along;
  const Vec3 way = p[0] + s * (p[1] - p[0]) - q[0] - t * (q[1] - q[0]);
  pair.distance = way.norm();
  if (pair.distance > 0) pair.u = way / pair.distance;
  pair.is_between = s > 0 && s < 1 && t > 0 && t < 1;
  const Vec3 e1 = (p[1] - p[0]).normalized(), e2 = (q[1] - q[0]).normalized();
  const double cosine = e1.dot(e2), sine2 = 1 - cosine * cosine;
  constexpr double kNearlyParallel = 0.04;  // sine squared: 11 degrees
  pair.carries_friction = pair.is_between && sine2 > kNearlyParallel;
  if (!pair.carries_friction) return pair;
  // reciprocal to e1 and e2 in their plane, which is across u
  pair.lever[0] = pair.distance / (p[1] - p[0]).norm() * (e1 - cosine * e2) / sine2;
  pair.lever[1] = pair.distance / (q[1] - q[0]).norm() * (e2 - cosine * e1) / sine2;
  return pair;
}

EdgeForces balanced_forces(const EdgePair& pair, const Vec3& force) {
  const auto& [s, t] = pair.along;
  const Vec3 first = pair.lever[0].dot(force) * pair.u, second = pair.lever[1].dot(force) * pair.u;
  return {{{(1 - s) * force - first, s * force + first},
           {-(1 - t) * force - second, -t * force + second}}};
}

Vec3 relative_velocity(const EdgePair& pair, const EdgeEnds& v_p, const EdgeEnds& v_q) {
  const auto& [s, t] = pair.along;
  return (1 - s) * v_p[0] + s * v_p[1] - (1 - t) * v_q[0] - t * v_q[1] +
         pair.u.dot(v_p[1] - v_p[0]) * pair.lever[0] + pair.u.dot(v_q[1] - v_q[0]) * pair.lever[1];
}

}  // namespace crosswalk::fe
