// The coupler's side of a run's life: claim the run, gather and configure the nodes, exchange
// windows with them, follow the recorder, end the run. docs/messages.md draws the states.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/error.h"
#include "common/record_stream.h"
#include "coupler/participant_link.h"
#include "crosswalk/msg/node_hello.hpp"
#include "crosswalk/msg/node_status.hpp"
#include "crosswalk/msg/run_control.hpp"
#include "crosswalk/msg/run_manifest.hpp"

namespace crosswalk::coupling {

struct RunPlan {
  std::string scenario_name;
  std::int64_t scenario_digest = 0;
  std::string version;
  bool has_fe = true;
  bool has_recorder = true;
  int scheme = 0;
  std::int64_t window_ns = 20000;
  std::int64_t duration_ns = 0;   ///< from first contact
  std::int64_t first_window = 0;  ///< > 0: continue from this checkpoint
};

struct Patience {
  double claim_s = 0.1;    ///< between the three claims
  double join_s = 300;     ///< until every role has said hello
  double silent_s = 15;    ///< without a heartbeat
  double stalled_s = 120;  ///< heartbeats, but no progress in an unanswered window
  double first_resend_s = 0.05;
  double longest_resend_s = 2;
};

/// What the coupler knows of one node of the run.
struct Peer {
  Role role = Role::Tool;
  msg::node_hello hello{};
  msg::node_status status{};
  bool has_joined = false;
  bool answered_set_up = false;
  Bus::Clock::time_point heard{}, progressed{};
  std::string last_error;  ///< text of its last error event
};

class Hub {
 public:
  /// `tell` receives news for the user; `interrupted` is polled while waiting.
  Hub(Bus& bus, RunPlan plan, Patience patience, const std::atomic<bool>& interrupted,
      std::function<void(EventLevel, const std::string&)> tell);

  /// Throws ProtocolError{CouplerPresent} when another coupler holds this run.
  void claim();
  /// Gathers the nodes and exchanges the interface bodies' motion and block masses.
  /// Returns the bodies with both; throws ProtocolError naming who is missing or does not fit.
  std::vector<InterfaceBody> gather();
  void start();
  /// Blocks while the recorder is more than kMaxWindowsAhead behind.
  void follow_recorder(std::int64_t window);
  /// Has every node write its part for `window`, the next to do, when all before it is on record.
  void checkpoint(std::int64_t window);
  /// Ends the run in order. False when the record could not be completed in time.
  bool finish(std::int64_t last_window);
  void abort(std::int64_t window, const std::string& reason);

  Bus& bus() { return bus_; }
  RecordStream& records() { return records_; }
  const RecordStream& records() const { return records_; }
  const Patience& patience() const { return patience_; }
  int n_attached() const { return n_attached_; }
  Peer& peer(Role role) { return peers_[static_cast<std::size_t>(role)]; }
  bool is_from(const Peer& node, const msg::header& h) const {
    return node.has_joined && h.instance == node.hello.h.instance;
  }
  /// Handles messages until done() holds; meanwhile watches the nodes in `whom`, calls `again`
  /// whenever the resend time-out passes, and throws ProtocolError when the run cannot go on.
  void wait_for(const std::vector<Role>& whom, const std::string& what,
                const std::function<bool()>& done, const std::function<void()>& again,
                double first_resend_s);
  msg::node_status status() const;
  /// The window about to be done; also the time stamp of the log.
  void set_window(std::int64_t window);
  int resends() const { return resends_; }

 private:
  std::vector<Role> required() const;
  void hear_hello(Role role, const msg::node_hello& hello);
  std::string why_not(Role role, const msg::node_hello& hello) const;
  void refuse(const msg::node_hello& hello, ExitCode code, const std::string& why);
  void hear_status(Role role, const msg::node_status& status);
  void send_manifest();
  void control(Command command, std::int64_t window, const std::string& text = {},
               ExitCode code = ExitCode::Done, int target = 0);
  void watch(Role role, const std::string& what, double waited_s);

  Bus& bus_;
  RunPlan plan_;
  Patience patience_;
  const std::atomic<bool>& interrupted_;
  std::function<void(EventLevel, const std::string&)> tell_;
  RecordStream records_;
  std::array<Peer, 7> peers_;
  std::vector<InterfaceBody> bodies_;
  int n_attached_ = 0;
  bool has_motion_ = false;
  std::int64_t acknowledged_ = -2;  ///< by the recorder
  bool other_coupler_ = false, holds_run_ = false, stop_asked_ = false;
  std::int64_t controls_ = 0, manifests_ = 0;
  int resends_ = 0;
  std::atomic<std::int64_t> window_{-1};
  std::atomic<int> state_{static_cast<int>(NodeState::Joining)};
};

}  // namespace crosswalk::coupling
