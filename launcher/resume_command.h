// `crosswalk resume RUN`: continues an interrupted run in its folder, from the latest checkpoint
// that every process has written, to the result of an uninterrupted run, bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "launcher/plan.h"

namespace crosswalk {

/// What a run folder says about the run it holds.
struct InterruptedRun {
  std::optional<std::int64_t> window;  ///< of the checkpoint; none yet: start from the beginning
};

/// Looks whether the run can be resumed. Throws UserError for a running run and an edited scenario,
/// ProtocolError{CheckpointMismatch} for a checkpoint that is damaged or not ours.
InterruptedRun inspect_interrupted(const RunDirectory& directory, const Scenario& scenario);

/// request.scenario is the run folder. Of a finished run it only tells the results.
ExitCode resume_command(RunRequest request, const std::vector<std::string>& command);

}  // namespace crosswalk
