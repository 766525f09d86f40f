// The commands of `crosswalk` and their options.
#pragma once

#include <string>
#include <vector>

#include "common/error.h"

namespace crosswalk {

ExitCode launcher_main(const std::vector<std::string>& arguments);

}  // namespace crosswalk
