// coupler: the hub of a run. `coupler run --scenario FILE --run-id ID`
#include "common/node_main.h"
#include "coupler/bench_command.h"
#include "coupler/broker_command.h"
#include "coupler/coupler_node.h"

int main(int argc, char** argv) {
  using namespace crosswalk;
  return node_main(
      argc, argv,
      {.name = "coupler",
       .purpose = "leads a coupled run: windows in lockstep, coupling scheme, energy audit",
       .read = [](ConfigDocument& document,
                  const Scenario& scenario) { coupling::read_coupling(document, scenario); },
       .run = coupling::run_coupler,
       .check_file = {},
       .commands = {bench_command(), broker_command()}});
}
