// Where the energy of the multibody side is, and which law took it: one book for each.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace crosswalk {

/// What the multibody side's laws take out of the motion for good, one book each.
enum class MbLoss : int {
  JointDamping,     ///< damping of joints, bones, scapulae and wrist tie
  JointFriction,    ///< dry friction of joints and broken bones
  JointHysteresis,  ///< unloading of stops, torn ligaments, broken bones
  /// Against laws without a potential, which give back as well: the two-joint passive moments of
  /// hip, knee and ankle, and the knee ligaments' weakening in flexion.
  JointPassive,
  ContactHysteresis,  ///< dents of car and flesh; what a car part keeps when the body passes on
  ContactViscous,     ///< rate terms, ground damping
  ContactFriction
};
inline constexpr int kMbLosses = 7;
inline constexpr std::array<const char*, kMbLosses> kMbLossNames = {
    "joint_damping",      "joint_friction",  "joint_hysteresis", "joint_passive",
    "contact_hysteresis", "contact_viscous", "contact_friction"};

struct LossBooks {
  std::array<double, kMbLosses> J = {};
  double& operator[](MbLoss loss) { return J[static_cast<std::size_t>(loss)]; }
  double operator[](MbLoss loss) const { return J[static_cast<std::size_t>(loss)]; }
  double sum() const {
    double total = 0;
    for (const double energy : J) total += energy;
    return total;
  }
};

/// Energies of the multibody side, J, works since the start. held() - supplied() stays where it
/// was, but for the errors of steps and laws.
struct MbEnergies {
  double kinetic = 0, gravity = 0;
  double joint_elastic = 0, contact_elastic = 0;  ///< what unloading would give back
  LossBooks lost;
  double car_work = 0, interface_work = 0;
  double stepping = 0;  ///< gained by time steps and joint constraints: no force's work
  double held() const { return kinetic + gravity + joint_elastic + contact_elastic + lost.sum(); }
  double supplied() const { return car_work + interface_work; }
  double joint_lost() const {
    return lost[MbLoss::JointDamping] + lost[MbLoss::JointFriction] +
           lost[MbLoss::JointHysteresis] + lost[MbLoss::JointPassive];
  }
};

/// Every book under its name, in the order in which they are printed.
inline std::vector<std::pair<std::string, double>> energy_rows(const MbEnergies& e) {
  std::vector<std::pair<std::string, double>> rows = {{"car_work", e.car_work},
                                                      {"interface_work", e.interface_work},
                                                      {"kinetic", e.kinetic},
                                                      {"gravity", e.gravity},
                                                      {"stored_in_joints", e.joint_elastic},
                                                      {"stored_in_contacts", e.contact_elastic}};
  for (std::size_t k = 0; k < kMbLosses; ++k) {
    rows.emplace_back(std::string("lost_by_") + kMbLossNames[k], e.lost.J[k]);
  }
  rows.emplace_back("gained_by_steps", e.stepping);
  return rows;
}

}  // namespace crosswalk
