// A stance from measured marker positions: pelvis pose and joint rotations that bring points of the
// body to where they were seen.
//
// Weighted least squares: each marker's distance over its sigma, each joint's turn from the given
// posture over kTurn (so that joints no marker speaks of stay), angles beyond the free range over
// kBeyond. KINSOL solves J^T r = 0 with the Gauss-Newton matrix J^T J and a line search.
#pragma once

#include <string>
#include <vector>

#include "common/body_description.h"
#include "common/config.h"
#include "common/spatial.h"

namespace crosswalk::mb {

struct Marker {
  std::string name, body;
  Vec3 offset = Vec3::Zero();    ///< m from the body's joint centre, axes of the erect posture
  Vec3 position = Vec3::Zero();  ///< m, W, where it was seen
  double sigma = 0;              ///< m
};

struct MarkerFit {
  Vec3 pelvis = Vec3::Zero();        ///< m, its centre of mass
  std::vector<Mat3> joint_rotation;  ///< of each segment, as in Posture
  std::vector<Vec3> miss;            ///< m, by marker: fitted less seen point, W
};

std::vector<Marker> read_markers(ConfigTable posture);

/// A marker further from its fitted point than this is refused [E].
inline constexpr double kUnmetMarker = 0.1;  ///< m
/// Throws UserError for a body that is not there, and for markers no posture can meet.
MarkerFit fit_markers(const BodyDescription& body, const std::vector<Marker>& markers,
                      const std::vector<Mat3>& start, const Vec3& pelvis);

}  // namespace crosswalk::mb
