// Small stand-ins for the programs of a run, so that the launcher, the coupler and the transport
// are tested with real processes in little time: called as mb_node or fe_node it serves the
// participants of tests/coupler/toy_nodes.h, as recorder it acknowledges. Also the shortest example
// of a node.
//
// CROSSWALK_TOY_STEP_US: real time spent per window, to make a run last.
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "common/bus.h"
#include "common/interrupt.h"
#include "common/solver_node.h"
#include "common/version.h"
#include "tests/coupler/acking_recorder.h"
#include "tests/coupler/toy_nodes.h"

namespace crosswalk::toy {
namespace {

class SlowMb : public Mb {
 public:
  using Mb::Mb;
  MbReply advance(const MbGrant& grant, RecordSink& sink) override {
    if (const char* step = std::getenv("CROSSWALK_TOY_STEP_US"))
      std::this_thread::sleep_for(std::chrono::microseconds(std::atoi(step)));
    return Mb::advance(grant, sink);
  }
};

ExitCode run_mb(RunContext& context) {
  SlowMb participant({.mass = 15, .v = 2});
  return run_mb_node(context, participant);
}

ExitCode run_fe(RunContext& context) {
  Fe participant({.mass = 4.5, .stiffness = 2e5, .damping = 50}, 0.5);
  return run_fe_node(context, participant);
}

ExitCode run_recorder(RunContext& context) {
  Bus bus(open_transport(context.url), context.run_id, Role::Recorder);
  AckingRecorder recorder(bus,
                          {.scenario_digest = static_cast<std::int64_t>(context.scenario.digest),
                           .version = version_text(),
                           .bodies = {}},
                          context.directory.checkpoints());
  return recorder.run(interrupt_flag());
}

}  // namespace
}  // namespace crosswalk::toy

int main(int argc, char** argv) {
  using namespace crosswalk;
  const std::string name = std::filesystem::path(argv[0]).filename().string();
  NodeProgram program{.name = name, .purpose = "stand-in for tests"};
  program.run = name == "mb_node"   ? toy::run_mb
                : name == "fe_node" ? toy::run_fe
                                    : toy::run_recorder;
  return node_main(argc, argv, program);
}
