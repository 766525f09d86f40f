// What the two solver nodes and the coupler say to each other, free of any transport.
//
// One window of length H: the multibody side (mb) advances with the wrench of the finite-element
// side (fe), the fe side follows the resulting boundary motion and returns the impulse it exerted.
// All vectors in frame W (x subject's front, y buck travel, z up), SI units, 6-vectors (linear,
// angular), wrenches "fe on mb" about the body's reference point: a point fixed in the body
// (protocol: its multibody centre of mass at t = 0, before fe block masses are added).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "common/energy_books.h"
#include "common/spatial.h"

namespace crosswalk {

/// How the coupler wants a window done.
enum class Phase : int {
  Advance = 0,   ///< once and for good
  Evaluate = 1,  ///< save at iteration 0, restore at each further one, then advance
  Accept = 2     ///< keep the state of the last evaluation; nothing is advanced
};
enum class Status : int { Ok = 0, Warning = 1, Failed = 2 };

struct WindowId {
  std::int64_t window = 0;     ///< counts from 0
  std::int64_t window_ns = 0;  ///< length H
  int iteration = 0;
  Phase phase = Phase::Advance;
  // The implicit scheme does a window in parts when it does not converge on the whole.
  std::int64_t offset_ns = 0;  ///< where the part begins in the window
  std::int64_t part_ns = 0;    ///< its length; 0: the whole window

  std::int64_t begin_ns() const { return window * window_ns + offset_ns; }
  std::int64_t length_ns() const { return part_ns > 0 ? part_ns : window_ns; }
  std::int64_t end_ns() const { return begin_ns() + length_ns(); }
  bool ends_window() const { return offset_ns + length_ns() == window_ns; }
  double begin_s() const { return 1e-9 * static_cast<double>(begin_ns()); }
  double length_s() const { return 1e-9 * static_cast<double>(length_ns()); }
};

struct BodyMotion {
  Pose X_WB;   ///< origin at the reference point
  Twist V_WB;  ///< of the reference point
};

/// Coupler to mb: carry (N s, N m s) acts as carry/h during the first substep h, bias (N, N m) over
/// the whole window. Both have one entry per interface body.
struct MbGrant {
  WindowId id;
  bool want_mobility = false;
  std::vector<Vec6> carry;
  std::vector<Vec6> bias;
};

struct MbReply {
  Status status = Status::Ok;
  int substeps = 0;
  int contacts = 0;
  bool mobility_changed = false;  ///< contact set, joint stop or failure changed: measure again
  bool first_contact = false;     ///< car and pedestrian have touched (10 N)
  std::uint64_t state_hash = 0;
  MbEnergies energy;
  std::vector<BodyMotion> bodies;  ///< at the end of the window
  /// W = J M^-1 J^T of the attached bodies, measured before the step when asked for; else empty.
  Eigen::MatrixXd mobility;
};

/// Coupler to fe, per body: the motion to follow. With V_0 the twist after the carried impulse,
/// V(t) = V_0 + A (t - t_n) + W sum(d (F_j - bias)); A = twist_change / H.
struct BodyDrive {
  Pose X_WB;   ///< at the start of the window
  Twist V_WB;  ///< V_0
  Vec6 twist_change = Vec6::Zero();
  Vec6 bias = Vec6::Zero();
};

struct FeGrant {
  WindowId id;
  std::vector<BodyDrive> drives;  ///< attached bodies first
  /// Mobility of the attached bodies (6 n x 6 n), safety factor included; further bodies have none.
  Eigen::MatrixXd mobility;
};

struct BodyLoad {
  Vec6 impulse = Vec6::Zero();       ///< sum of d F_j, fe on mb
  Twist twist_end;                   ///< of the fe block
  Vec3 gap_position = Vec3::Zero();  ///< mb minus fe block at the start of the window
  Vec3 gap_rotation = Vec3::Zero();
};

struct FeReply {
  Status status = Status::Ok;
  int substeps = 0;
  std::uint64_t state_hash = 0;
  double stable_step = 0;                                                     ///< s
  double kinetic = 0, internal = 0, hourglass = 0, contact = 0, damping = 0;  ///< J
  double external_work = 0;       ///< J, gravity and loads other than the interface
  double interface_work = 0;      ///< J, done by the interface bodies on the fe part
  double added_mass = 0;          ///< kg
  double head_contact_force = 0;  ///< N
  std::vector<BodyLoad> loads;
};

/// Set-up exchange before window 0.
struct InterfaceBody {
  std::string name;
  BodyMotion motion;  ///< at t = 0, told by mb
  Inertia block;      ///< told by fe: mass it ties to the body and hands over; about the reference
                      ///< point, axes of W at t = 0
  bool is_attached = false;  ///< carries fe nodes (takes part in the mobility)
};

struct HeadSample {
  std::int64_t t_ns = 0;
  Pose X_WH;  ///< origin at the head COG, axes forward, left, up
  Twist V_WH;
  Vec3 acceleration = Vec3::Zero();          ///< m/s2, of the COG
  Vec3 angular_acceleration = Vec3::Zero();  ///< rad/s2
  Wrench neck;  ///< of the neck on the head, about the occipital condyles; zero without a neck
};

struct TissueSample {
  std::int64_t t_ns = 0;
  struct Region {
    double mps_max = 0, mps_95 = 0, mps_95_so_far = 0, csdm_15 = 0, csdm_25 = 0;
    double pressure_min = 0, pressure_max = 0, von_mises_95 = 0;  ///< Pa, pressure + in compression
    double inside_out = 0;  ///< volume share of bricks with a corner inside out
  };
  std::vector<Region> regions;  ///< order named in the node description
};

enum class EventLevel : int { Info = 0, Warning = 1, Error = 2 };

/// Where a solver node leaves what the recorder and viewers want; implementations number and batch
/// it.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  virtual void head(const HeadSample& sample) = 0;
  virtual void body_states(std::int64_t t_ns, const std::vector<Pose>& X_WB) = 0;
  virtual void contact_forces(std::int64_t t_ns, const std::vector<Vec3>& forces) = 0;
  virtual void tissue(const TissueSample& sample) = 0;
  virtual void event(std::int64_t t_ns, EventLevel level, const std::string& text) = 0;
};

/// The verbs of the multibody node.
class MbParticipant {
 public:
  virtual ~MbParticipant() = default;
  /// Interface bodies asked for by the scenario, in order, with their motion at t = 0.
  virtual std::vector<InterfaceBody> interface_bodies() const = 0;
  /// Takes the block masses over; called once before window 0 (not in multibody-only runs).
  virtual void attach(const std::vector<InterfaceBody>& bodies) = 0;
  virtual MbReply advance(const MbGrant& grant, RecordSink& sink) = 0;
  /// Names and shapes the numbered records refer to, one JSON object (docs/messages.md).
  virtual std::string description() const = 0;
  /// Substeps done so far, read by the heartbeat thread.
  virtual std::int64_t progress() const = 0;
  /// The complete state as bytes, for checkpoints; load_state() of the same bytes continues
  /// bit-identically.
  virtual std::vector<std::byte> save_state() const = 0;
  virtual void load_state(const std::vector<std::byte>& bytes) = 0;
};

/// The verbs of the finite-element node.
class FeParticipant {
 public:
  virtual ~FeParticipant() = default;
  /// Names of the interface bodies the model needs, attached ones first.
  virtual std::vector<InterfaceBody> interface_bodies() const = 0;
  /// Places the model on the bodies' initial motion; fills and returns block masses.
  virtual std::vector<InterfaceBody> place(std::vector<InterfaceBody> bodies) = 0;
  virtual FeReply advance(const FeGrant& grant, RecordSink& sink) = 0;
  virtual std::string description() const = 0;
  virtual std::int64_t progress() const = 0;
  virtual std::vector<std::byte> save_state() const = 0;
  virtual void load_state(const std::vector<std::byte>& bytes) = 0;
};

}  // namespace crosswalk
