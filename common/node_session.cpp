#include "common/node_session.h"

#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "common/log.h"
#include "crosswalk/msg/node_hello.hpp"

namespace crosswalk {

using namespace std::chrono_literals;

Heartbeat::Heartbeat(Bus& bus, std::function<msg::node_status()> status)
    : bus_(bus), status_(std::move(status)), thread_([this] {
        std::int64_t beats = 0;
        std::unique_lock lock(mutex_);
        while (!stop_) {
          bus_.publish(status_(), beats++);
          stop_signal_.wait_for(lock, 500ms, [this] { return stop_; });
        }
      }) {}

Heartbeat::~Heartbeat() {
  {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
  }
  stop_signal_.notify_all();
  thread_.join();
}

int resident_memory_mb() {
  std::ifstream statm("/proc/self/statm");
  std::int64_t total = 0, resident = 0;
  statm >> total >> resident;
  return static_cast<int>(resident * sysconf(_SC_PAGESIZE) >> 20);
}

NodeSession::NodeSession(Bus& bus, NodeIdentity identity, Limits limits,
                         std::filesystem::path checkpoints)
    : bus_(bus),
      identity_(std::move(identity)),
      limits_(limits),
      records_(bus),
      started_(Bus::Clock::now()),
      coupler_heard_(started_),
      checkpoints_(std::move(checkpoints)) {
  bus_.subscribe<msg::run_manifest>(Role::Coupler, [this](const msg::run_manifest& manifest) {
    if (manifest_ && !is_from_my_coupler(manifest.h)) return;  // one coupler per run
    if (!manifest_) {
      manifest_ = manifest;
      set_state(NodeState::Configuring, -1);
    }
    heard_coupler();
    on_manifest(*manifest_);
    heard_coupler();
  });
  bus_.subscribe<msg::run_control>(
      Role::Coupler, [this](const msg::run_control& control) { handle_control(control); });
  bus_.subscribe<msg::node_status>(Role::Coupler, [this](const msg::node_status& status) {
    if (is_from_my_coupler(status.h)) heard_coupler();
  });
  bus_.subscribe<msg::resend_request>(Role::Recorder, [this](const msg::resend_request& request) {
    if (request.role != static_cast<int>(bus_.role())) return;
    if (request.kind == 0) {
      records_.resend(request.first, request.last);
    } else {
      on_resend(request);
    }
  });
}

void NodeSession::on_control(const msg::run_control&) {}
void NodeSession::on_resend(const msg::resend_request&) {}
void NodeSession::on_tick(Bus::Clock::time_point) {}

void NodeSession::say_hello() {
  msg::node_hello hello{};
  hello.scenario_digest = identity_.scenario_digest;
  hello.message_digest = message_digest();
  hello.pid = getpid();
  hello.body_name = identity_.bodies;
  hello.n_bodies = static_cast<int>(identity_.bodies.size());
  hello.n_attached = identity_.n_attached;
  char host[64] = {};
  gethostname(host, sizeof host - 1);
  hello.host = host;
  hello.version = wire_text(identity_.version, 64);
  bus_.publish(hello, hellos_++);
}

void NodeSession::handle_control(const msg::run_control& control) {
  const auto command = static_cast<Command>(control.command);
  if (command == Command::Refuse) {
    if (control.target_instance == bus_.instance()) {
      leave(static_cast<ExitCode>(control.exit_code),
            "the coupler refused this node: " + control.text);
    }
    return;
  }
  if (!is_from_my_coupler(control.h)) return;
  heard_coupler();
  if (command == Command::Abort) {
    leave(ExitCode::NodeFailed, "the coupler ended the run: " + control.text);
  } else if (command == Command::Stop) {
    leave(ExitCode::Done);
  } else if (command == Command::Checkpoint && control.window <= checkpoint_) {
    // Written already. Said again, for the answer may have been lost; never written again, for this
    // may be an old message and the state a later one by now.
    bus_.publish(status(), -1);
  } else {
    if (command == Command::Finish && bus_.role() != Role::Recorder) {
      records_.flush();
      set_state(NodeState::Done, control.window);
      bus_.publish(status(), -1);  // the recorder waits for this; the heartbeat repeats it
    }
    on_control(control);
  }
}

void NodeSession::leave(ExitCode code, std::string reason) {
  if (outcome_) return;
  outcome_ = code;
  reason_ = std::move(reason);
}

void NodeSession::set_state(NodeState state, std::int64_t window) {
  if (state_ == static_cast<int>(NodeState::Done))
    return;  // for good: what comes now is a late copy
  state_ = static_cast<int>(state);
  window_ = window;
  if (manifest_ && window >= 0)
    set_log_time(1e-9 * static_cast<double>(window * manifest_->window_ns));
}

msg::node_status NodeSession::status() const {
  msg::node_status m{};
  m.state = state_;
  m.window = window_;
  m.progress = progress();
  m.n_records = records_.count();
  m.checkpoint = checkpoint_;
  m.dropped = bus_.dropped();
  m.rss_mb = resident_memory_mb();
  return m;
}

void NodeSession::write_checkpoint(CheckpointPart part) {
  records_.flush();
  part.n_records = records_.count();
  write_part(checkpoints_, bus_.role(), part);
  checkpoint_ = part.window;
  bus_.publish(status(), -1);
}

std::optional<CheckpointPart> NodeSession::part_to_continue_from() const {
  if (!manifest_ || manifest_->first_window == 0) return std::nullopt;
  return read_part(checkpoints_, bus_.role(), manifest_->first_window);
}

void NodeSession::tick(Bus::Clock::time_point now) {
  const auto seconds = [](Bus::Clock::duration d) {
    return std::chrono::duration<double>(d).count();
  };
  if (!manifest_) {
    if (now - hello_sent_ >= 100ms) {
      hello_sent_ = now;
      say_hello();
    }
    if (seconds(now - started_) > limits_.join_s) {
      leave(ExitCode::TimeOut,
            fmt::format(
                "no coupler answered for run '{}' within {:.0f} s; start the coupler with the "
                "same --run-id and --url, or give --wait-s",
                bus_.run_id(), limits_.join_s));
    }
  } else if (seconds(now - coupler_heard_) > limits_.coupler_silent_s) {
    leave(ExitCode::TimeOut,
          fmt::format("the coupler has been silent for {:.0f} s (last window {})",
                      limits_.coupler_silent_s, window_.load()));
  }
  on_tick(now);
}

ExitCode NodeSession::run(const std::atomic<bool>& interrupted) {
  const Heartbeat heartbeat(bus_, [this] { return status(); });
  while (!is_over()) {
    tick(Bus::Clock::now());
    bus_.wait_until(Bus::Clock::now() + 50ms);
    if (interrupted) leave(ExitCode::Interrupted, "interrupted");
  }
  if (*outcome_ == ExitCode::Done || *outcome_ == ExitCode::Interrupted) return *outcome_;
  throw ProtocolError(*outcome_, reason_);
}

}  // namespace crosswalk
