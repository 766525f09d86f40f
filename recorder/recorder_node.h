// The recorder as a process of a run: joins, writes, acknowledges, asks again, and at the end turns
// its log into channels and the summary.
#pragma once

#include "common/node_main.h"

namespace crosswalk::recording {

/// Schema of [recorder].
void read_recorder_table(ConfigDocument& document, const Scenario& scenario);

ExitCode run_recorder(RunContext& context);

}  // namespace crosswalk::recording
