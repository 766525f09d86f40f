// The surfaces that multibody bodies show to the finite-element side, from the same scenario tables
// and by the same scaling on both sides, so that no geometry travels on the wire.
//
// Body frame B of an interface body: origin at its reference point (multibody centre of mass at t =
// 0, before block masses are added), axes parallel to W in the erect reference posture;
// BodyMotion::X_WB places it. Body `buck`: origin on the ground under the foremost bumper point,
// axes of W; its profile lies in the (y, z) plane, y = -(distance behind the foremost point),
// extruded along x. SI.
#pragma once

#include <string>
#include <vector>

#include "common/curve.h"
#include "common/spatial.h"

namespace crosswalk {

class ConfigTable;

/// Contact force against penetration of one side: loading curve, then unloading from (d_max, F_max)
/// along F = F_max ((d - d_p)/(d_max - d_p))^exponent with d_p = permanent_fraction * d_max.
struct Characteristic {
  Curve loading;  ///< m -> N
  double permanent_fraction = 0;
  double unloading_exponent = 1;
};

struct EllipsoidShape {
  std::string name;    ///< such as "shoulder_l"
  std::string region;  ///< names its characteristic, such as "shoulder"
  Pose X_BE;           ///< origin at the centre, axes along the semi-axes
  Vec3 semi_axes = Vec3::Zero();
  Characteristic flesh;
};

/// One flat facet of the car front, from `begin` to `end` (y, z) in the buck frame; `normal` (y, z)
/// points away from the car.
struct FrontFacet {
  std::string component;  ///< such as "hood"
  Eigen::Vector2d begin = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  double half_width = 0;  ///< along x, symmetric
  Characteristic structure;
};

struct BodyShapes {
  std::string body;
  std::vector<EllipsoidShape> ellipsoids;  ///< pedestrian bodies
  std::vector<FrontFacet> facets;          ///< the car
};

/// Shapes of the named bodies ("buck", "scapula_l", "upper_arm_r", ...), read from the [subject]
/// and [vehicle] tables of a scenario; an unknown body is a problem of the document.
std::vector<BodyShapes> read_contact_shapes(ConfigTable scenario,
                                            const std::vector<std::string>& bodies);

}  // namespace crosswalk
