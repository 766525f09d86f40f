// The recorder's part in the life of a run (docs/messages.md, "What the recorder owes").
#pragma once

#include <filesystem>
#include <functional>
#include <set>

#include "common/node_session.h"
#include "recorder/recorder.h"

namespace crosswalk::recording {

class RecorderSession : public NodeSession {
 public:
  /// To be called at every step of a long work, so that the coupler sees it advance.
  using Advanced = std::function<void()>;
  /// `write_results` is called once, when the record is complete, before the coupler is told.
  RecorderSession(Bus& bus, Recorder& recorder, NodeIdentity identity, Limits limits,
                  std::function<void(const Advanced&)> write_results,
                  std::filesystem::path checkpoints = {});

 private:
  void on_manifest(const msg::run_manifest& manifest) override;
  void on_control(const msg::run_control& control) override;
  void on_tick(Bus::Clock::time_point now) override;
  std::int64_t progress() const override { return progress_; }
  void acknowledge(Bus::Clock::time_point now);
  void ask_for_gaps(Bus::Clock::time_point now);
  void after_message();

  Recorder& recorder_;
  std::function<void(const Advanced&)> write_results_;
  std::int64_t acknowledged_ = -2;
  std::int64_t acks_ = 0, requests_ = 0;
  std::atomic<std::int64_t> progress_{0};
  Bus::Clock::time_point acknowledged_at_{}, asked_at_{};
  bool has_gap_since_last_tick_ = false;
  bool is_written_ = false;
};

/// How much of the log the checkpoint of `window` holds.
LogExtent kept_log(const std::filesystem::path& checkpoints, std::int64_t window);

}  // namespace crosswalk::recording
