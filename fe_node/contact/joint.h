// Joints between two rigid bodies by penalty: points of one are held to points of the other by
// stiff springs with dampers. One point makes a spherical joint, two a revolute, three a locked
// one. Held only across an axis fixed in the first body (that of its first two points), two points
// make a cylindrical joint and three a translational one; held only along it, with the axis kept
// parallel, a planar one. One point with an arm of each body kept at right angles makes a
// universal joint (of Cardan or Hooke): the bodies turn freely about the two arms.
//
// Both forces of a point act at one place, so a joint has neither resultant nor moment and momenta
// are kept to round-off. Stiffness k = scale m*/dt^2 per point, m* = 1 / (w_a + w_b) with w = 1/M +
// r^2 / I_min the mobility of the point of a free body (none for a driven one); dampers take a
// share of critical damping. Lagrange multipliers would hold exactly, but need the solution of
// coupled equations in a step that has none; the gap left is F / k and is reported.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "fe_node/contact/contact.h"

namespace crosswalk::fe {

/// Which part of a gap between two points is held; the axis is that of the joint.
enum class JointHold { All, AcrossAxis, AlongAxis };

/// What couples keep of an axis of a and one of b.
enum class JointAxes {
  Free,
  Parallel,  ///< b's is parallel to a's when the run starts
  AtRightAngles
};

struct JointSpec {
  std::string name;
  int body_a = 0, body_b = 0;               ///< indices into Model::bodies
  std::vector<std::pair<int, int>> points;  ///< nodes of a and of b that stay together
  JointHold hold = JointHold::All;
  JointAxes axes = JointAxes::Free;
  std::pair<int, int> axis{-1, -1};    ///< two nodes of a, where `hold` or `axes` need one
  std::pair<int, int> axis_b{-1, -1};  ///< two nodes of b, for axes at right angles
  double stiffness_scale = 0.1;        ///< of m*/dt^2
  double damping_ratio = 0.1;          ///< of critical
};

/// What joints must know of a body, of Model::finish().
struct JointBody {
  double mass = 0;           ///< kg; 0: moved by something else
  double least_inertia = 0;  ///< kg m2, smallest principal
  Vec3 centre = Vec3::Zero();
  /// Of a point at this distance from the centre, 1/kg; of a spin, 1/(kg m2).
  double mobility(const Vec3& from_centre) const {
    return mass > 0 ? 1 / mass + from_centre.squaredNorm() / least_inertia : 0;
  }
  double spin_mobility() const { return mass > 0 ? 1 / least_inertia : 0; }
};

/// `step` is the solver's own, s; `points` the undeformed positions of nodes. The report's force is
/// that on body_a, its max_penetration the largest gap.
std::unique_ptr<ContactInterface> make_joint(JointSpec spec, const JointBody& a, const JointBody& b,
                                             std::span<const Vec3> points, double step);

}  // namespace crosswalk::fe
