// What this build is.
#pragma once

#include <string>

namespace crosswalk {

/// Version and, when built in a git tree, commit: "0.1.0 (d5bcad0)" or "0.1.0 (d5bcad0, changed)".
std::string version_text();

}  // namespace crosswalk
