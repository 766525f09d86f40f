// `crosswalk replay`: plays the log of a run back to the bus with the player of LCM, for lcm-spy,
// for a fresh recorder, or for whoever listens; or has a fresh fe_node do its windows again.
#pragma once

#include <filesystem>
#include <string>

#include "common/error.h"

namespace crosswalk {

struct ReplayRequest {
  std::filesystem::path source;  ///< a run folder, or any LCM event log
  double speed = 1;              ///< times the pace at which the messages were recorded
  std::string to = "bus";        ///< bus, spy, recorder, or fe
  std::filesystem::path out;     ///< of the fresh recorder or fe_node; empty: <run>/replay
  std::string url;               ///< empty: one UDP port per run
  bool is_isolated = false;      ///< private network asked for
};

/// Returns when the log has been played and, with a recorder, its results are written.
ExitCode replay_command(const ReplayRequest& request);

}  // namespace crosswalk
