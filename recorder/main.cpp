// recorder: writes a run's messages and judges it. `recorder run --scenario FILE --run-id ID`
#include "common/node_main.h"
#include "recorder/commands/command_line.h"
#include "recorder/recorder_node.h"

int main(int argc, char** argv) {
  using namespace crosswalk;
  return node_main(argc, argv,
                   {.name = "recorder",
                    .purpose = "records a run and judges it: signals, ratings, injury metrics",
                    .read = recording::read_recorder_table,
                    .run = recording::run_recorder,
                    .check_file = {},
                    .commands = recording::commands()});
}
