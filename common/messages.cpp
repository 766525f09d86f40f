#include "common/messages.h"

#include <algorithm>
#include <iterator>
#include <type_traits>

#include <fmt/format.h>

#include "common/error.h"
#include "crosswalk/msg/body_states.hpp"
#include "crosswalk/msg/contact_forces.hpp"
#include "crosswalk/msg/coupling_audit.hpp"
#include "crosswalk/msg/head_kinematics.hpp"
#include "crosswalk/msg/node_description.hpp"
#include "crosswalk/msg/node_hello.hpp"
#include "crosswalk/msg/node_status.hpp"
#include "crosswalk/msg/recorder_ack.hpp"
#include "crosswalk/msg/resend_request.hpp"
#include "crosswalk/msg/run_control.hpp"
#include "crosswalk/msg/run_event.hpp"
#include "crosswalk/msg/run_manifest.hpp"
#include "crosswalk/msg/tissue_strain.hpp"

namespace crosswalk {

std::int64_t message_digest() {
  const std::int64_t hashes[] = {msg::step_to_mb::getHash(),     msg::mb_done::getHash(),
                                 msg::step_to_fe::getHash(),     msg::fe_done::getHash(),
                                 msg::mobility::getHash(),       msg::boundary_motion::getHash(),
                                 msg::boundary_mass::getHash(),  msg::node_hello::getHash(),
                                 msg::run_manifest::getHash(),   msg::run_control::getHash(),
                                 msg::node_status::getHash(),    msg::recorder_ack::getHash(),
                                 msg::resend_request::getHash(), msg::head_kinematics::getHash(),
                                 msg::body_states::getHash(),    msg::contact_forces::getHash(),
                                 msg::tissue_strain::getHash(),  msg::node_description::getHash(),
                                 msg::run_event::getHash(),      msg::coupling_audit::getHash()};
  std::string text;
  for (const std::int64_t hash : hashes)
    text += fmt::format("{:016x}", static_cast<std::uint64_t>(hash));
  return static_cast<std::int64_t>(fnv1a(text));
}

namespace {

// Fixed arrays on the wire <-> Eigen vectors.
template <class T, int N>
void put(T (&out)[N], const Eigen::Matrix<double, N, 1>& in) {
  for (int i = 0; i < N; ++i) out[i] = static_cast<T>(in[i]);
}
void put(double (&out)[4], const Quat& q) {
  out[0] = q.w(), out[1] = q.x(), out[2] = q.y(), out[3] = q.z();
}
template <class T, int N>
Eigen::Matrix<double, N, 1> get(const T (&in)[N]) {
  Eigen::Matrix<double, N, 1> out;
  for (int i = 0; i < N; ++i) out[i] = static_cast<double>(in[i]);
  return out;
}
Quat get_rotation(const double (&in)[4]) { return {in[0], in[1], in[2], in[3]}; }

void put(double (&out)[6], const Mat3& a) {
  out[0] = a(0, 0), out[1] = a(1, 1), out[2] = a(2, 2), out[3] = a(0, 1), out[4] = a(0, 2),
  out[5] = a(1, 2);
}
Mat3 get_symmetric(const double (&in)[6]) {
  Mat3 a;
  a << in[0], in[3], in[4], in[3], in[1], in[5], in[4], in[5], in[2];
  return a;
}

msg::body_motion motion_of(const BodyMotion& motion) {
  msg::body_motion m{};
  put(m.position, motion.X_WB.p);
  put(m.quaternion, motion.X_WB.q);
  put(m.velocity, motion.V_WB.v);
  put(m.angular_velocity, motion.V_WB.w);
  return m;
}

BodyMotion motion_of(const msg::body_motion& m) {
  return {{get_rotation(m.quaternion), get(m.position)},
          {get(m.velocity), get(m.angular_velocity)}};
}

// A default-built message has uninitialised plain arrays; everything sent must be defined.
template <class M>
M blank() {
  return M{};
}

template <class M>
void put_id(M& m, const WindowId& id) {
  m.window = id.window;
  m.window_ns = id.window_ns;
  m.offset_ns = static_cast<std::int32_t>(id.offset_ns);
  m.part_ns = static_cast<std::int32_t>(id.part_ns);
  m.iteration = id.iteration;
  m.phase = static_cast<int>(id.phase);
}
template <class M>
WindowId get_id(const M& m) {
  return {m.window, m.window_ns, m.iteration, static_cast<Phase>(m.phase), m.offset_ns, m.part_ns};
}
int body_count(std::size_t n) {
  CW_ASSERT(n <= static_cast<std::size_t>(kMaxInterfaceBodies));
  return static_cast<int>(n);
}

}  // namespace

msg::step_to_mb to_message(const MbGrant& grant) {
  auto m = blank<msg::step_to_mb>();
  put_id(m, grant.id);
  m.n_bodies = body_count(grant.bias.size());
  m.want_mobility = grant.want_mobility ? 1 : 0;
  for (std::size_t k = 0; k < grant.bias.size(); ++k) {
    put(m.carry[k], grant.carry[k]);
    put(m.bias[k], grant.bias[k]);
  }
  return m;
}

MbGrant from_message(const msg::step_to_mb& m) {
  MbGrant grant{.id = get_id(m), .want_mobility = m.want_mobility != 0, .carry = {}, .bias = {}};
  for (int k = 0; k < m.n_bodies; ++k) {
    grant.carry.push_back(get(m.carry[k]));
    grant.bias.push_back(get(m.bias[k]));
  }
  return grant;
}

msg::mb_done to_message(const WindowId& id, const MbReply& reply) {
  auto m = blank<msg::mb_done>();
  m.window = id.window;
  m.t_ns = id.end_ns();
  m.iteration = id.iteration;
  m.status = static_cast<int>(reply.status);
  m.n_bodies = body_count(reply.bodies.size());
  m.n_contacts = reply.contacts;
  m.substeps = reply.substeps;
  m.state_hash = static_cast<std::int64_t>(reply.state_hash);
  m.mobility_changed = reply.mobility_changed ? 1 : 0;
  m.first_contact = reply.first_contact ? 1 : 0;
  const MbEnergies& e = reply.energy;
  m.kinetic = e.kinetic;
  m.gravity = e.gravity;
  m.joint_elastic = e.joint_elastic;
  m.contact_elastic = e.contact_elastic;
  static_assert(std::extent_v<decltype(m.lost)> == kMbLosses);
  std::copy(e.lost.J.begin(), e.lost.J.end(), m.lost);
  m.car_work = e.car_work;
  m.interface_work = e.interface_work;
  m.stepping = e.stepping;
  for (std::size_t k = 0; k < reply.bodies.size(); ++k) m.body[k] = motion_of(reply.bodies[k]);
  return m;
}

MbReply from_message(const msg::mb_done& m) {
  MbReply reply;
  reply.status = static_cast<Status>(m.status);
  reply.substeps = m.substeps;
  reply.contacts = m.n_contacts;
  reply.mobility_changed = m.mobility_changed != 0;
  reply.first_contact = m.first_contact != 0;
  reply.state_hash = static_cast<std::uint64_t>(m.state_hash);
  MbEnergies& e = reply.energy;
  e.kinetic = m.kinetic;
  e.gravity = m.gravity;
  e.joint_elastic = m.joint_elastic;
  e.contact_elastic = m.contact_elastic;
  std::copy(std::begin(m.lost), std::end(m.lost), e.lost.J.begin());
  e.car_work = m.car_work;
  e.interface_work = m.interface_work;
  e.stepping = m.stepping;
  for (int k = 0; k < m.n_bodies; ++k) reply.bodies.push_back(motion_of(m.body[k]));
  return reply;
}

msg::step_to_fe to_message(const FeGrant& grant, int mobility_id) {
  auto m = blank<msg::step_to_fe>();
  put_id(m, grant.id);
  m.n_bodies = body_count(grant.drives.size());
  m.mobility_id = mobility_id;
  for (std::size_t k = 0; k < grant.drives.size(); ++k) {
    const BodyDrive& drive = grant.drives[k];
    put(m.body[k].position, drive.X_WB.p);
    put(m.body[k].quaternion, drive.X_WB.q);
    put(m.body[k].twist, stack(drive.V_WB));
    put(m.body[k].twist_change, drive.twist_change);
    put(m.body[k].bias, drive.bias);
  }
  return m;
}

FeGrant from_message(const msg::step_to_fe& m) {
  FeGrant grant{.id = get_id(m), .drives = {}, .mobility = {}};
  for (int k = 0; k < m.n_bodies; ++k) {
    const msg::body_drive& b = m.body[k];
    grant.drives.push_back({{get_rotation(b.quaternion), get(b.position)},
                            twist_from(get(b.twist)),
                            get(b.twist_change),
                            get(b.bias)});
  }
  return grant;
}

msg::fe_done to_message(const WindowId& id, const FeReply& reply) {
  auto m = blank<msg::fe_done>();
  m.window = id.window;
  m.t_ns = id.end_ns();
  m.iteration = id.iteration;
  m.status = static_cast<int>(reply.status);
  m.n_bodies = body_count(reply.loads.size());
  m.substeps = reply.substeps;
  m.state_hash = static_cast<std::int64_t>(reply.state_hash);
  m.stable_step = reply.stable_step;
  m.kinetic = reply.kinetic;
  m.internal = reply.internal;
  m.hourglass = reply.hourglass;
  m.contact = reply.contact;
  m.damping = reply.damping;
  m.external_work = reply.external_work;
  m.interface_work = reply.interface_work;
  m.added_mass = reply.added_mass;
  m.head_contact_force = reply.head_contact_force;
  for (std::size_t k = 0; k < reply.loads.size(); ++k) {
    const BodyLoad& load = reply.loads[k];
    put(m.load[k].impulse, load.impulse);
    put(m.load[k].twist_end, stack(load.twist_end));
    put(m.load[k].gap_position, load.gap_position);
    put(m.load[k].gap_rotation, load.gap_rotation);
  }
  return m;
}

FeReply from_message(const msg::fe_done& m) {
  FeReply reply;
  reply.status = static_cast<Status>(m.status);
  reply.substeps = m.substeps;
  reply.state_hash = static_cast<std::uint64_t>(m.state_hash);
  reply.stable_step = m.stable_step;
  reply.kinetic = m.kinetic;
  reply.internal = m.internal;
  reply.hourglass = m.hourglass;
  reply.contact = m.contact;
  reply.damping = m.damping;
  reply.external_work = m.external_work;
  reply.interface_work = m.interface_work;
  reply.added_mass = m.added_mass;
  reply.head_contact_force = m.head_contact_force;
  for (int k = 0; k < m.n_bodies; ++k) {
    reply.loads.push_back({get(m.load[k].impulse), twist_from(get(m.load[k].twist_end)),
                           get(m.load[k].gap_position), get(m.load[k].gap_rotation)});
  }
  return reply;
}

msg::mobility to_message(const Eigen::MatrixXd& mobility) {
  CW_ASSERT(mobility.rows() == mobility.cols() && mobility.rows() % 6 == 0);
  CW_ASSERT(mobility.rows() <= 6 * kMaxAttachedBodies);
  auto m = blank<msg::mobility>();
  m.n_bodies = static_cast<int>(mobility.rows()) / 6;
  int at = 0;
  for (int i = 0; i < mobility.rows(); ++i) {
    for (int j = 0; j <= i; ++j) m.lower[at++] = static_cast<float>(mobility(i, j));
  }
  return m;
}

Eigen::MatrixXd from_message(const msg::mobility& m) {
  Eigen::MatrixXd mobility(6 * m.n_bodies, 6 * m.n_bodies);
  int at = 0;
  for (int i = 0; i < mobility.rows(); ++i) {
    for (int j = 0; j <= i; ++j)
      mobility(i, j) = mobility(j, i) = static_cast<double>(m.lower[at++]);
  }
  return mobility;
}

msg::boundary_motion motion_message(const std::vector<InterfaceBody>& bodies) {
  auto m = blank<msg::boundary_motion>();
  m.n_bodies = body_count(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) m.body[k] = motion_of(bodies[k].motion);
  return m;
}

msg::boundary_mass mass_message(const std::vector<InterfaceBody>& bodies) {
  auto m = blank<msg::boundary_mass>();
  m.n_bodies = body_count(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    m.block[k].mass = bodies[k].block.mass;
    put(m.block[k].com, bodies[k].block.com);
    put(m.block[k].about_com, bodies[k].block.about_com);
  }
  return m;
}

void read_motion(const msg::boundary_motion& m, std::vector<InterfaceBody>& bodies) {
  CW_ASSERT(m.n_bodies == static_cast<int>(bodies.size()));
  for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].motion = motion_of(m.body[k]);
}

void read_mass(const msg::boundary_mass& m, std::vector<InterfaceBody>& bodies) {
  CW_ASSERT(m.n_bodies == static_cast<int>(bodies.size()));
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    bodies[k].block = {m.block[k].mass, get(m.block[k].com), get_symmetric(m.block[k].about_com)};
  }
}

msg::head_sample to_message(const HeadSample& sample) {
  auto m = blank<msg::head_sample>();
  m.t_ns = sample.t_ns;
  put(m.position, sample.X_WH.p);
  put(m.quaternion, sample.X_WH.q);
  put(m.velocity, sample.V_WH.v);
  put(m.angular_velocity, sample.V_WH.w);
  put(m.acceleration, sample.acceleration);
  put(m.angular_acceleration, sample.angular_acceleration);
  put(m.neck_force, sample.neck.f);
  put(m.neck_moment, sample.neck.tau);
  return m;
}

HeadSample from_message(const msg::head_sample& m) {
  return {m.t_ns,
          {get_rotation(m.quaternion), get(m.position)},
          {get(m.velocity), get(m.angular_velocity)},
          get(m.acceleration),
          get(m.angular_acceleration),
          {get(m.neck_force), get(m.neck_moment)}};
}

msg::tissue_strain to_message(const TissueSample& sample) {
  auto m = blank<msg::tissue_strain>();
  constexpr std::size_t kMaxRegions = std::size(decltype(m.mps_max){});
  CW_ASSERT(sample.regions.size() <= kMaxRegions);
  m.t_ns = sample.t_ns;
  m.n = static_cast<int>(sample.regions.size());
  for (std::size_t i = 0; i < sample.regions.size(); ++i) {
    const TissueSample::Region& r = sample.regions[i];
    m.mps_max[i] = static_cast<float>(r.mps_max);
    m.mps_95[i] = static_cast<float>(r.mps_95);
    m.mps_95_so_far[i] = static_cast<float>(r.mps_95_so_far);
    m.csdm_15[i] = static_cast<float>(r.csdm_15);
    m.csdm_25[i] = static_cast<float>(r.csdm_25);
    m.pressure_min[i] = static_cast<float>(r.pressure_min);
    m.pressure_max[i] = static_cast<float>(r.pressure_max);
    m.von_mises_95[i] = static_cast<float>(r.von_mises_95);
    m.inside_out[i] = static_cast<float>(r.inside_out);
  }
  return m;
}

namespace {
// Through memory: g++ 12 with -O3 drops the rounding of `cast<float>().cast<double>()`.
double rounded(double a) {
  const volatile float on_wire = static_cast<float>(a);
  return static_cast<double>(on_wire);
}
Vec6 rounded(Vec6 a) {
  for (double& x : a) x = rounded(x);
  return a;
}
}  // namespace

MbGrant as_on_wire(MbGrant grant) {
  for (Vec6& bias : grant.bias) bias = rounded(bias);
  return grant;
}

FeGrant as_on_wire(FeGrant grant) {
  for (BodyDrive& drive : grant.drives) {
    drive.twist_change = rounded(drive.twist_change);
    drive.bias = rounded(drive.bias);
  }
  grant.mobility = mobility_as_on_wire(std::move(grant.mobility));
  return grant;
}

Eigen::MatrixXd mobility_as_on_wire(Eigen::MatrixXd mobility) {
  for (double& x : mobility.reshaped()) x = rounded(x);
  return mobility;
}

std::string wire_text(std::string text, int max_bytes) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  if (static_cast<int>(text.size()) > max_bytes) text.resize(static_cast<std::size_t>(max_bytes));
  return text;
}

}  // namespace crosswalk
