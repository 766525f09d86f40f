// Restraint of joints: what moment answers an angle, its rate and its history. Pure functions with
// a small history struct; the engine's joints themselves are ideal.
//
//   M = -k0 (theta - theta_0) - stop(theta) - [passive - passive_0] - ligament - c theta'
//       - M_f tanh(theta' / 0.1 rad/s)
// Stops: k1 D + k2 D^2 at depth D; after the deepest D_m the moment follows
// M_m ((D - 0.3 D_m) / (0.7 D_m))^1.5 down and up again, which loses 20 to 37 % of the energy [E].
// Angles rad, moments N m on the child, energies J.
#pragma once

#include "common/body_description.h"
#include "common/spatial.h"

namespace crosswalk::mb {

/// Angles and rates of a joint, and the vectors d_i that turn generalised moments into the torque
/// T = sum M_i d_i on the child and the relative spin into rates theta_i' = d_i . w. Order alpha
/// (y), beta (x), gamma (z); unused coordinates are zero.
struct JointMotion {
  Vec3 angle = Vec3::Zero();
  Vec3 rate = Vec3::Zero();
  Mat3 dual = Mat3::Zero();  ///< columns d_i in W
};
JointMotion joint_motion(JointType type, const AngleFrame& frame, const Mat3& R_WP,
                         const Mat3& R_WC, const Vec3& w_relative);

struct StopHistory {
  double deepest = 0;  ///< rad
};
/// Moment at depth D > 0 (zero else); deepens the history.
double stop_moment(const StopLaw& law, double depth, StopHistory& history);
/// Lost for good once unloaded from a depth.
double stop_loss(const StopLaw& law, double deepest);
/// Energy that unloading from here would give back.
double stop_energy(const StopLaw& law, double depth, const StopHistory& history);

struct LigamentHistory {
  double deepest = 0;  ///< rad of either side
  bool is_torn = false;
};
/// Moment against a displacement from the initial angle, odd.
double ligament_moment(const LigamentLaw& law, double displacement, LigamentHistory& history);
double ligament_energy(const LigamentLaw& law, double displacement, const LigamentHistory& history);
/// Lost for good by a torn ligament; zero while it is whole.
double ligament_loss(const LigamentLaw& law, const LigamentHistory& history);
/// The variant that never tears: a constant slope from the last intact point on.
LigamentLaw without_failure(const LigamentLaw& law);

struct CoordinateHistory {
  StopHistory low, high;
  LigamentHistory ligament;
};

/// What the other joints contribute to one coordinate, evaluated by the caller.
struct CoordinateInput {
  double initial = 0;          ///< angle at the start
  double passive = 0;          ///< two-joint passive moment relative to its start value
  double ligament_factor = 1;  ///< weakening of the knee ligaments with flexion
};
/// One coordinate's moments on the child by kind, N m, and what its history lost by them.
struct RestraintMoment {
  double elastic = 0, damping = 0, friction = 0, passive = 0;
  double lost = 0;  ///< J, by hysteresis since the last moment asked for
  double total() const { return elastic + damping + friction + passive; }
};
RestraintMoment restraint_moment(const CoordinateLaw& law, const CoordinateInput& input,
                                 double angle, double rate, CoordinateHistory& history);
/// Stored by the spring about the initial angle, the stops and the ligament.
double restraint_energy(const CoordinateLaw& law, const CoordinateInput& input, double angle,
                        const CoordinateHistory& history);

struct BoneHistory {
  bool is_broken = false;
};
/// Generalised moments (alpha, beta, gamma) of a bone joint. `may_break`: the bone is still whole.
struct BoneMoment {
  Vec3 elastic = Vec3::Zero(), damping = Vec3::Zero(), friction = Vec3::Zero();
  double lost = 0;  ///< J, by breaking
  Vec3 total() const { return elastic + damping + friction; }
};
BoneMoment bone_moment(const BoneLaw& law, const Vec3& angle, const Vec3& rate, bool may_break,
                       BoneHistory& history);
double bone_energy(const BoneLaw& law, const Vec3& angle, const BoneHistory& history);

/// Passive moments of relaxed subjects in flexion sense, N m; angles in rad, flexion and
/// dorsiflexion positive, clamped to the measured range [riener1999].
double passive_hip(double hip_flexion, double knee_flexion);
double passive_knee(double hip_flexion, double knee_flexion, double ankle_dorsiflexion);
double passive_ankle(double knee_flexion, double ankle_dorsiflexion);

}  // namespace crosswalk::mb
