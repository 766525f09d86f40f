// Two line segments in contact: closest points, forces in exact balance, conjugate slip.
#pragma once

#include <array>

#include "common/spatial.h"

namespace crosswalk::fe {

/// Ends of a segment.
using EdgeEnds = std::array<Vec3, 2>;

struct EdgePair {
  std::array<double, 2> along{};  ///< 0..1 from the first end, on each segment
  Vec3 u = Vec3::Zero();          ///< unit, from the second segment's point to the first's
  double distance = 0;            ///< m, signed along u
  bool is_between = false;        ///< both points lie between the ends
  bool carries_friction = false;  ///< false where the segments are nearly parallel, or end to end
  std::array<Vec3, 2> lever{};    ///< of the couples of friction: d g_i / L_i
};

/// Nearest points of the two [ericson2005, 5.1.9]. u is undefined, and zero, when they coincide.
EdgePair closest_pair(const EdgeEnds& p, const EdgeEnds& q);

/// On the ends of the first and of the second segment.
using EdgeForces = std::array<std::array<Vec3, 2>, 2>;
/// `force` acts on the first segment.
EdgeForces balanced_forces(const EdgePair& pair, const Vec3& force);
/// Of the first against the second, work-conjugate to those forces.
Vec3 relative_velocity(const EdgePair& pair, const EdgeEnds& v_p, const EdgeEnds& v_q);

}  // namespace crosswalk::fe
