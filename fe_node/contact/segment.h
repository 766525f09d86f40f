// Closest point of a facet to a node. A facet is a triangle or a quadrilateral; a quadrilateral is
// four triangles about its centre, so a warped one has no preferred diagonal. Pure functions.
#pragma once

#include <array>

#include "common/spatial.h"

namespace crosswalk::fe {

/// Corners in order; a triangle repeats its last corner.
using FacetCorners = std::array<Vec3, 4>;

struct Projection {
  std::array<double, 4> weight{};  ///< of the corners, sum to one: point = sum weight x
  Vec3 point = Vec3::Zero();       ///< closest point of the facet
  Vec3 normal = Vec3::Zero();      ///< unit normal of the (sub-)triangle it lies on
  double distance = 0;             ///< >= 0
  int sector = 0;                  ///< sub-triangle: corners sector, sector + 1 and the centre
};

Projection closest_point(const Vec3& p, const FacetCorners& x, bool is_triangle);

/// What the distance of a facet is at least and at most, m: from the mean of its corners, which
/// lies on it, and the sphere about that mean which holds it.
struct DistanceBounds {
  double least = 0, most = 0;
};
DistanceBounds distance_bounds(const Vec3& p, const FacetCorners& x);

/// Gradients of the corner weights in the plane of the sub-triangle, 1/m: they sum to zero, and
/// sum x_i (gradient_i . q) = q for every q in that plane.
std::array<Vec3, 4> weight_gradients(const FacetCorners& x, bool is_triangle, int sector);

}  // namespace crosswalk::fe
