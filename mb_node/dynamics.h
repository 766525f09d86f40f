// One multibody substep as a visible list: restraints, contacts, interface loads, step, energy
// books.
#pragma once

#include <span>

#include "mb_node/contact_loads.h"
#include "mb_node/joint_loads.h"
#include "mb_node/loads.h"
#include "mb_node/model.h"

namespace crosswalk::mb {

/// Forces of one substep, per body about its reference point, by origin.
struct Loads {
  std::vector<Wrench> joint, contact, interface;
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
  const ContactReport& contacts() const { return contacts_.report(); }
  /// What the parent of a segment without children exerts on it through their joint, mean of the
  /// last substep, about the joint, W: what Newton's law leaves of contacts, gravity and inertia.
  Wrench joint_load(int segment) const;
  double kinetic_energy() const { return world_.kinetic_energy(); }
  double gravity_energy() const;
  /// Stored in restraints.
  double joint_energy(const MbState& state) const { return joints_.stored_energy(now_, state); }
  /// Stored in contacts; see ContactLoads::stored_energy.
  double contact_energy(const MbState& state) const {
    return contacts_.stored_energy(now_, last_dt_, state);
  }
  bool all_finite() const;

 private:
  const MbModel& model_;
  OdeWorld& world_;
  Kinematics now_, before_;
  Loads loads_;
  JointLoads joints_;
  ContactLoads contacts_;
  double last_dt_ = 0;
  Vec3 last_gravity_ = Vec3::Zero();
};

}  // namespace crosswalk::mb
