// The recorder's own commands as options of a command-line parser.
#pragma once

#include <functional>

#include "common/error.h"

namespace CLI {
class App;
}

namespace crosswalk::recording {

/// Each adds its options to `app` and returns what to do once they are parsed.
std::function<ExitCode()> define_rate(CLI::App& app);
std::function<ExitCode()> define_injury(CLI::App& app);

}  // namespace crosswalk::recording
