// `crosswalk spy`: LCM's spy with our message types, on the traffic of a running run.
#pragma once

#include <string>

#include "common/error.h"
#include "launcher/process.h"

namespace crosswalk {

/// `run`: a run folder; empty: the newest under runs/ that is running. Returns only by throwing.
ExitCode spy_command(const std::string& run);
/// LCM's spy on a URL. Throws UserError when one of its archives is not installed.
ProcessSpec spy_process(const std::string& url);

}  // namespace crosswalk
