// mb_node: the multibody pedestrian and the car. `mb_node run --scenario FILE --run-id ID`
#include "common/node_main.h"
#include "common/solver_node.h"
#include "mb_node/commands.h"
#include "mb_node/mb_config.h"
#include "mb_node/mb_node.h"
#include "mb_node/played_motion.h"
#include "mb_node/study.h"

int main(int argc, char** argv) {
  using namespace crosswalk;
  return node_main(
      argc, argv,
      {.name = "mb_node",
       .purpose = "moves the multibody pedestrian and the car",
       .read = [](ConfigDocument& document,
                  const Scenario& scenario) { mb::read_mb_config(document, scenario); },
       .run =
           [](RunContext& context) {
             mb::MbConfig config = mb::read_mb_config(context.document, context.scenario);
             context.document.finish();
             if (context.scenario.has_head_alone()) {
               mb::PlayedMotion node(config, context.scenario);
               return run_mb_node(context, node);
             }
             mb::MbNode node(std::move(config));
             return run_mb_node(context, node);
           },
       .check_file = {},
       .commands = {mb::solo_command(), mb::subject_command(), mb::study_command()}});
}
