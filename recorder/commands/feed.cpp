// `recorder feed RUN --url URL`: the recorded grants to a finite-element node, for `crosswalk
// replay
// --to fe`.
#include <fmt/format.h>

#include "common/interrupt.h"
#include "common/run_directory.h"
#include "recorder/commands/commands.h"
#include "recorder/fe_replay.h"

namespace crosswalk::recording {

ExitCode feed(const FeedRequest& request) {
  catch_interrupts();
  Bus bus(open_transport(request.url), request.run_id, Role::Coupler);
  const FeReplay replay = replay_to_fe(RunDirectory(request.run).signals(), bus, interrupt_flag());
  if (replay.first_other_window) {
    fmt::print("{} grants done again; from window {} on the states are not those of the run\n",
               replay.grants, *replay.first_other_window);
    return ExitCode::NumericalLimit;
  }
  fmt::print("{} grants done again; {} states compared, all bit-identical\n", replay.grants,
             replay.compared);
  return ExitCode::Done;
}

}  // namespace crosswalk::recording
