// fe_node: the finite-element head and neck. `fe_node run --scenario FILE --run-id ID`
#include <omp.h>

#include "common/node_main.h"
#include "common/solver_node.h"
#include "fe_node/fe_config.h"
#include "fe_node/fe_node.h"

int main(int argc, char** argv) {
  using namespace crosswalk;
  return node_main(
      argc, argv,
      {.name = "fe_node",
       .purpose = "computes the finite-element head and neck",
       .read = [](ConfigDocument& document,
                  const Scenario& scenario) { fe::read_fe_config(document, scenario); },
       .run =
           [](RunContext& context) {
             fe::FeConfig config = fe::read_fe_config(context.document, context.scenario);
             context.document.finish();
             fe::FeNode node(std::move(config), omp_get_max_threads(), context.directory.root());
             return run_fe_node(context, node);
           },
       .check_file = {},
       .commands = {}});
}
