#include "tests/recorder/synthetic_run.h"

#include <cmath>
#include <map>

#include "common/messages.h"
#include "common/seal.h"
#include "recorder/message_decode.h"

namespace crosswalk::recording {

namespace {

using Run = SyntheticRun;

double seconds(std::int64_t t_ns) { return 1e-9 * static_cast<double>(t_ns); }

/// Head speed along y: a smooth step of 3 m/s around 15 ms (error function of a bell).
double head_speed(double t) { return 1.5 * (1 + std::erf((t - 0.015) / 0.0015)); }

double head_travel(double t) {
  const double s = (t - 0.015) / 0.0015;
  return 1.5 * (t + 0.0015 * (s * std::erf(s) + std::exp(-s * s) / std::sqrt(M_PI)));
}

class Writer {
 public:
  explicit Writer(const Run& run) : run_(run) {}

  template <class M>
  void send(M message, Role sender, std::int64_t seq) {
    message.h.protocol = kProtocolVersion;
    message.h.kind = static_cast<std::int16_t>(kKindOf<M>);
    message.h.sender = static_cast<std::int16_t>(sender);
    message.h.attempt = 1;
    message.h.run_id = run_digest(run_.run_id);
    message.h.instance = 7;
    message.h.seq = seq;
    RawMessage raw;
    raw.channel = channel_name(message.h.run_id, kKindOf<M>, sender);
    raw.data.resize(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(raw.data.data(), 0, static_cast<int>(raw.data.size()));
    seal(message.h.run_id, raw.data);
    out.push_back(std::move(raw));
  }
  template <class M>
  void send_record(const M& message, Role sender) {
    send(message, sender, records[sender]++);
  }

  void open();
  void window(std::int64_t k);
  void close();

  std::vector<RawMessage> out;
  std::map<Role, std::int64_t> records;

 private:
  void head(std::int64_t t_ns);
  void mb(std::int64_t k, std::int64_t t_ns);
  void fe(std::int64_t k, std::int64_t t_ns);

  const Run& run_;
  msg::head_kinematics batch_{};
};

void Writer::open() {
  msg::run_manifest m{};
  m.window_ns = Run::kWindowNs;
  m.duration_ns = Run::kWindows * Run::kWindowNs;
  m.has_fe = run_.has_fe ? 1 : 0;
  m.body_name = {"upper_torso", "buck"};
  m.n_bodies = 2;
  m.n_attached = run_.has_fe ? 1 : 0;
  m.run_id = run_.run_id;
  m.scenario_name = "V2370";
  send(m, Role::Coupler, 0);
  msg::node_description d{};
  d.n_parts = 2;
  d.text = R"({"bodies": ["pelvis", "buck"], "head_body": -1, "contact_pairs": ["car_total",)";
  send_record(d, Role::Mb);
  d.part = 1;
  d.text = R"( "head_glass"], "vehicle": {"speed_m_s": 11.0, "facets": [)"
           R"({"component": "bumper", "begin_yz_m": [0, 0.4], "end_yz_m": [0, 0.8]},)"
           R"({"component": "hood", "begin_yz_m": [0, 0.8], "end_yz_m": [-1.0, 1.0]}]}})";
  send_record(d, Role::Mb);
  if (!run_.has_fe) return;
  d.part = 0;
  d.n_parts = 1;
  d.text = R"({"regions": ["cerebrum", "brain stem"]})";
  send_record(d, Role::Fe);
}

void Writer::head(std::int64_t t_ns) {
  const double t = seconds(t_ns);
  HeadSample sample;
  sample.t_ns = t_ns;
  sample.X_WH.p = Vec3(0.1, head_travel(t), 1.7 - 0.5 * t);
  sample.X_WH.q = Quat(Eigen::AngleAxisd(Run::kSpin * t, Vec3::UnitZ()));
  sample.V_WH.v = Vec3(0, head_speed(t), -0.5);
  sample.V_WH.w = Vec3(0, 0, Run::kSpin);
  sample.neck.f = sample.X_WH.q * Vec3(40, 0, -Run::kNeckPull);  // the neck pulls downwards
  sample.neck.tau = sample.X_WH.q * Vec3(0, -Run::kNeckFlexion, 0);
  batch_.sample[batch_.n++] = to_message(sample);
  if (batch_.n < 6) return;
  send_record(batch_, run_.has_fe ? Role::Fe : Role::Mb);
  batch_.n = 0;
}

void Writer::mb(std::int64_t k, std::int64_t t_ns) {
  const double t = seconds(t_ns);
  if (k % 5 == 0) {
    msg::contact_forces c{};
    c.t_ns = t_ns;
    c.n = 2;
    c.force[0][1] = t >= Run::kFirstContact - 1e-12 ? 500.0F : 0.0F;
    c.force[1][1] = !run_.has_fe && t >= Run::kHeadContact - 1e-12 ? 900.0F : 0.0F;
    send_record(c, Role::Mb);
  }
  if (k % 50 == 0) {
    msg::body_states b{};
    b.t_ns = t_ns;
    b.n = b.n_total = 2;
    b.position[1][1] = static_cast<float>(Run::kBuckSpeed * t);
    b.quaternion[0][0] = b.quaternion[1][0] = 1;
    send_record(b, Role::Mb);
  }
  msg::mb_done m{};
  m.window = k;
  m.t_ns = t_ns;
  m.n_bodies = 2;
  m.kinetic = 100 * t;
  m.lost[1] = 10 * t;
  m.interface_work = -2 * t;
  m.car_work = 112 * t;
  m.n_records = records[Role::Mb];
  for (auto& body : m.body) body.quaternion[0] = 1;
  m.body[1].position[1] = 0.3 + Run::kBuckSpeed * t;
  m.body[1].velocity[1] = Run::kBuckSpeed;
  send(m, Role::Mb, k);
}

void Writer::fe(std::int64_t k, std::int64_t t_ns) {
  const double t = seconds(t_ns);
  if (k % 50 == 0) {
    msg::tissue_strain s{};
    s.t_ns = t_ns;
    s.n = 2;
    s.mps_95[0] = s.mps_95_so_far[0] = static_cast<float>(10 * t);
    send_record(s, Role::Fe);
  }
  msg::fe_done m{};
  m.window = k;
  m.t_ns = t_ns;
  m.n_bodies = 2;
  m.internal = 5 * t;
  m.kinetic = 20 * t;
  m.hourglass = 0.1 * t;
  m.external_work = 23.1 * t;
  m.interface_work = 2 * t;
  m.head_contact_force = t >= Run::kHeadContact - 1e-12 ? 2000 : 0;
  m.n_records = records[Role::Fe];
  m.work_us = 3000;
  for (int pass = 0; pass < run_.fe_passes; ++pass) send(m, Role::Fe, k * run_.fe_passes + pass);
  msg::coupling_audit a{};
  a.window = k;
  a.t_ns = t_ns;
  a.iterations = run_.fe_passes;
  a.work_mb = -2 * t;
  a.work_fe = 2 * t;
  a.exchanged = 2 * t;
  a.total_energy = 125 * t;
  a.external_work = 125 * t;
  send_record(a, Role::Coupler);
}

void Writer::window(std::int64_t k) {
  const std::int64_t t_ns = (k + 1) * Run::kWindowNs;
  head(t_ns);
  mb(k, t_ns);
  if (run_.has_fe) fe(k, t_ns);
}

void Writer::close() {
  if (batch_.n > 0) send_record(batch_, run_.has_fe ? Role::Fe : Role::Mb);
  msg::run_event e{};
  e.level = static_cast<std::int16_t>(EventLevel::Warning);
  e.t_ns = 5 * Run::kWindowNs;
  e.text = "a joint has failed";
  send_record(e, Role::Mb);
  msg::run_control c{};
  c.command = static_cast<int>(Command::Finish);
  c.window = Run::kWindows - 1;
  send(c, Role::Coupler, 0);
  for (const auto& [sender, count] : records) {
    msg::node_status s{};
    s.state = static_cast<int>(NodeState::Done);
    s.window = Run::kWindows - 1;
    s.n_records = count;
    send(s, sender, 0);
  }
}

}  // namespace

std::vector<RawMessage> SyntheticRun::messages() const {
  Writer writer(*this);
  writer.open();
  for (std::int64_t k = 0; k < kWindows; ++k) writer.window(k);
  writer.close();
  return writer.out;
}

}  // namespace crosswalk::recording
