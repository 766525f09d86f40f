// A solver as a process: joins the run on the bus, serves the coupler until the run ends.
#pragma once

#include "common/exchange.h"
#include "common/node_main.h"

namespace crosswalk {

/// For `run` of mb_node and fe_node, after the scenario is read and the participant built.
ExitCode run_mb_node(RunContext& context, MbParticipant& participant);
ExitCode run_fe_node(RunContext& context, FeParticipant& participant);

}  // namespace crosswalk
