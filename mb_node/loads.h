// Motion of all bodies and the forces on them in one substep.
#pragma once

#include <vector>

#include "common/spatial.h"

namespace crosswalk::mb {

/// Pose and twist of every body at its reference point.
struct Kinematics {
  std::vector<Mat3> R;
  std::vector<Vec3> p;
  std::vector<Twist> V;

  /// A point given from the reference point in body axes.
  Vec3 at(int body, const Vec3& p_B) const { return p[body] + R[body] * p_B; }
  /// Velocity of the body's point now at `point`.
  Vec3 velocity(int body, const Vec3& point) const { return V[body].shifted(point - p[body]).v; }
  void add_force(std::vector<Wrench>& loads, int body, const Vec3& force, const Vec3& point) const {
    loads[body] += Wrench{force, (point - p[body]).cross(force)};
  }
};

}  // namespace crosswalk::mb
