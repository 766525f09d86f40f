#include "coupler/hub.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "common/log.h"
#include "common/message_gate.h"
#include "common/node_session.h"
#include "crosswalk/msg/recorder_ack.hpp"
#include "crosswalk/msg/resend_request.hpp"
#include "crosswalk/msg/run_event.hpp"

namespace crosswalk::coupling {

using namespace std::chrono_literals;

namespace {

Bus::Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Bus::Clock::duration>(std::chrono::duration<double>(s));
}
double since(Bus::Clock::time_point t) {
  return std::chrono::duration<double>(Bus::Clock::now() - t).count();
}

// A process of this host that has gone, or is dead and not yet waited for; on other hosts only
// silence tells.
bool has_vanished(const msg::node_hello& hello) {
  char host[64] = {};
  gethostname(host, sizeof host - 1);
  if (hello.host != host) return false;
  std::ifstream stat(fmt::format("/proc/{}/stat", hello.pid));
  std::string text;
  if (!std::getline(stat, text)) return true;
  const std::size_t state = text.rfind(')') + 2;  // after "pid (name) "
  return state < text.size() && text[state] == 'Z';
}

}  // namespace

Hub::Hub(Bus& bus, RunPlan plan, Patience patience, const std::atomic<bool>& interrupted,
         std::function<void(EventLevel, const std::string&)> tell)
    : bus_(bus),
      plan_(std::move(plan)),
      patience_(patience),
      interrupted_(interrupted),
      tell_(std::move(tell)),
      records_(bus) {
  bus_.subscribe_any_sender<msg::run_control>([this](const msg::run_control& m) {
    const auto command = static_cast<Command>(m.command);
    const bool is_coupler = m.h.sender == static_cast<int>(Role::Coupler);
    if (is_coupler && command == Command::Claim && holds_run_) control(Command::Present, window_);
    if (is_coupler && command == Command::Present && !holds_run_) other_coupler_ = true;
    if (!is_coupler && command == Command::Stop) stop_asked_ = true;
    if (!is_coupler && command == Command::WantManifest && holds_run_) send_manifest();
  });
  for (const Role role : {Role::Mb, Role::Fe, Role::Recorder}) {
    peer(role).role = role;
    bus_.subscribe<msg::node_hello>(
        role, [this, role](const msg::node_hello& m) { hear_hello(role, m); });
    bus_.subscribe<msg::node_status>(
        role, [this, role](const msg::node_status& m) { hear_status(role, m); });
    bus_.subscribe<msg::run_event>(role, [this, role](const msg::run_event& m) {
      if (!is_from(peer(role), m.h)) return;
      if (m.level == static_cast<int>(EventLevel::Error)) peer(role).last_error = m.text;
      tell_(static_cast<EventLevel>(m.level), fmt::format("{}: {}", role_name(role), m.text));
    });
  }
  bus_.subscribe<msg::boundary_motion>(Role::Mb, [this](const msg::boundary_motion& m) {
    if (!is_from(peer(Role::Mb), m.h) || has_motion_) return;
    if (m.n_bodies != static_cast<int>(bodies_.size())) return;
    if (const auto problem = problem_in(m)) {
      throw ProtocolError(ExitCode::NumericalLimit, "mb_node, initial motion: " + *problem);
    }
    read_motion(m, bodies_);
    has_motion_ = true;
  });
  for (const Role role : {Role::Mb, Role::Fe}) {
    bus_.subscribe<msg::boundary_mass>(role, [this, role](const msg::boundary_mass& m) {
      if (!is_from(peer(role), m.h) || m.n_bodies != static_cast<int>(bodies_.size())) return;
      if (const auto problem = problem_in(m)) {
        throw ProtocolError(ExitCode::NumericalLimit,
                            fmt::format("{}, block masses: {}", role_name(role), *problem));
      }
      if (role == Role::Fe && !peer(role).answered_set_up) read_mass(m, bodies_);
      peer(role).answered_set_up = true;
    });
  }
  bus_.subscribe<msg::resend_request>(Role::Recorder, [this](const msg::resend_request& m) {
    if (!is_from(peer(Role::Recorder), m.h) || m.role != static_cast<int>(bus_.role())) return;
    if (m.kind == 0) records_.resend(m.first, m.last);
  });
  bus_.subscribe<msg::recorder_ack>(Role::Recorder, [this](const msg::recorder_ack& m) {
    if (!is_from(peer(Role::Recorder), m.h)) return;
    acknowledged_ = std::max(acknowledged_, m.window);
  });
}

std::vector<Role> Hub::required() const {
  std::vector<Role> roles = {Role::Mb};
  if (plan_.has_fe) roles.push_back(Role::Fe);
  if (plan_.has_recorder) roles.push_back(Role::Recorder);
  return roles;
}

void Hub::control(Command command, std::int64_t window, const std::string& text, ExitCode code,
                  int target) {
  msg::run_control m{};
  m.command = static_cast<int>(command);
  m.target_instance = target;
  m.exit_code = static_cast<int>(code);
  m.window = window;
  m.text = wire_text(text);
  bus_.publish(m, controls_++);
}

void Hub::claim() {
  for (int i = 0; i < 3 && !other_coupler_; ++i) {
    control(Command::Claim, -1);
    bus_.wait_until(Bus::Clock::now() + seconds(patience_.claim_s),
                    [this] { return other_coupler_ || interrupted_; });
  }
  if (other_coupler_) {
    throw ProtocolError(
        ExitCode::CouplerPresent,
        fmt::format("another coupler already leads run '{}'; choose another --run-id",
                    bus_.run_id()));
  }
  holds_run_ = true;
}

std::string Hub::why_not(Role role, const msg::node_hello& hello) const {
  if (hello.h.protocol != kProtocolVersion) {
    return fmt::format("protocol version {} does not fit the coupler's {}", hello.h.protocol,
                       kProtocolVersion);
  }
  if (hello.message_digest != message_digest()) {
    return fmt::format(
        "message types {:016x} (version {}) differ from the coupler's {:016x} (version {})",
        static_cast<std::uint64_t>(hello.message_digest), hello.version,
        static_cast<std::uint64_t>(message_digest()), plan_.version);
  }
  if (hello.scenario_digest != plan_.scenario_digest) {
    return fmt::format(
        "scenario digest {:016x} differs from the coupler's {:016x}: give every process the "
        "same resolved scenario file",
        static_cast<std::uint64_t>(hello.scenario_digest),
        static_cast<std::uint64_t>(plan_.scenario_digest));
  }
  const Role other = role == Role::Mb ? Role::Fe : Role::Mb;
  const Peer& mate = peers_[static_cast<std::size_t>(other)];
  const bool has_bodies = role == Role::Mb || role == Role::Fe;
  if (has_bodies && mate.has_joined && mate.hello.body_name != hello.body_name) {
    return fmt::format("its interface bodies [{}] are not those of {} [{}]",
                       fmt::join(hello.body_name, ", "), role_name(other),
                       fmt::join(mate.hello.body_name, ", "));
  }
  return {};
}

void Hub::refuse(const msg::node_hello& hello, ExitCode code, const std::string& why) {
  tell_(EventLevel::Warning,
        fmt::format("{} (pid {} on {}) refused: {}", role_name(static_cast<Role>(hello.h.sender)),
                    hello.pid, wire_text(hello.host, 64), why));
  control(Command::Refuse, -1, why, code, hello.h.instance);
}

void Hub::hear_hello(Role role, const msg::node_hello& hello) {
  Peer& node = peer(role);
  if (node.has_joined) {
    if (hello.h.instance != node.hello.h.instance) {
      refuse(hello, ExitCode::RoleTaken,
             fmt::format("this run already has a {} (pid {} on {})", role_name(role),
                         node.hello.pid, wire_text(node.hello.host, 64)));
    } else if (state_ != static_cast<int>(NodeState::Joining)) {
      send_manifest();  // it has missed the manifest
    }
    return;
  }
  if (const std::string why = why_not(role, hello); !why.empty()) {
    refuse(hello, ExitCode::VersionMismatch, why);
    throw ProtocolError(ExitCode::VersionMismatch,
                        fmt::format("{} cannot join: {}", role_name(role), why));
  }
  node.hello = hello;
  node.has_joined = true;
  node.heard = node.progressed = Bus::Clock::now();
}

void Hub::hear_status(Role role, const msg::node_status& status) {
  Peer& node = peer(role);
  if (!is_from(node, status.h)) return;
  node.heard = Bus::Clock::now();
  const bool progressed = status.progress != node.status.progress ||
                          status.window != node.status.window || status.state != node.status.state;
  if (progressed) node.progressed = node.heard;
  node.status = status;
}

void Hub::send_manifest() {
  msg::run_manifest m{};
  m.scenario_digest = plan_.scenario_digest;
  m.window_ns = plan_.window_ns;
  m.duration_ns = plan_.duration_ns;
  m.first_window = plan_.first_window;
  m.scheme = plan_.scheme;
  m.has_fe = plan_.has_fe ? 1 : 0;
  m.n_bodies = static_cast<int>(bodies_.size());
  m.n_attached = n_attached_;
  for (const InterfaceBody& body : bodies_) m.body_name.push_back(body.name);
  m.run_id = wire_text(bus_.run_id(), 64);
  m.scenario_name = wire_text(plan_.scenario_name, 64);
  bus_.publish(m, manifests_++);
}

void Hub::watch(Role role, const std::string& what, double waited_s) {
  const Peer& node = peer(role);
  if (!node.has_joined) return;
  const auto fail = [&](ExitCode code, const std::string& how) {
    const std::string why = node.last_error.empty() ? "" : ": " + node.last_error;
    throw ProtocolError(code, fmt::format("{} {} during {}{}", role_name(role), how, what, why));
  };
  if (has_vanished(node.hello))
    fail(ExitCode::NodeFailed, fmt::format("(pid {}) has died", node.hello.pid));
  if (since(node.heard) > patience_.silent_s) {
    fail(ExitCode::TimeOut, fmt::format("has been silent for {:.0f} s", patience_.silent_s));
  }
  if (waited_s > patience_.stalled_s && since(node.progressed) > patience_.stalled_s) {
    fail(ExitCode::TimeOut,
         fmt::format("is alive but has not advanced for {:.0f} s", patience_.stalled_s));
  }
}

void Hub::set_window(std::int64_t window) {
  window_ = window;
  set_log_time(1e-9 * static_cast<double>(window * plan_.window_ns));
}

void Hub::wait_for(const std::vector<Role>& whom, const std::string& what,
                   const std::function<bool()>& done, const std::function<void()>& again,
                   double first_resend_s) {
  const auto stop_when_asked = [&] {
    if (interrupted_ || stop_asked_)
      throw ProtocolError(ExitCode::Interrupted, fmt::format("stopped on request during {}", what));
  };
  stop_when_asked();  // answers may come faster than the loop below would look
  if (bus_.wait_until(Bus::Clock::now(), done)) return;
  const auto begin = Bus::Clock::now();
  double time_out = first_resend_s;
  auto resend_at = begin + seconds(time_out);
  auto watch_at = begin + 250ms;
  bool told = false;
  while (!bus_.wait_until(std::min(resend_at, watch_at), done)) {
    stop_when_asked();
    const auto now = Bus::Clock::now();
    if (now >= watch_at) {
      for (const Role role : whom) watch(role, what, since(begin));
      watch_at = now + 250ms;
      if (!told && since(begin) > 20) {
        told = true;
        for (const Role role : whom) {
          tell_(EventLevel::Warning,
                fmt::format("waiting for {} during {}, last sign of life {:.1f} s ago, "
                            "progress {}",
                            role_name(role), what, since(peer(role).heard),
                            peer(role).status.progress));
        }
      }
    }
    if (now >= resend_at) {
      again();
      ++resends_;
      time_out = std::min(patience_.longest_resend_s, 2 * time_out);
      resend_at = now + seconds(time_out);
    }
  }
}

std::vector<InterfaceBody> Hub::gather() {
  const auto begin = Bus::Clock::now();
  const auto missing = [this] {
    std::vector<std::string_view> names;
    for (const Role role : required()) {
      if (!peer(role).has_joined) names.push_back(role_name(role));
    }
    return names;
  };
  wait_for(
      required(), "joining", [&] { return missing().empty(); },
      [&] {
        if (since(begin) > patience_.join_s) {
          throw ProtocolError(ExitCode::TimeOut,
                              fmt::format("never joined within {:.0f} s: {}", patience_.join_s,
                                          fmt::join(missing(), ", ")));
        }
      },
      0.5);
  for (const std::string& name : peer(Role::Mb).hello.body_name) {
    bodies_.push_back({.name = name, .motion = {}, .block = {}});
  }
  n_attached_ = plan_.has_fe ? peer(Role::Fe).hello.n_attached : 0;
  for (int k = 0; k < n_attached_; ++k) bodies_[static_cast<std::size_t>(k)].is_attached = true;
  resends_ = 0;

  state_ = static_cast<int>(NodeState::Configuring);
  send_manifest();
  wait_for(
      {Role::Mb}, "set-up (initial motion)", [this] { return has_motion_; },
      [this] { send_manifest(); }, 0.2);
  if (plan_.has_fe) {
    const auto send_motion = [this] { bus_.publish(motion_message(bodies_), 0); };
    send_motion();
    wait_for(
        {Role::Fe}, "set-up (building the finite-element model)",
        [this] { return peer(Role::Fe).answered_set_up; }, send_motion, 0.5);
    const auto send_mass = [this] { bus_.publish(mass_message(bodies_), 0); };
    send_mass();
    wait_for(
        {Role::Mb}, "set-up (taking over block masses)",
        [this] { return peer(Role::Mb).answered_set_up; }, send_mass, 0.2);
  }
  if (plan_.has_recorder) {
    wait_for(
        {Role::Recorder}, "set-up (opening the log)", [this] { return acknowledged_ >= -1; },
        [this] { send_manifest(); }, 0.2);
  }
  resends_ = 0;
  return bodies_;
}

void Hub::start() {
  state_ = static_cast<int>(NodeState::Solving);
  control(Command::Start, 0);
}

void Hub::follow_recorder(std::int64_t window) {
  if (!plan_.has_recorder || window - acknowledged_ <= kMaxWindowsAhead) return;
  // Our own status tells the recorder how many records there are, should it have missed the last.
  wait_for(
      {Role::Recorder}, fmt::format("window {} (writing the log)", window),
      [&] { return window - acknowledged_ <= kMaxWindowsAhead; },
      [this] { bus_.publish(status(), 0); }, patience_.first_resend_s);
}

void Hub::checkpoint(std::int64_t window) {
  const std::string what = fmt::format("window {} (checkpoint)", window);
  if (plan_.has_recorder) {
    wait_for(
        {Role::Recorder}, what, [&] { return acknowledged_ >= window - 1; },
        [this] { bus_.publish(status(), 0); }, patience_.first_resend_s);
  }
  const std::vector<Role> nodes = required();
  const auto all_written = [&] {
    return std::ranges::all_of(nodes,
                               [&](Role role) { return peer(role).status.checkpoint == window; });
  };
  const auto ask = [&] { control(Command::Checkpoint, window); };
  ask();
  wait_for(nodes, what, all_written, ask, 0.5);
}

bool Hub::finish(std::int64_t last_window) {
  state_ = static_cast<int>(NodeState::Done);
  bool is_complete = true;
  const auto end_run = [&] {
    control(Command::Finish, last_window);
    bus_.publish(status(), 0);
  };
  end_run();
  if (plan_.has_recorder) {
    const auto is_done = [this] {
      return peer(Role::Recorder).status.state == static_cast<int>(NodeState::Done);
    };
    try {
      wait_for({Role::Recorder}, "completing the record", is_done, end_run, 0.2);
    } catch (const ProtocolError& error) {
      if (error.code() == ExitCode::Interrupted) throw;
      tell_(EventLevel::Error, error.what());
      is_complete = false;
    }
  }
  for (int i = 0; i < 3; ++i) {
    control(Command::Stop, last_window);
    bus_.wait_until(Bus::Clock::now() + 20ms, [] { return false; });
  }
  return is_complete;
}

void Hub::abort(std::int64_t window, const std::string& reason) {
  if (!holds_run_) return;
  state_ = static_cast<int>(NodeState::Failed);
  records_.event(window * plan_.window_ns, EventLevel::Error, reason);
  for (int i = 0; i < 3; ++i) {
    control(Command::Abort, window, reason, ExitCode::NodeFailed);
    bus_.wait_until(Bus::Clock::now() + 20ms, [] { return false; });
  }
}

msg::node_status Hub::status() const {
  msg::node_status m{};
  m.state = state_;
  m.window = window_;
  m.progress = window_;
  m.n_records = records_.count();
  m.dropped = bus_.dropped();
  m.rss_mb = resident_memory_mb();
  return m;
}

}  // namespace crosswalk::coupling
