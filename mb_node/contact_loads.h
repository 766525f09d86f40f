// All contacts of one substep: car, ground and the body with itself; and the books of their work.
//
// A contact pushes along its normal with an elastic force, a function of penetration and deepest
// penetration (contact_law.h), and a viscous one (rate term, ground damping), and across it with
// friction. What the elastic force takes is stored or lost by hysteresis, both known from the
// penetrations alone; viscous and friction forces are booked as force times motion.
#pragma once

#include "mb_node/loads.h"
#include "mb_node/model.h"

namespace crosswalk::mb {

/// What the last substep's contacts were, for reports.
struct ContactReport {
  Vec3 car_total = Vec3::Zero();  ///< on the pedestrian
  std::vector<Vec3> car_component;
  Vec3 head_car = Vec3::Zero();
  Vec3 head_point = Vec3::Zero();  ///< where the head last touched the car, W
  Vec3 ground = Vec3::Zero();
  Vec3 ground_head = Vec3::Zero();  ///< the part of it on the head
  double self_total = 0;            ///< N, sum of magnitudes
  int contacts = 0;
  std::uint64_t contact_set = 0;  ///< hash of the pairs in touch
};

class ContactLoads {
 public:
  explicit ContactLoads(const MbModel& model);
  /// Finds the contacts and adds their forces; dt is the length of the last and the next substep.
  void apply(const Kinematics& now, double dt, bool is_on_ground, MbState& state,
             std::vector<Wrench>& loads);
  /// Books viscous, friction and car work of the substep that followed, from the motion at its two
  /// ends; the car's is in the state by now.
  void book(const Kinematics& before, const Kinematics& after, const VehicleState& car_before,
            double dt, MbState& state) const;
  /// Stored in all contacts after the substep; adds what the next call of apply() will book as
  /// lost by hysteresis for it. The ground counts also while a support holds the body over it: it
  /// is pressed as far as it will carry once the support lets go.
  double stored_energy(const Kinematics& after, double dt, const MbState& state) const;

  const ContactReport& report() const { return report_; }

 private:
  static constexpr int kCarSide = -1, kGroundSide = -2;
  /// A contact that pushed in this substep.
  struct Push {
    int segment = -1, other = kGroundSide;  ///< a segment, or the car or the ground
    Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
    const ContactLaw* law = nullptr;  ///< null: linear
    double stiffness = 0;             ///< N/m, of a linear one
    double pressed = 0, deepest = 0;  ///< m
    double viscous = 0;               ///< N
    Vec3 friction = Vec3::Zero();     ///< N
    Vec3 total = Vec3::Zero();        ///< N, on the segment
  };
  void touch_car(const Kinematics& now, double dt, MbState& state, std::vector<Wrench>& loads);
  void push_car(const Kinematics& now, const MbState& state, int i, const PanelTouch& touch,
                const Overlap& o, std::vector<Wrench>& loads);
  void touch_ground(const Kinematics& now, std::vector<Wrench>& loads);
  double ground_energy(const Kinematics& now) const;
  void touch_self(const Kinematics& now, MbState& state, std::vector<Wrench>& loads);
  /// Normal force and Coulomb friction of a push; `friction` is the coefficient.
  void add(const Kinematics& now, const Vec3& v_other, double force, double friction,
           double slip_speed, Push push, std::vector<Wrench>& loads);
  PosedEllipsoid posed(const Kinematics& now, const SurfacePart& part) const;
  Vec3 velocity_of_other(const Kinematics& now, const VehicleState& car, const Push& push) const;

  const MbModel& model_;
  std::vector<std::vector<const ContactLaw*>> laws_;  ///< by region, by panel of the front
  std::vector<Push> pushes_;
  std::vector<PanelTouch> touches_;
  std::vector<Overlap> overlaps_;
  ContactReport report_;
  bool is_on_ground_ = false;
};

}  // namespace crosswalk::mb
