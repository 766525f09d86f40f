// One node against one facet: forces in exact balance, slip, and the law of a touching pair.
#pragma once

#include <array>

#include "fe_node/contact/segment.h"
#include "fe_node/mesh/node_record.h"

namespace crosswalk::fe {

/// Geometry of a pair: x_node = point + distance * u.
struct PairFrame {
  std::array<double, 4> weight{};
  std::array<Vec3, 4> lever{};   ///< gradients of the weights, skewed so that forces stay along u
  Vec3 u = Vec3::Zero();         ///< unit, from the facet to the node
  double distance = 0;           ///< m, negative behind the facet
  bool carries_friction = true;  ///< false where u lies almost in the facet's plane
};

PairFrame pair_frame(const FacetCorners& x, bool is_triangle, const Projection& projection,
                     const Vec3& u, double distance);

struct PairForces {
  Vec3 on_node = Vec3::Zero();
  std::array<Vec3, 4> on_corner{};
};

/// `force` on the node and the balancing forces on the corners: neither resultant nor moment.
PairForces balanced_forces(const PairFrame& frame, const Vec3& force);

/// Velocity of the node against the facet's material carried out to it, work-conjugate to the
/// forces above.
Vec3 relative_velocity(const PairFrame& frame, const Vec3& node_velocity,
                       const std::array<Vec3, 4>& corner_velocity);

struct PairLaw {
  double stiffness = 0;  ///< N/m, normal and tangential
  double damping = 0;    ///< N s/m
  double static_friction = 0, dynamic_friction = 0, friction_decay = 0;
};

struct PairAnswer {
  Vec3 force = Vec3::Zero();     ///< on the node
  Vec3 friction = Vec3::Zero();  ///< its tangential part, to be handed in at the next step
  double stored = 0;             ///< J
  double friction_dissipated = 0, damping_dissipated = 0;  ///< J, this step
};

/// `friction` is that of the last step.
PairAnswer touch(const PairLaw& law, const PairFrame& frame, double penetration,
                 const Vec3& velocity, const Vec3& friction, double dt);

}  // namespace crosswalk::fe
