// A process's part in the life of a run, whatever its role: it offers itself until the coupler
// answers with the manifest, obeys that coupler only, shows signs of life, and leaves when told or
// when the coupler has gone. docs/messages.md draws the states.
//
// Event driven: the work happens in handlers called from wait(), so several sessions can share one
// in-memory transport in a test.
#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/bus.h"
#include "common/checkpoint.h"
#include "common/error.h"
#include "common/record_stream.h"
#include "crosswalk/msg/node_status.hpp"
#include "crosswalk/msg/resend_request.hpp"
#include "crosswalk/msg/run_control.hpp"
#include "crosswalk/msg/run_manifest.hpp"

namespace crosswalk {

/// What a node says of itself when it joins; all nodes of a run must agree.
struct NodeIdentity {
  std::int64_t scenario_digest = 0;
  std::string version;
  std::vector<std::string> bodies;  ///< interface bodies, attached ones first
  int n_attached = 0;
};

/// Publishes a status twice a second from its own thread.
class Heartbeat {
 public:
  Heartbeat(Bus& bus, std::function<msg::node_status()> status);
  ~Heartbeat();

 private:
  Bus& bus_;
  std::function<msg::node_status()> status_;
  std::mutex mutex_;
  std::condition_variable stop_signal_;
  bool stop_ = false;
  std::thread thread_;
};

class NodeSession {
 public:
  struct Limits {
    double join_s = 60;            ///< without a coupler's manifest
    double coupler_silent_s = 15;  ///< without a sign of the coupler while waiting for it
  };

  /// `checkpoints`: folder for this process's parts; empty: it writes none.
  NodeSession(Bus& bus, NodeIdentity identity, Limits limits,
              std::filesystem::path checkpoints = {});
  virtual ~NodeSession() = default;
  NodeSession(const NodeSession&) = delete;
  NodeSession& operator=(const NodeSession&) = delete;

  /// Takes part until the run ends. Returns Done, or throws ProtocolError with the reason.
  /// `interrupted` is polled; when it turns true the session leaves with ExitCode::Interrupted.
  ExitCode run(const std::atomic<bool>& interrupted);
  /// Repeats the hello while unanswered, and looks at the clock; called by run().
  void tick(Bus::Clock::time_point now);

  bool is_over() const { return outcome_.has_value(); }
  RecordStream& records() { return records_; }
  const std::optional<msg::run_manifest>& manifest() const { return manifest_; }

 protected:
  /// The first manifest, and each repetition of it.
  virtual void on_manifest(const msg::run_manifest& manifest) = 0;
  /// Start, Finish, Checkpoint from the run's coupler (Refuse, Abort and Stop are dealt with here).
  /// On Finish the records are complete and the state is Done before this is called.
  virtual void on_control(const msg::run_control& control);
  /// Messages lost by the recorder: a stream other than the records.
  virtual void on_resend(const msg::resend_request& request);
  /// Work of the subclass between messages, at least every 50 ms.
  virtual void on_tick(Bus::Clock::time_point now);
  /// Substeps done, for the heartbeat; any thread.
  virtual std::int64_t progress() const { return 0; }

  bool is_from_my_coupler(const msg::header& h) const {
    return manifest_ && h.instance == manifest_->h.instance;
  }
  /// Restarts the clock of the coupler's silence; call after long work.
  void heard_coupler() { coupler_heard_ = Bus::Clock::now(); }
  void leave(ExitCode code, std::string reason = {});
  void set_state(NodeState state, std::int64_t window);
  /// Writes this process's part of the checkpoint, once, and tells so.
  void write_checkpoint(CheckpointPart part);
  /// The part of the checkpoint the manifest asks to continue from; nothing for a fresh run.
  std::optional<CheckpointPart> part_to_continue_from() const;

  Bus& bus_;

 private:
  msg::node_status status() const;
  void say_hello();
  void handle_control(const msg::run_control& control);

  NodeIdentity identity_;
  Limits limits_;
  RecordStream records_;
  std::optional<msg::run_manifest> manifest_;
  std::optional<ExitCode> outcome_;
  std::string reason_;
  Bus::Clock::time_point started_, hello_sent_{}, coupler_heard_;
  std::int64_t hellos_ = 0;
  std::atomic<int> state_{static_cast<int>(NodeState::Joining)};
  std::atomic<std::int64_t> window_{-1};
  std::filesystem::path checkpoints_;
  std::atomic<std::int64_t> checkpoint_{-1};
};

/// Resident memory of this process in MB.
int resident_memory_mb();

}  // namespace crosswalk
