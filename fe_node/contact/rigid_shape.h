// Analytic surfaces of rigid bodies: depth and outward normal of a point, in the body's frame. SI.
#pragma once

#include <variant>

#include "common/spatial.h"

namespace crosswalk::fe {

/// How far a point is inside (depth > 0) and the outward normal there. Outside, depth is minus the
/// distance, at least roughly; -infinity when the shape does not concern the point.
struct Penetration {
  double depth = 0;
  Vec3 normal = Vec3::UnitZ();
};

/// Half-space behind a plane.
struct RigidPlane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit, away from the material
};

/// A flat rectangle with material behind it down to `thickness`.
struct RigidFacet {
  Vec3 corner = Vec3::Zero();
  Vec3 along = Vec3::UnitX();   ///< unit; from the corner over `length`
  Vec3 across = Vec3::UnitY();  ///< unit, normal to `along`; over `width`
  double length = 0, width = 0;
  double thickness = 0.25;  ///< m; points deeper than this are on another side of the body
  Vec3 normal() const { return along.cross(across); }
};

struct RigidEllipsoid {
  Pose X_BE;
  Vec3 semi_axes = Vec3::Ones();
};

/// Infinite cylinder.
struct RigidCylinder {
  Vec3 point = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();  ///< unit
  double radius = 0;
};

using RigidShape = std::variant<RigidPlane, RigidFacet, RigidEllipsoid, RigidCylinder>;

Penetration penetration(const RigidPlane& plane, const Vec3& p);
Penetration penetration(const RigidFacet& facet, const Vec3& p);
/// First-order distance (1 - g) / |grad g| with g = |D^-1 p|: exact on the axes and for a sphere,
/// within depth^2 / radius elsewhere.
Penetration penetration(const RigidEllipsoid& ellipsoid, const Vec3& p);
Penetration penetration(const RigidCylinder& cylinder, const Vec3& p);

inline Penetration penetration(const RigidShape& shape, const Vec3& p) {
  return std::visit([&p](const auto& s) { return penetration(s, p); }, shape);
}

}  // namespace crosswalk::fe
