#include "recorder/fe_replay.h"

#include <functional>
#include <map>

#include <fmt/format.h>

#include "common/error.h"
#include "crosswalk/msg/node_hello.hpp"
#include "recorder/log_file.h"
#include "recorder/message_decode.h"

namespace crosswalk::recording {

using namespace std::chrono_literals;

namespace {

constexpr double kSilence_s = 60;  // a node that has not come, or has stopped to give signs of life
constexpr auto kAskAgain = 500ms;

[[noreturn]] void refuse(const std::filesystem::path& log, const std::string& expected,
                         const std::string& found) {
  throw UserError(Problem{{log.string()}, "replay to fe_node", expected, found, {}});
}

class Player {
 public:
  Player(const std::filesystem::path& log, Bus& bus, const std::atomic<bool>& interrupted)
      : log_(log), bus_(bus), interrupted_(interrupted), heard_(Bus::Clock::now()) {
    bus.subscribe<msg::node_hello>(Role::Fe, [this](const msg::node_hello&) { hear(); });
    bus.subscribe<msg::node_status>(Role::Fe, [this](const msg::node_status&) { hear(); });
    bus.subscribe<msg::boundary_mass>(Role::Fe, [this](const msg::boundary_mass&) {
      hear();
      is_placed_ = true;
    });
    bus.subscribe<msg::fe_done>(Role::Fe, [this](const msg::fe_done& m) {
      hear();
      done_ = m;
    });
    done_.h.seq = -1;
  }

  FeReplay play() {
    read_log(log_, [this](const LogEvent& event) { note_recorded(event.data); });
    read_log(log_, [this](const LogEvent& event) { play(event.data); });
    if (next_ == 0) refuse(log_, "the log of a run with a finite-element side", "one without");
    for (int i = 0; i < 3; ++i) {
      msg::run_control stop{};
      stop.command = static_cast<int>(Command::Stop);
      bus_.publish(stop, i);
    }
    result_.grants = next_;
    return result_;
  }

 private:
  void hear() { heard_ = Bus::Clock::now(); }

  void note_recorded(std::span<const std::byte> data) {
    const auto h = peek_header(data);
    if (!h || h->kind != static_cast<int>(MessageKind::FeDone)) return;
    if (const auto m = decoded<msg::fe_done>(data)) recorded_[h->seq] = m->state_hash;
  }

  void play(std::span<const std::byte> data) {
    const auto h = peek_header(data);
    if (!h) return;
    switch (static_cast<MessageKind>(h->kind)) {
      case MessageKind::RunManifest:
        if (!manifest_ && is_sound_manifest(data)) manifest_ = decoded<msg::run_manifest>(data);
        break;
      case MessageKind::BoundaryMotion:
        if (const auto m = decoded<msg::boundary_motion>(data); m && manifest_ && !is_placed_)
          place(*m);
        break;
      case MessageKind::Mobility:
        if (const auto m = decoded<msg::mobility>(data)) mobility_ = *m;
        if (is_placed_) bus_.publish(mobility_, h->seq);
        break;
      case MessageKind::StepToFe:
        if (const auto m = decoded<msg::step_to_fe>(data)) grant(h->seq, *m);
        break;
      default:
        break;
    }
  }

  void place(const msg::boundary_motion& motion) {
    std::int64_t times = 0;
    wait_for([this] { return is_placed_; },
             [&] {
               bus_.publish(*manifest_, times);
               bus_.publish(motion, times++);
             });
  }

  void grant(std::int64_t seq, const msg::step_to_fe& m) {
    if (!is_placed_ || seq < next_) return;  // sent twice
    if (seq > next_)
      refuse(log_, fmt::format("grant {}", next_), fmt::format("grant {} after a gap", seq));
    wait_for([&] { return done_.h.seq == seq; },
             [&] {
               if (m.mobility_id >= 0) bus_.publish(mobility_, mobility_.id);
               bus_.publish(m, seq);
             });
    ++next_;
    const auto recorded = recorded_.find(seq);
    if (recorded == recorded_.end()) return;
    ++result_.compared;
    if (recorded->second != done_.state_hash && !result_.first_other_window)
      result_.first_other_window = m.window;
  }

  void wait_for(const std::function<bool()>& done, const std::function<void()>& ask) {
    while (true) {
      ask();
      if (bus_.wait_until(Bus::Clock::now() + kAskAgain, done)) return;
      if (interrupted_) throw ProtocolError(ExitCode::Interrupted, "stopped on request");
      const auto silent = std::chrono::duration<double>(Bus::Clock::now() - heard_).count();
      if (silent > kSilence_s)
        throw ProtocolError(ExitCode::TimeOut,
                            fmt::format("fe_node has been silent for {:.0f} s", silent));
    }
  }

  const std::filesystem::path& log_;
  Bus& bus_;
  const std::atomic<bool>& interrupted_;
  Bus::Clock::time_point heard_;
  std::optional<msg::run_manifest> manifest_;
  msg::mobility mobility_{};
  msg::fe_done done_{};
  bool is_placed_ = false;
  std::int64_t next_ = 0;
  std::map<std::int64_t, std::int64_t> recorded_;  ///< state by number of the grant
  FeReplay result_;
};

}  // namespace

FeReplay replay_to_fe(const std::filesystem::path& log, Bus& bus,
                      const std::atomic<bool>& interrupted) {
  return Player(log, bus, interrupted).play();
}

}  // namespace crosswalk::recording
