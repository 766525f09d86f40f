// From the log of a run that is still being written to the events of its live page.
//
// Events: `scene` once (shapes), `frames` (new body poses), `samples` (head acceleration and speed,
// car force, interface drift), `state` (time, progress), `end`.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "recorder/log_file.h"
#include "recorder/report/scene.h"
#include "recorder/run_record.h"

namespace crosswalk::recording {

class LiveFeed {
 public:
  using Publish = std::function<void(const std::string& name, const std::string& data)>;
  explicit LiveFeed(Publish publish) : publish_(std::move(publish)) {}

  /// What has come since the last call, as events.
  void take(const std::vector<LogEvent>& batch);
  /// The coupler has finished or aborted the run.
  bool has_ended() const { return has_ended_; }

 private:
  void remember(const LogEvent& event);
  void publish_scene();
  void publish_frames(const RunRecord& news);
  void publish_samples(const RunRecord& news);
  void publish_state(const RunRecord& news);

  Publish publish_;
  std::vector<LogEvent> early_;  ///< until the manifest has come
  std::vector<std::byte> manifest_;
  RecordBuilder set_up_;  ///< manifest and descriptions only
  Manifest run_;
  bool has_scene_ = false;
  bool has_ended_ = false;
  Scene scene_;  ///< shapes; frames of the last batch
};

/// Follows the log of a run folder and serves its live page until `stop()`, or, when not lasting,
/// until the run has ended and browsers had time to fetch its report. Prints the address first.
enum class LivePage { UntilRunEnds, Lasting };
void serve_live_page(const std::filesystem::path& run, int port, LivePage page,
                     const std::function<bool()>& stop);

}  // namespace crosswalk::recording
