// All restraints of one substep: joints, bones, scapulae on the rib cage, bound wrists; and the
// books of their work.
//
// Elastic moments (springs, stops, bones, ligaments) store energy or lose it by hysteresis, both
// known from the angles and their history alone. Damping, friction and the two-joint passive
// moments are booked as moment times motion.
#pragma once

#include "mb_node/loads.h"
#include "mb_node/model.h"

namespace crosswalk::mb {

class JointLoads {
 public:
  explicit JointLoads(const MbModel& model);
  /// Adds the restraints' loads; deepens the histories and books their hysteresis.
  void apply(const Kinematics& now, MbState& state, std::vector<Wrench>& loads);
  /// Books damping, friction and passive moments of the substep that followed.
  void book(const Kinematics& before, const Kinematics& after, double dt, MbState& state) const;
  double stored_energy(const Kinematics& now, const MbState& state) const;

 private:
  /// Generalised moments of a joint on its child segment, by kind.
  struct Turn {
    int segment = -1;
    Vec3 damping = Vec3::Zero(), friction = Vec3::Zero(), passive = Vec3::Zero();
    double weakening = 0;  ///< N m: stored in the knee ligament, per rad of flexion that weakens it
  };
  /// A viscous force at a point of `first`, its reaction on `second`.
  struct Drag {
    int first = -1, second = -1;
    Vec3 point = Vec3::Zero(), force = Vec3::Zero();
  };
  /// The lateral slider of the knee.
  struct Shear {
    Vec3 axis, joint;
    double displacement = 0;
  };
  void turn(int segment, const Vec3& moments, std::vector<Wrench>& loads) const;
  void restrain(int segment, MbState& state, std::vector<Wrench>& loads);
  void restrain_bone(int segment, MbState& state, std::vector<Wrench>& loads);
  void restrain_shear(const Kinematics& now, int segment, std::vector<Wrench>& loads);
  void bushings(const Kinematics& now, std::vector<Wrench>& loads);
  void ties(const Kinematics& now, std::vector<Wrench>& loads);
  double passive_moment(int segment, PassiveMoment kind) const;
  Shear shear_of(const Kinematics& now, int segment) const;

  const MbModel& model_;
  std::vector<JointMotion> motions_;
  std::vector<Turn> turns_;
  std::vector<Drag> drags_;
};

}  // namespace crosswalk::mb
