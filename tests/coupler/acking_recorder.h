// A recorder that only lets the run go on.
#pragma once

#include "common/node_session.h"
#include "crosswalk/msg/coupling_audit.hpp"
#include "crosswalk/msg/recorder_ack.hpp"

namespace crosswalk::toy {

/// Acknowledges the audits it has heard, without keeping anything.
class AckingRecorder : public NodeSession {
 public:
  AckingRecorder(Bus& bus, NodeIdentity identity, std::filesystem::path checkpoints = {})
      : NodeSession(bus, std::move(identity), {}, std::move(checkpoints)) {
    last_audit.window = -1;
    bus.subscribe<msg::coupling_audit>(Role::Coupler, [this](const msg::coupling_audit& m) {
      ++audits;
      if (m.window > last_audit.window) last_audit = m;
      acknowledge(last_audit.window);
    });
  }
  int audits = 0;
  msg::coupling_audit last_audit{};

 private:
  void acknowledge(std::int64_t window) {
    msg::recorder_ack ack{};
    ack.window = window;
    bus_.publish(ack, 0);
  }
  void on_manifest(const msg::run_manifest& manifest) override {
    // A resumed run: the log holds everything before the checkpoint.
    last_audit.window = std::max(last_audit.window, manifest.first_window - 1);
    acknowledge(last_audit.window);
  }
  void on_tick(Bus::Clock::time_point) override {
    if (manifest()) acknowledge(last_audit.window);
  }
  void on_control(const msg::run_control& control) override {
    if (control.command == static_cast<int>(Command::Checkpoint)) {
      write_checkpoint({control.window, -1, 0, {}});
    }
    if (control.command != static_cast<int>(Command::Finish)) return;
    msg::node_status done{};
    done.state = static_cast<int>(NodeState::Done);
    bus_.publish(done, 0);
  }
};

}  // namespace crosswalk::toy
