// Plays the coupler for a finite-element node: gives it the grants of a recorded run, one after the
// other, and compares its states with the recorded ones. So a run's finite-element side is done
// again alone, as fast as it goes, with the same bits as long as nothing has changed.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/bus.h"

namespace crosswalk::recording {

struct FeReplay {
  std::int64_t grants = 0;
  std::int64_t compared = 0;                         ///< answers that the log holds as well
  std::optional<std::int64_t> first_other_window{};  ///< whose state is not the recorded one
};

/// `bus` has the role of the coupler and the run id of the node. Throws UserError when the log
/// lacks something the node needs, ProtocolError when the node does not answer.
FeReplay replay_to_fe(const std::filesystem::path& log, Bus& bus,
                      const std::atomic<bool>& interrupted);

}  // namespace crosswalk::recording
