#include "recorder/run_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "common/error.h"
#include "common/messages.h"
#include "recorder/log_file.h"
#include "recorder/message_decode.h"

namespace crosswalk::recording {

std::string Manifest::mode() const {
  if (!has_fe) return "multibody";
  if (!has_head_alone()) return "coupled";
  return n_attached > 0 ? "prescribed" : "impact_only";
}

std::string Manifest::scheme_name() const {
  constexpr const char* kNames[] = {"mic", "implicit", "staggered"};
  return scheme >= 0 && scheme < 3 ? kNames[scheme] : "unknown";
}

bool Numbers::add(std::int64_t seq) {
  if (seq < complete_ || ahead_.count(seq) != 0) return false;
  if (seq != complete_) {
    ahead_[seq] = true;
    return true;
  }
  ++complete_;
  while (!ahead_.empty() && ahead_.begin()->first == complete_) {
    ahead_.erase(ahead_.begin());
    ++complete_;
  }
  return true;
}

std::vector<std::pair<std::int64_t, std::int64_t>> Numbers::missing(std::int64_t end,
                                                                    std::size_t most) const {
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges;
  std::int64_t next = complete_;
  for (const auto& [seq, come] : ahead_) {
    if (ranges.size() == most || seq >= end) break;
    if (seq > next) ranges.emplace_back(next, seq - 1);
    next = seq + 1;
  }
  if (ranges.size() < most && next < end) ranges.emplace_back(next, end - 1);
  return ranges;
}

namespace {

constexpr std::size_t kBodiesPerSlice = 32;

/// Pieces of one node's description.
struct Pieces {
  std::map<int, std::string> part;
  int count = 0;
};

/// Slices of the body states of one instant.
struct Slices {
  std::vector<Pose> pose;
  std::set<int> first;
  int filled = 0;
};

template <std::size_t N>
double largest(const float (&values)[N], int n) {
  double peak = 0;
  for (int i = 0; i < std::min<int>(n, N); ++i) {
    peak = std::max(peak, std::abs(static_cast<double>(values[i])));
  }
  return peak;
}

}  // namespace

struct RecordBuilder::Impl {
  RunRecord record;
  std::optional<std::int64_t> run;
  std::vector<std::pair<std::vector<std::byte>, std::int64_t>> early;  // before the manifest
  std::map<Role, Pieces> pieces;
  std::map<std::int64_t, Slices> slices;
  std::map<Role, Numbers> numbers;  // record streams
  std::map<Role, std::map<std::int64_t, HeadSample>> head;
  std::map<std::pair<Role, std::int64_t>, Event> events;
  std::map<Role, std::int64_t> announced;  // records a sender says it has published

  bool is_new_record(const msg::header& h) {
    if (numbers[static_cast<Role>(h.sender)].add(h.seq)) return true;
    ++record.doubled;
    return false;
  }
  void announce(const msg::header& h, std::int64_t count) {
    std::int64_t& known = announced[static_cast<Role>(h.sender)];
    known = std::max(known, count);
  }

  void take(const msg::run_manifest& m);
  void take(const msg::head_kinematics& m);
  void take(const msg::body_states& m);
  void take(const msg::contact_forces& m);
  void take(const msg::tissue_strain& m);
  void take(const msg::node_description& m);
  void take(const msg::run_event& m);
  void take(const msg::coupling_audit& m);
  void take(const msg::mb_done& m);
  void take(const msg::fe_done& m);
  void take(const msg::run_control& m);
  void take(const msg::node_status& m) { announce(m.h, m.n_records); }

  void decode(std::span<const std::byte> data, std::int64_t arrival_us);
};

void RecordBuilder::Impl::take(const msg::run_manifest& m) {
  Manifest out;
  out.scenario_digest = m.scenario_digest;
  out.window_ns = m.window_ns;
  out.duration_ns = m.duration_ns;
  out.scheme = m.scheme;
  out.has_fe = m.has_fe != 0;
  out.n_attached = m.n_attached;
  out.bodies = m.body_name;
  out.run_id = m.run_id;
  out.scenario = m.scenario_name;
  record.manifest = out;
}

void RecordBuilder::Impl::take(const msg::head_kinematics& m) {
  if (!is_new_record(m.h)) return;
  auto& samples = head[static_cast<Role>(m.h.sender)];
  for (int i = 0; i < std::clamp<int>(m.n, 0, 6); ++i) {
    samples[m.sample[i].t_ns] = from_message(m.sample[i]);
  }
}

void RecordBuilder::Impl::take(const msg::body_states& m) {
  if (!is_new_record(m.h) || m.n_total <= 0 || m.n_total > 1000 || m.first < 0) return;
  Slices& s = slices[m.t_ns];
  s.pose.resize(static_cast<std::size_t>(m.n_total));
  if (!s.first.insert(m.first).second) return;
  const int n = std::min({m.n, static_cast<int>(kBodiesPerSlice), m.n_total - m.first});
  for (int i = 0; i < n; ++i) {
    Pose& X = s.pose[static_cast<std::size_t>(m.first + i)];
    X.p = Eigen::Map<const Eigen::Vector3f>(m.position[i]).cast<double>();
    X.q = Quat(static_cast<double>(m.quaternion[i][0]), static_cast<double>(m.quaternion[i][1]),
               static_cast<double>(m.quaternion[i][2]), static_cast<double>(m.quaternion[i][3]))
              .normalized();
    ++s.filled;
  }
  if (s.filled == m.n_total) {
    record.bodies[m.t_ns] = std::move(s.pose);
    slices.erase(m.t_ns);
  }
}

void RecordBuilder::Impl::take(const msg::contact_forces& m) {
  if (!is_new_record(m.h)) return;
  std::vector<Vec3> forces;
  for (int i = 0; i < std::clamp<int>(m.n, 0, 24); ++i) {
    forces.push_back(Eigen::Map<const Eigen::Vector3f>(m.force[i]).cast<double>());
  }
  record.contact[m.t_ns] = std::move(forces);
}

void RecordBuilder::Impl::take(const msg::tissue_strain& m) {
  if (!is_new_record(m.h)) return;
  TissueSample sample;
  sample.t_ns = m.t_ns;
  for (int i = 0; i < std::clamp<int>(m.n, 0, 12); ++i) {
    TissueSample::Region r;
    r.mps_max = static_cast<double>(m.mps_max[i]);
    r.mps_95 = static_cast<double>(m.mps_95[i]);
    r.mps_95_so_far = static_cast<double>(m.mps_95_so_far[i]);
    r.csdm_15 = static_cast<double>(m.csdm_15[i]);
    r.csdm_25 = static_cast<double>(m.csdm_25[i]);
    r.pressure_min = static_cast<double>(m.pressure_min[i]);
    r.pressure_max = static_cast<double>(m.pressure_max[i]);
    r.von_mises_95 = static_cast<double>(m.von_mises_95[i]);
    r.inside_out = static_cast<double>(m.inside_out[i]);
    sample.regions.push_back(r);
  }
  record.tissue[m.t_ns] = std::move(sample);
}

void RecordBuilder::Impl::take(const msg::node_description& m) {
  if (!is_new_record(m.h)) return;
  const auto sender = static_cast<Role>(m.h.sender);
  Pieces& p = pieces[sender];
  p.count = m.n_parts;
  p.part[m.part] = m.text;
  if (static_cast<int>(p.part.size()) != p.count) return;
  std::string& whole = record.description[sender];
  whole.clear();
  for (const auto& [index, text] : p.part) whole += text;
}

void RecordBuilder::Impl::take(const msg::run_event& m) {
  if (!is_new_record(m.h)) return;
  const auto sender = static_cast<Role>(m.h.sender);
  events[{sender, m.h.seq}] = {sender, m.h.seq, m.t_ns, static_cast<EventLevel>(m.level),
                               m.code, m.text};
}

void RecordBuilder::Impl::take(const msg::coupling_audit& m) {
  if (!is_new_record(m.h)) return;
  const int n = record.manifest ? static_cast<int>(record.manifest->bodies.size()) : 0;
  AuditWindow a;
  a.t_ns = m.t_ns;
  a.iterations = m.iterations;
  a.resends = m.resends;
  a.wall_us = m.wall_us;
  a.residual = m.residual;
  a.work_mb = m.work_mb;
  a.work_fe = m.work_fe;
  a.exchanged = m.exchanged;
  a.drift = m.drift;
  a.total_energy = m.total_energy;
  a.external_work = m.external_work;
  a.balance_error = m.balance_error;
  a.gap_position = largest(m.gap_position, n);
  a.gap_rotation = largest(m.gap_rotation, n);
  a.velocity_mismatch = largest(m.velocity_mismatch, n);
  a.owed_force = largest(m.owed_force, n);
  a.owed_moment = largest(m.owed_moment, n);
  record.audit[m.window] = a;
}

void RecordBuilder::Impl::take(const msg::mb_done& m) {
  announce(m.h, m.n_records);
  MbWindow& w = record.mb[m.window];
  if (m.h.seq <= w.seq) {
    ++record.doubled;
    return;
  }
  const MbReply reply = from_message(m);
  w = {.t_ns = m.t_ns,
       .seq = m.h.seq,
       .substeps = m.substeps,
       .work_us = w.work_us + m.work_us,  // of all passes of an implicit window
       .contacts = m.n_contacts,
       .energy = reply.energy,
       .bodies = reply.bodies};
}

void RecordBuilder::Impl::take(const msg::fe_done& m) {
  announce(m.h, m.n_records);
  FeWindow& w = record.fe[m.window];
  if (m.h.seq <= w.seq) {
    ++record.doubled;
    return;
  }
  w = {.t_ns = m.t_ns,
       .seq = m.h.seq,
       .substeps = m.substeps,
       .work_us = w.work_us + m.work_us,  // of all passes of an implicit window
       .stable_step = m.stable_step,
       .kinetic = m.kinetic,
       .internal = m.internal,
       .hourglass = m.hourglass,
       .contact = m.contact,
       .damping = m.damping,
       .external_work = m.external_work,
       .interface_work = m.interface_work,
       .added_mass = m.added_mass,
       .head_contact_force = m.head_contact_force};
}

void RecordBuilder::Impl::take(const msg::run_control& m) {
  if (m.h.sender != static_cast<int>(Role::Coupler)) return;
  const auto command = static_cast<Command>(m.command);
  if (command == Command::Abort) record.abort_reason = m.text;
  if (command == Command::Finish) record.is_finished = true;
}

void RecordBuilder::Impl::decode(std::span<const std::byte> data, std::int64_t arrival_us) {
  const std::optional<msg::header> h = peek_header(data);
  if (!h) {
    ++record.unreadable;
    return;
  }
  if (!run && h->kind == static_cast<int>(MessageKind::RunManifest)) {
    run = h->run_id;
    const auto waiting = std::move(early);
    early.clear();
    for (const auto& [bytes, time] : waiting) decode(bytes, time);
  }
  if (!run) {
    early.emplace_back(std::vector<std::byte>(data.begin(), data.end()), arrival_us);
    return;
  }
  if (h->run_id != *run) {
    ++record.foreign;
    return;
  }
  ++record.messages;
  if (record.first_us == 0) record.first_us = arrival_us;
  record.last_us = arrival_us;
  const auto handler = [this](const auto& message) { take(message); };
  if (!with_decoded(static_cast<MessageKind>(h->kind), data, handler)) ++record.unreadable;
}

RecordBuilder::RecordBuilder() : impl_(std::make_unique<Impl>()) {}
RecordBuilder::~RecordBuilder() = default;
RecordBuilder::RecordBuilder(RecordBuilder&&) noexcept = default;
RecordBuilder& RecordBuilder::operator=(RecordBuilder&&) noexcept = default;

void RecordBuilder::add(std::span<const std::byte> data, std::int64_t arrival_us) {
  impl_->decode(data, arrival_us);
}

RunRecord RecordBuilder::record() const {
  RunRecord out = impl_->record;
  // The node that owns the head: fe_node when it takes part.
  if (!impl_->head.empty()) out.head = impl_->head.rbegin()->second;
  for (const auto& [key, event] : impl_->events) out.events.push_back(event);
  for (const auto& [sender, count] : impl_->announced) {
    const auto found = impl_->numbers.find(sender);
    const Numbers none;
    const Numbers& come = found == impl_->numbers.end() ? none : found->second;
    for (const auto& [first, last] : come.missing(count, 1000)) out.lost += last - first + 1;
  }
  return out;
}

RunRecord read_run_record(const std::filesystem::path& log) {
  RecordBuilder builder;
  read_log(log, [&builder](const LogEvent& event) { builder.add(event.data, event.time_us); });
  RunRecord record = builder.record();
  if (!record.manifest) {
    Problem problem;
    problem.place.file = log.string();
    problem.what = "message log";
    problem.expected = "the messages of a Crosswalk run, its manifest among them";
    problem.found = "none";
    throw UserError(problem);
  }
  return record;
}

}  // namespace crosswalk::recording
