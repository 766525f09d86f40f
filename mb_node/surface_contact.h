// Where an ellipsoid meets a plane, a cylinder, a car front or another ellipsoid, and how deep.
//
// An ellipsoid x^T A^-1 x = 1 (A = R diag(a^2) R^T) has the support height h(n) = sqrt(n^T A n).
// With n pointing from the other surface towards the ellipsoid, the overlap along n is
//   g(n) = h(n) + (reach of the other surface along n) - (distance of the centres along n).
// The penetration is the smallest g over all admissible n: the shortest way out; g <= 0 for any n
// proves separation. The force acts at the deepest point of the ellipsoid, c - A n / h.
#pragma once

#include <optional>
#include <vector>

#include "common/spatial.h"
#include "common/vehicle_front.h"

namespace crosswalk::mb {

struct PosedEllipsoid {
  Vec3 centre = Vec3::Zero();
  Mat3 A = Mat3::Zero();
  PosedEllipsoid(const Vec3& p_W, const Mat3& R_WE, const Vec3& semi_axes);
};

struct Overlap {
  double depth = 0;            ///< m, > 0
  Vec3 normal = Vec3::Zero();  ///< from the other surface towards the (first) ellipsoid
  Vec3 point = Vec3::Zero();   ///< deepest point of the (first) ellipsoid
};

std::optional<Overlap> overlap_with_plane(const PosedEllipsoid& e, const Vec3& normal,
                                          const Vec3& on_plane);
/// Endless cylinder of unit axis `axis` through `on_axis`.
std::optional<Overlap> overlap_with_cylinder(const PosedEllipsoid& e, const Vec3& on_axis,
                                             const Vec3& axis, double radius);
std::optional<Overlap> overlap_with_ellipsoid(const PosedEllipsoid& first,
                                              const PosedEllipsoid& second);

/// A run of connected facets that bends only outwards: one contact at most.
struct FrontChain {
  std::vector<int> facets;     ///< indices into VehicleFront::facets, in order
  bool is_open_begin = false;  ///< a free end: the surface may also be left around it
  bool is_open_end = false;
};
std::vector<FrontChain> convex_chains(const VehicleFront& front);

struct FrontOverlap {
  Overlap overlap;
  int facet = -1;
};
/// Contact of an ellipsoid with one chain; `X_WF` is the pose of the front's frame
/// (contact_shapes.h).
std::optional<FrontOverlap> overlap_with_front(const PosedEllipsoid& e, const VehicleFront& front,
                                               const FrontChain& chain, const Pose& X_WF);

}  // namespace crosswalk::mb
