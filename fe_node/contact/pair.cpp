#include "fe_node/contact/pair.h"

#include <algorithm>
#include <cmath>

namespace crosswalk::fe {

PairFrame pair_frame(const FacetCorners& x, bool is_triangle, const Projection& projection,
                     const Vec3& u, double distance) {
  PairFrame frame;
  frame.weight = projection.weight;
  frame.u = u;
  frame.distance = distance;
  const double cosine = projection.normal.dot(u);
  frame.carries_friction = std::abs(cosine) > 0.2;
  if (!frame.carries_friction) {
    frame.lever.fill(Vec3::Zero());
    return frame;
  }
  frame.lever = weight_gradients(x, is_triangle, projection.sector);
  for (Vec3& g : frame.lever) g = distance * (g - g.dot(u) / cosine * projection.normal);
  return frame;
}

PairForces balanced_forces(const PairFrame& frame, const Vec3& force) {
  PairForces out;
  out.on_node = force;
  const Vec3 tangential = force - frame.u * frame.u.dot(force);
  for (int i = 0; i < 4; ++i)
    out.on_corner[i] = -frame.weight[i] * force + frame.lever[i].dot(tangential) * frame.u;
  return out;
}

Vec3 relative_velocity(const PairFrame& frame, const Vec3& node_velocity,
                       const std::array<Vec3, 4>& corner_velocity) {
  Vec3 v = node_velocity;
  Vec3 carried = Vec3::Zero();
  for (int i = 0; i < 4; ++i) {
    v -= frame.weight[i] * corner_velocity[i];
    carried += frame.lever[i] * frame.u.dot(corner_velocity[i]);
  }
  return v + carried - frame.u * frame.u.dot(carried);
}

PairAnswer touch(const PairLaw& law, const PairFrame& frame, double penetration,
                 const Vec3& velocity, const Vec3& friction, double dt) {
  PairAnswer out;
  const double closing = -frame.u.dot(velocity);
  const double elastic = law.stiffness * penetration;
  const double normal = std::max(0.0, elastic + law.damping * closing);
  out.force = normal * frame.u;
  out.stored = 0.5 * elastic * penetration;
  out.damping_dissipated = (normal - elastic) * closing * dt;

  if (law.static_friction <= 0 || !frame.carries_friction) return out;
  const Vec3 slip_rate = velocity + closing * frame.u;
  const double coefficient =
      law.dynamic_friction + (law.static_friction - law.dynamic_friction) *
                                 std::exp(-law.friction_decay * slip_rate.norm());
  // the old friction turns with the surface and keeps its size
  Vec3 before = friction - frame.u * frame.u.dot(friction);
  if (const double size = before.norm(); size > 0) before *= friction.norm() / size;
  Vec3 after = before - law.stiffness * dt * slip_rate;
  const double limit = coefficient * normal, size = after.norm();
  if (size > limit) after *= limit / size;
  const double taken = -0.5 * (before + after).dot(slip_rate) * dt;
  const double stored = 0.5 * after.squaredNorm() / law.stiffness;
  out.friction_dissipated = taken - (stored - 0.5 * before.squaredNorm() / law.stiffness);
  out.stored += stored;
  out.friction = after;
  out.force += after;
  return out;
}

}  // namespace crosswalk::fe
