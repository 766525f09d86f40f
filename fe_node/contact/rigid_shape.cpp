#include "fe_node/contact/rigid_shape.h"

#include <limits>

namespace crosswalk::fe {

Penetration penetration(const RigidPlane& plane, const Vec3& p) {
  return {-plane.normal.dot(p - plane.point), plane.normal};
}

Penetration penetration(const RigidFacet& facet, const Vec3& p) {
  const Vec3 r = p - facet.corner;
  const double s = facet.along.dot(r), t = facet.across.dot(r);
  const Vec3 normal = facet.normal();
  const double depth = -normal.dot(r);
  if (s < 0 || s > facet.length || t < 0 || t > facet.width || depth > facet.thickness)
    return {-std::numeric_limits<double>::infinity(), normal};
  return {depth, normal};
}

Penetration penetration(const RigidEllipsoid& ellipsoid, const Vec3& p) {
  const Vec3 local = ellipsoid.X_BE.inverse() * p;
  const Vec3 unit = local.cwiseQuotient(ellipsoid.semi_axes);
  const double g = unit.norm();
  if (g < 1e-9) return {ellipsoid.semi_axes.minCoeff(), ellipsoid.X_BE.q * Vec3::UnitZ()};
  const Vec3 gradient = unit.cwiseQuotient(ellipsoid.semi_axes) / g;
  const double slope = gradient.norm();
  return {(1 - g) / slope, ellipsoid.X_BE.q * Vec3(gradient / slope)};
}

Penetration penetration(const RigidCylinder& cylinder, const Vec3& p) {
  const Vec3 r = p - cylinder.point;
  const Vec3 radial = r - cylinder.axis.dot(r) * cylinder.axis;
  const double distance = radial.norm();
  if (distance < 1e-12) return {cylinder.radius, cylinder.axis.unitOrthogonal()};
  return {cylinder.radius - distance, radial / distance};
}

}  // namespace crosswalk::fe
