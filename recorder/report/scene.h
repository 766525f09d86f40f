// What is seen of a run: the shapes of its bodies and their poses over time. Plain data, filled
// from a log or a test, drawn by frames.h (still pictures) and by the page's 3-D view.
//
// Frame W: x subject's front, y car travel, z up; SI. Vehicle frame V: origin on the ground under
// the foremost bumper point, axes of W at the start; the profile lies in its (y, z) plane with
// y = -(distance behind the foremost point), extruded along x.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/spatial.h"

namespace crosswalk::recording {

struct SceneEllipsoid {
  int body = 0;  ///< index into Scene::bodies
  std::string name;
  Pose X_BE;  ///< origin at the centre, axes along the semi-axes
  Vec3 semi_axes = Vec3::Zero();
};

struct SceneMesh {
  std::vector<Vec3> vertices;  ///< m, head frame H (x forward, y left, z up) from the head COG
  std::vector<std::array<int, 3>> triangles;
};

/// One flat piece of the car front, (y, z) in V.
struct SceneFacet {
  std::string component;  ///< such as "hood"; a name with "wind" is drawn as glass
  Eigen::Vector2d begin = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  double half_width = 0;
};

struct SceneFrame {
  double t = 0;                  ///< s, zero at the first contact of car and pedestrian
  std::vector<Pose> X_WB;        ///< one per body
  std::optional<Pose> X_WH;      ///< the head surface, when there is one
  Pose X_WV;                     ///< the vehicle
  std::optional<double> strain;  ///< brain strain (MPS95) at this time, colours the head's read-out
};

struct Scene {
  std::vector<std::string> bodies;
  std::vector<SceneEllipsoid> ellipsoids;
  std::optional<SceneMesh> head;
  std::vector<SceneFacet> facets;
  std::vector<SceneFrame> frames;  ///< times strictly increase

  bool empty() const { return frames.empty() || (ellipsoids.empty() && !head); }
  /// The frame nearest in time; the scene must have frames.
  const SceneFrame& frame_at(double t) const;
};

}  // namespace crosswalk::recording
