// `crosswalk run`: plan, check, start, watch, tell how it ended.
#pragma once

#include "common/error.h"
#include "launcher/plan.h"

namespace crosswalk {

ExitCode run_command(const RunRequest& request, const std::vector<std::string>& command);

}  // namespace crosswalk
