#include "recorder/recorder_session.h"

#include "common/byte_archive.h"
#include "crosswalk/msg/recorder_ack.hpp"

namespace crosswalk::recording {

using namespace std::chrono_literals;

namespace {

constexpr std::int64_t kWindowsPerAck = 16;
constexpr auto kAckSilence = 100ms;   // the coupler may be waiting
constexpr auto kAskInterval = 100ms;  // between two requests for the same gap

}  // namespace

RecorderSession::RecorderSession(Bus& bus, Recorder& recorder, NodeIdentity identity, Limits limits,
                                 std::function<void(const Advanced&)> write_results,
                                 std::filesystem::path checkpoints)
    : NodeSession(bus, std::move(identity), limits, std::move(checkpoints)),
      recorder_(recorder),
      write_results_(std::move(write_results)) {
  bus_.subscribe_sealed([this](const std::string& channel, std::span<const std::byte> data,
                               std::int64_t received_us) {
    recorder_.add(channel, data, received_us);
    after_message();
  });
}

void RecorderSession::on_manifest(const msg::run_manifest&) {
  // Also on each repetition: the first acknowledgement may have been lost.
  set_state(NodeState::Waiting, recorder_.complete_window());
  acknowledge(Bus::Clock::now());
}

void RecorderSession::on_control(const msg::run_control& control) {
  const auto command = static_cast<Command>(control.command);
  if (command == Command::Start) set_state(NodeState::Solving, -1);
  // The coupler asks again while something is missing.
  if (command == Command::Checkpoint && recorder_.gaps(1).empty()) {
    recorder_.sync();
    ByteWriter part;
    part.value(recorder_.extent());
    write_checkpoint({control.window, -1, 0, part.take()});
  }
}

LogExtent kept_log(const std::filesystem::path& checkpoints, std::int64_t window) {
  const CheckpointPart part = read_part(checkpoints, Role::Recorder, window);
  return ByteReader(part.state).take<LogExtent>();
}

void RecorderSession::after_message() {
  progress_ = recorder_.messages();
  if (recorder_.complete_window() - acknowledged_ >= kWindowsPerAck) acknowledge(Bus::Clock::now());
}

void RecorderSession::acknowledge(Bus::Clock::time_point now) {
  recorder_.flush();
  msg::recorder_ack ack{};
  ack.window = recorder_.complete_window();
  bus_.publish(ack, acks_++);
  acknowledged_ = ack.window;
  acknowledged_at_ = now;
  if (!is_written_) set_state(NodeState::Solving, ack.window);
}

void RecorderSession::ask_for_gaps(Bus::Clock::time_point now) {
  const std::vector<Gap> gaps = recorder_.gaps();
  // A gap must outlive one interval: messages of different senders overtake each other all the
  // time.
  if (!gaps.empty() && has_gap_since_last_tick_) {
    for (const Gap& gap : gaps) {
      msg::resend_request request{};
      request.role = static_cast<std::int16_t>(gap.role);
      request.kind = static_cast<std::int16_t>(gap.kind);
      request.first = gap.first;
      request.last = gap.last;
      bus_.publish(request, requests_++);
    }
  }
  has_gap_since_last_tick_ = !gaps.empty();
  asked_at_ = now;
}

void RecorderSession::on_tick(Bus::Clock::time_point now) {
  if (!manifest()) return;
  if (now - acknowledged_at_ >= kAckSilence) acknowledge(now);
  if (now - asked_at_ >= kAskInterval) ask_for_gaps(now);
  if (!is_written_ && recorder_.is_complete()) {
    acknowledge(now);
    is_written_ = true;
    write_results_([this] { ++progress_; });
    heard_coupler();
    set_state(NodeState::Done, recorder_.complete_window());
  }
}

}  // namespace crosswalk::recording
