// The lattice neck: a model small enough to scan every scheme and window, stiff enough to break bad
// ones. Twelve layers of four masses, alternating bone-stiff and disc-soft cells, and a head on
// top, computed by the finite-element solver of production; below it either one free body or a
// torso with two clavicles and two arms on ball joints, on the engine of production. Frame W, SI.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "common/byte_archive.h"
#include "common/exchange.h"
#include "common/schedule.h"
#include "common/units.h"
#include "fe_node/boundary.h"
#include "fe_node/element/line.h"
#include "fe_node/output/state_bytes.h"
#include "mb_node/ode_world.h"

namespace crosswalk::coupling {

struct NeckCase {
  double body_mass = 15;        ///< kg, of the torso
  double damping_ratio = 0.05;  ///< of every bar: c = 2 zeta sqrt(k m)
  double head_mass = 4.5;
  bool has_clavicles = false;
  bool has_wall = false;     ///< a soft wall that the torso runs into
  double push = 1500;        ///< N along x on the torso: half sine of 20 ms
  Vec3 spin = Vec3::Zero();  ///< rad/s, of everything at the start
  double mb_step = 10e-6;
  double fe_step = 0.5e-6;
};

inline constexpr double kPushTime = 20e-3;
inline constexpr double kNeckNodeMass = 0.02, kBoneStiffness = 1e9, kDiscStiffness = 3e5;
inline constexpr double kMuscleStiffness = 2e5, kClavicleMass = 0.3;

inline double push_at(const NeckCase& c, double t) {
  return t < kPushTime ? c.push * std::sin(kPi * t / kPushTime) : 0.0;
}
inline Mat3 sphere_inertia(double mass, double radius) {
  return 0.4 * mass * radius * radius * Mat3::Identity();
}

/// Of the bodies at their first places, p in W.
struct BallJoint {
  int parent = 0, child = 0;
  Vec3 p = Vec3::Zero();
};
std::vector<BallJoint> ball_joints(const NeckCase& c);

/// The bodies of the multibody side; body 0 is the torso, reference points at the centres of mass
/// before any block is added.
class NeckBodies : public MbParticipant {
 public:
  explicit NeckBodies(const NeckCase& c);
  std::vector<InterfaceBody> interface_bodies() const override;
  void attach(const std::vector<InterfaceBody>& bodies) override;
  MbReply advance(const MbGrant& grant, RecordSink& sink) override;
  std::string description() const override { return "{}"; }
  std::int64_t progress() const override { return 0; }
  std::vector<std::byte> save_state() const override;
  void load_state(const std::vector<std::byte>& bytes) override;

  int attached() const { return case_.has_clavicles ? 3 : 1; }
  const mb::OdeWorld& world() const { return *world_; }
  /// Of each body with its block, about the reference point; after load_state() as the writer of
  /// that state had it.
  const std::vector<Inertia>& inertia() const { return inertia_; }

 private:
  struct Now {
    mb::WorldState world;
    double time = 0, work = 0;
  };
  void build(const std::vector<InterfaceBody>& blocks);
  BodyMotion motion(int body) const;
  void substep(const MbGrant& grant, double h, bool is_first);

  NeckCase case_;
  std::optional<mb::OdeWorld> world_;
  std::vector<Inertia> inertia_;  ///< its com: the engine's from the reference point, body axes
  Now now_;
  std::optional<Now> saved_;
  MbReply reply_;
};

/// The neck on one body whose mass is `own_mass` here (a run whole in the solver) or lies on the
/// multibody side (own_mass 0); with clavicles always the latter.
fe::Model neck_model(const NeckCase& c, double own_mass);

class LatticeNeck : public FeParticipant {
 public:
  explicit LatticeNeck(const NeckCase& c);
  std::vector<InterfaceBody> interface_bodies() const override;
  std::vector<InterfaceBody> place(std::vector<InterfaceBody> bodies) override;
  FeReply advance(const FeGrant& grant, RecordSink& sink) override;
  std::string description() const override { return "{}"; }
  std::int64_t progress() const override { return 0; }
  std::vector<std::byte> save_state() const override;
  void load_state(const std::vector<std::byte>& bytes) override;

  Vec3 head() const { return state_.nodes.back().position(); }
  /// Of the nodes that are not part of a block.
  Vec3 momentum() const;
  Vec3 angular_momentum() const;
  double energy() const { return state_.energies.kinetic + state_.energies.internal; }

 private:
  NeckCase case_;
  fe::Model model_;
  fe::Boundary boundary_;
  fe::State state_, saved_;
  std::optional<fe::Scratch> scratch_;
  FeReply reply_;
};

/// What a run of the whole neck in the finite-element solver gives: body, neck and head as one.
struct WholeNeck {
  Vec3 head;
  double energy = 0, peak_energy = 0;
};
WholeNeck run_whole(const NeckCase& c, double end);

}  // namespace crosswalk::coupling
