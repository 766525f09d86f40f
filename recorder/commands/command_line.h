// The recorder's own commands for the shared command line.
#pragma once

#include <vector>

#include "common/node_main.h"

namespace crosswalk::recording {

std::vector<NodeCommand> commands();

}  // namespace crosswalk::recording
