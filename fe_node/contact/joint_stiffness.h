// Springs, dampers, friction and stops between two rigid bodies, measured in two triads fixed in
// them (*CONSTRAINED_JOINT_STIFFNESS [lstc2014]).
//
// Rotational: q is the rotation vector of B's triad in A's (rad), so q' = J^-1(q) w with w the
// relative angular velocity in B's triad and J the right Jacobian of the exponential map; the
// moment on B is -J^-T(q) m, m_i = dV/dq_i + damping(q_i') + friction_i. About one axis, and for
// small rotations, this is the angle about that axis in every convention; about several axes at
// once it has a potential V for any curves, which moments over Cardan angles or over increments
// lack. |q| stays below pi.
// Translational: q is the place of B's origin from A's origin in B's triad (m). Both bodies take
// their force at A's origin.
// Either way forces and moments on A and B are opposite and act at one place: momenta are kept to
// round-off. Friction is a spring that yields at its limit; a stop is a spring beyond its angle.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <string>

#include "common/curve.h"
#include "fe_node/contact/contact.h"
#include "fe_node/contact/joint.h"

namespace crosswalk::fe {

/// Along one axis of the triad: N m over rad, or N over m.
struct JointStiffnessAxis {
  Curve load;     ///< over q, holds back when positive; may be empty
  Curve damping;  ///< over q'; may be empty
  double friction_stiffness = 0, friction_limit = 0;  ///< limit 0: no friction
  double stop_low = -std::numeric_limits<double>::infinity();
  double stop_high = std::numeric_limits<double>::infinity();
  double stop_stiffness = 0;
  // A stiffness of 0 means kStopScale m*/dt^2, m* = 1 / (w_a + w_b) as in joint.h.
};

struct JointStiffnessSpec {
  std::string name;
  int body_a = 0, body_b = 0;  ///< indices into Model::bodies
  int reference_body = 0;      ///< of the two, one whose own axes at the start are the deck's
  Vec3 reference_origin = Vec3::Zero();  ///< of that body, deck frame; known after finish()
  bool is_translational = false;
  Mat3 axes_a = Mat3::Identity(), axes_b = Mat3::Identity();  ///< columns, deck frame
  Vec3 origin_a = Vec3::Zero(), origin_b = Vec3::Zero();      ///< deck frame, m
  std::array<JointStiffnessAxis, 3> axes;
};

inline constexpr double kStopScale = 0.1;  ///< of I*/dt^2, as of other penalties

/// `step` is the solver's own, s. The report's force is that on body_a (0 when rotational), its
/// stored energy the potential of springs and stops from q = 0.
std::unique_ptr<ContactInterface> make_joint_stiffness(JointStiffnessSpec spec, const JointBody& a,
                                                       const JointBody& b, double step);

}  // namespace crosswalk::fe
