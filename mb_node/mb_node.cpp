#include "mb_node/mb_node.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "common/error.h"
#include "common/schedule.h"
#include "mb_node/state_bytes.h"
#include "mb_node/world_builder.h"

namespace crosswalk::mb {
namespace {

constexpr std::int64_t kBodyStatePeriod = 1'000'000;  // ns
constexpr std::int64_t kForcePeriod = 50'000;         // ns
constexpr double kDriftLimit = 1e-4;                  // m: joints further apart mean a broken step

}  // namespace

/// What a window leaves for the recorder; kept back while the window may be repeated.
struct MbNode::Records {
  struct Bodies {
    std::int64_t t_ns;
    std::vector<Pose> poses;
  };
  struct Forces {
    std::int64_t t_ns;
    std::vector<Vec3> forces;
  };
  std::vector<Bodies> bodies;
  std::vector<Forces> forces;
  std::vector<HeadSample> heads;
  std::vector<std::pair<std::int64_t, std::string>> events;

  void flush(RecordSink& sink) {
    for (const HeadSample& head : heads) sink.head(head);
    for (const Bodies& b : bodies) sink.body_states(b.t_ns, b.poses);
    for (const Forces& f : forces) sink.contact_forces(f.t_ns, f.forces);
    for (const auto& [t_ns, text] : events) sink.event(t_ns, EventLevel::Info, text);
    *this = {};
  }
};

MbNode::MbNode(MbConfig config)
    : model_(std::make_unique<MbModel>(build_model(std::move(config)))),
      pending_(std::make_unique<Records>()) {
  state_ = initial_state(*model_);
  rebuild(std::vector<Inertia>(model_->config.body.segments.size()));
}

MbNode::~MbNode() = default;

void MbNode::rebuild(const std::vector<Inertia>& blocks) {
  world_ = std::make_unique<OdeWorld>(build_world(*model_, blocks));
  dynamics_ = std::make_unique<Dynamics>(*model_, *world_);
  start_motion_ = dynamics_->kinetic_energy() + dynamics_->gravity_energy();
  start_energy_ =
      start_motion_ + dynamics_->joint_energy(state_) + dynamics_->contact_energy(state_);
}

BodyMotion MbNode::motion_of(const std::string& body) const {
  if (body == "buck") {
    return {vehicle_pose(model_->config.vehicle, state_.vehicle),
            vehicle_twist(model_->config.vehicle, state_.vehicle)};
  }
  const int i = model_->config.body.find_segment(body);
  CW_ASSERT(i >= 0);
  return {{world_->pose(i).q, dynamics_->kinematics().p[i]}, dynamics_->kinematics().V[i]};
}

std::vector<InterfaceBody> MbNode::interface_bodies() const {
  std::vector<InterfaceBody> bodies;
  for (const InterfaceSpec& spec : model_->config.interfaces) {
    InterfaceBody body;
    body.name = spec.body;
    body.motion = motion_of(spec.body);
    body.is_attached = spec.is_attached;
    bodies.push_back(body);
  }
  return bodies;
}

void MbNode::attach(const std::vector<InterfaceBody>& bodies) {
  const BodyDescription& body = model_->config.body;
  std::vector<Inertia> blocks(body.segments.size());
  for (const InterfaceBody& interface : bodies) {
    if (!interface.is_attached || !(interface.block.mass > 0)) continue;
    const int i = body.find_segment(interface.name);
    CW_ASSERT(i >= 0);
    if (interface.name == "torso_up" && model_->config.multibody.replaces_t1_t3 &&
        interface.block.mass >= body.segments[i].mass) {
      throw UserError({{},
                       "multibody.replaces_t1_t3",
                       "a block lighter than torso_up",
                       fmt::format("{:.3f} kg", interface.block.mass),
                       "set it to false, or check the finite-element densities"});
    }
    blocks[i] = interface.block;
  }
  rebuild(blocks);
}

MbReply MbNode::advance(const MbGrant& grant, RecordSink& sink) {
  if (grant.id.phase == Phase::Accept) {
    pending_->flush(sink);
    window_start_.reset();
    return last_reply_;
  }
  if (grant.id.phase == Phase::Evaluate) {
    if (grant.id.iteration == 0 || window_start_ == nullptr) {
      window_start_ = std::make_unique<MbState>(snapshot());
    } else {
      restore(*window_start_);
    }
  }
  *pending_ = {};
  const std::uint64_t contacts_before = state_.contact_set;
  const std::vector<char> bones_before = state_.bone_broken;
  Eigen::MatrixXd W;
  if (grant.want_mobility) {
    const int n = substep_count(grant.id.length_s(), model_->config.multibody.substep);
    W = mobility(grant.id.length_s() / n);
  }
  run_substeps(grant, *pending_);
  last_reply_ = reply(grant, std::move(W), contacts_before, bones_before);
  if (grant.id.phase == Phase::Advance) pending_->flush(sink);
  return last_reply_;
}

void MbNode::run_substeps(const MbGrant& grant, Records& records) {
  const int n = substep_count(grant.id.length_s(), model_->config.multibody.substep);
  const double dt = grant.id.length_s() / n;
  const std::int64_t begin_ns = grant.id.begin_ns(), length_ns = grant.id.length_ns();
  if (state_.substeps == 0) {
    records.bodies.push_back({begin_ns, poses()});
    records.forces.push_back({begin_ns, forces()});
  }
  const Twist head_before = model_->head >= 0 ? dynamics_->kinematics().V[model_->head] : Twist{};
  for (int k = 0; k < n; ++k) {
    const bool was_touched = state_.first_contact_time >= 0;
    dynamics_->substep(state_, dt, external_loads(grant, dt, k == 0));
    ++progress_;
    const std::int64_t before = begin_ns + length_ns * k / n;
    const std::int64_t now = begin_ns + length_ns * (k + 1) / n;
    if (now / kForcePeriod > before / kForcePeriod) records.forces.push_back({now, forces()});
    if (now / kBodyStatePeriod > before / kBodyStatePeriod) {
      records.bodies.push_back({now, poses()});
    }
    if (!was_touched && state_.first_contact_time >= 0) {
      records.events.emplace_back(now, "first contact of car and pedestrian");
    }
  }
  if (!dynamics_->all_finite()) {
    throw NumericalError(state_.time, "a body's motion is not a number");
  }
  const OdeWorld::JointDrift drift = world_->joint_drift();
  if (drift.distance > kDriftLimit) {
    const Segment& child = model_->config.body.segments[drift.child];
    throw NumericalError(
        state_.time,
        fmt::format(
            "the joint between {} and {} has drifted apart by {:.2g} mm, {} turns at {:.0f} "
            "rad/s; use a smaller multibody.substep",
            model_->config.body.segments[child.parent].name, child.name, 1e3 * drift.distance,
            child.name, dynamics_->kinematics().V[drift.child].w.norm()));
  }
  if (model_->head < 0 || !grant.id.ends_window()) return;
  HeadSample head;
  head.t_ns = grant.id.end_ns();
  head.X_WH = {world_->pose(model_->head).q, dynamics_->kinematics().p[model_->head]};
  head.V_WH = dynamics_->kinematics().V[model_->head];
  head.acceleration = (head.V_WH.v - head_before.v) / grant.id.length_s();
  head.angular_acceleration = (head.V_WH.w - head_before.w) / grant.id.length_s();
  head.neck = dynamics_->joint_load(model_->head);
  records.heads.push_back(head);
}

std::vector<ExternalLoad> MbNode::external_loads(const MbGrant& grant, double substep,
                                                 bool is_first) const {
  std::vector<ExternalLoad> loads;
  const auto& interfaces = model_->config.interfaces;
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    Vec6 load = Vec6::Zero();
    if (i < grant.bias.size()) load += grant.bias[i];
    if (is_first && i < grant.carry.size()) load += grant.carry[i] / substep;
    if (load.isZero(0)) continue;
    const int segment =
        interfaces[i].body == "buck" ? kCar : model_->config.body.find_segment(interfaces[i].body);
    loads.push_back({segment, wrench_from(load)});
  }
  return loads;
}

Eigen::MatrixXd MbNode::mobility(double substep) const {
  std::vector<BodyPoint> points;
  for (const InterfaceSpec& spec : model_->config.interfaces) {
    if (!spec.is_attached) continue;
    const int i = model_->config.body.find_segment(spec.body);
    points.push_back({i, model_->reference_offset[i]});
  }
  if (points.empty()) return {};
  return kMobilitySafety * measure_mobility(*world_, points, substep, state_.time);
}

MbReply MbNode::reply(const MbGrant& grant, Eigen::MatrixXd mobility, std::uint64_t contacts_before,
                      std::vector<char> bones_before) const {
  MbReply r;
  r.substeps = substep_count(grant.id.length_s(), model_->config.multibody.substep);
  r.contacts = dynamics_->contacts().contacts;
  r.mobility_changed = state_.contact_set != contacts_before || state_.bone_broken != bones_before;
  r.first_contact = state_.first_contact_time >= 0;
  r.state_hash = state_hash();
  r.energy = energies();
  for (const InterfaceSpec& spec : model_->config.interfaces) {
    r.bodies.push_back(motion_of(spec.body));
  }
  r.mobility = std::move(mobility);
  return r;
}

MbEnergies MbNode::energies() const {
  const Energies& books = state_.energy;
  MbEnergies e;
  e.kinetic = dynamics_->kinetic_energy();
  e.gravity = dynamics_->gravity_energy();
  e.joint_elastic = dynamics_->joint_energy(state_);
  e.contact_elastic = dynamics_->contact_energy(state_);
  e.lost = books.lost;
  // What the finite-element side does to the car, the car does to it: that work is the car's
  // supply.
  e.car_work = books.car_work - books.car_interface_work;
  e.interface_work = books.interface_work + books.car_interface_work;
  e.stepping = e.kinetic + e.gravity - start_motion_ - books.joint_work - books.contact_work -
               books.interface_work;
  return e;
}

double MbNode::energy_balance(const MbEnergies& e) const {
  return e.held() - e.supplied() - start_energy_;
}

std::vector<Pose> MbNode::poses() const {
  std::vector<Pose> poses;
  for (int i = 0; i < world_->body_count(); ++i) {
    poses.push_back({world_->pose(i).q, dynamics_->kinematics().p[i]});
  }
  poses.push_back(vehicle_pose(model_->config.vehicle, state_.vehicle));
  return poses;
}

// Order of the names in description(): car_total, each component, head_car, ground, ground_head.
std::vector<Vec3> MbNode::forces() const {
  const ContactReport& report = dynamics_->contacts();
  std::vector<Vec3> forces = {report.car_total};
  forces.insert(forces.end(), report.car_component.begin(), report.car_component.end());
  forces.push_back(report.head_car);
  forces.push_back(report.ground);
  forces.push_back(report.ground_head);
  return forces;
}

MbState MbNode::snapshot() const {
  MbState copy = state_;
  copy.world = world_->save();
  return copy;
}

void MbNode::restore(const MbState& state) {
  state_ = state;
  world_->restore(state.world);
  dynamics_->refresh();
}

std::uint64_t MbNode::state_hash() const {
  // FNV over words of eight bytes, the upper half folded in: cheap beside a window.
  const std::vector<std::byte> bytes = to_bytes(snapshot());
  std::uint64_t hash = 14695981039346656037ULL;
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(hash)) {
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes[i], std::min(sizeof(word), bytes.size() - i));
    hash = (hash ^ word) * 1099511628211ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

std::vector<std::byte> MbNode::save_state() const { return to_bytes(snapshot()); }

void MbNode::load_state(const std::vector<std::byte>& bytes) {
  MbState state = snapshot();  // has the right sizes
  from_bytes(bytes, state);
  restore(state);
  progress_ = state_.substeps;
}

}  // namespace crosswalk::mb
