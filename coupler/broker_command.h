// `crosswalk broker`: the message broker as a program.
#pragma once

#include "common/node_main.h"

namespace crosswalk {

NodeCommand broker_command();

}  // namespace crosswalk
