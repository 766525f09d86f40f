// One multibody substep as a visible list: restraints, contacts, interface loads, step, energy
// books.
#pragma once

#include <span>

#include "mb_node/model.h"

namespace crosswalk::mb {

/// Pose and twist of every body at its reference point.
struct Kinematics {
  std::vector<Mat3> R;
  std::vector<Vec3> p;
  std::vector<Twist> V;
};

/// Forces of one substep, per body about its reference point, by origin.
struct Loads {
  std::vector<Wrench> joint, contact, interface;
};

/// What the last substep's contacts were, for reports.
struct ContactReport {
  Vec3 car_total = Vec3::Zero();  ///< on the pedestrian
  std::vector<Vec3> car_component;
  Vec3 head_car = Vec3::Zero();
  Vec3 head_point = Vec3::Zero();  ///< where the head last touched the car, W
  Vec3 ground = Vec3::Zero();
  double self_total = 0;  ///< N, sum of magnitudes
  int contacts = 0;
  std::uint64_t contact_set = 0;  ///< hash of the pairs in touch
};

/// A constant load on a segment's reference point, or on the car (segment = kCar).
inline constexpr int kCar = -1;
struct ExternalLoad {
  int segment = 0;
  Wrench load;
};

/// Runs substeps of a model on an engine that holds the poses. One object per running world.
class Dynamics {
 public:
  Dynamics(const MbModel& model, OdeWorld& world);
  /// Re-reads the engine, after its state was set from outside.
  void refresh();
  void substep(MbState& state, double dt, std::span<const ExternalLoad> external);

  const Kinematics& kinematics() const { return now_; }
  const ContactReport& contacts() const { return report_; }
  double kinetic_energy() const { return world_.kinetic_energy(); }
  double gravity_energy() const;
  double joint_energy(const MbState& state) const;
  bool all_finite() const;

 private:
  void restrain_joints(MbState& state);
  double passive_moment(int segment, PassiveMoment kind) const;
  void restrain_bone(int segment, MbState& state);
  void bushings_and_ties();
  void touch_car(MbState& state);
  void touch_ground();
  void touch_self(MbState& state);
  void friction_and_apply(int segment, const Vec3& point, const Vec3& normal, double force,
                          const Vec3& v_other, double friction, double slip_speed, Vec3& out);
  void add(std::vector<Wrench>& loads, int segment, const Vec3& force, const Vec3& point);
  PosedEllipsoid posed(const SurfacePart& part) const;

  const MbModel& model_;
  OdeWorld& world_;
  Kinematics now_, before_;
  std::vector<JointMotion> motions_;
  Loads loads_;
  ContactReport report_;
  double car_power_ = 0;
};

}  // namespace crosswalk::mb
