// Commands of mb_node beyond run, check and keys.
#pragma once

#include "common/node_main.h"

namespace crosswalk::mb {

NodeCommand solo_command();     ///< a multibody run without the other processes
NodeCommand subject_command();  ///< the scaling report of a subject

}  // namespace crosswalk::mb
