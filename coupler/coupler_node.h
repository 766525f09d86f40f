// The coupler as a process: from a scenario to an exit code.
//
// Its standard output is a line protocol for the launcher:
//   @progress <t_ms> <t_end_ms> <energy_balance_percent> <head_contact 0|1>   at most ten a second
//   @event <info|warning|error> <text>
#pragma once

#include "common/node_main.h"
#include "coupler/coupler_config.h"

namespace crosswalk::coupling {

ExitCode run_coupler(RunContext& context);

}  // namespace crosswalk::coupling
