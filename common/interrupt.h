// Ctrl-C and termination requests as a flag that long loops ask.
#pragma once

#include <atomic>

namespace crosswalk {

/// From now on SIGINT and SIGTERM raise the flag; a second one ends the process at once.
void catch_interrupts();
bool is_interrupted();
const std::atomic<bool>& interrupt_flag();

}  // namespace crosswalk
