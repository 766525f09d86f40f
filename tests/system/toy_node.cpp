// Small stand-ins for the programs of a run, so that the launcher, the coupler and the transport
// are tested with real processes in little time: called as mb_node or fe_node it serves the
// participants of tests/coupler/toy_nodes.h, or the lattice neck of neck_on_bodies.h where the
// interface bodies are its; as recorder it acknowledges. Also the shortest example of a node. What
// the two sides consist of stands in [multibody] and [fe].
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
#include "tests/coupler/neck_on_bodies.h"
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

bool has_neck(const Scenario& scenario) { return scenario.interfaces.at(0).body == "torso"; }
bool has_clavicles(const Scenario& scenario) { return scenario.interfaces.size() == 3; }

ExitCode run_mb(RunContext& context) {
  ConfigTable table = context.document.root().table("multibody", "bodies");
  const bool is_neck = has_neck(context.scenario);
  const double mass = table.quantity_or("mass", Dimension::Mass, kPositive, 15, "of the body");
  const double step = table.quantity_or("step", Dimension::Time, kPositive, 1e-5, "time step");
  if (is_neck) {
    coupling::NeckCase c{
        .body_mass = mass, .has_clavicles = has_clavicles(context.scenario), .mb_step = step};
    c.push = table.quantity_or("push", Dimension::Force, {}, 0, "on the torso, half sine");
    for (int i = 0; i < 3; ++i)
      c.spin[i] = table.quantity_or(
          std::string("spin_") + "xyz" [i], Dimension::AngularSpeed, {}, 0,
          "of everything at the start");
    context.document.finish();
    coupling::NeckBodies participant(c);
    return run_mb_node(context, participant);
  }
  const double speed = table.quantity_or("speed", Dimension::Speed, {}, 2, "at the start");
  context.document.finish();
  SlowMb participant({.mass = mass, .v = speed, .step = step});
  return run_mb_node(context, participant);
}

ExitCode run_fe(RunContext& context) {
  ConfigTable table = context.document.root().table("fe", "springs");
  const double step = table.quantity_or("step", Dimension::Time, kPositive, 5e-7, "time step");
  if (has_neck(context.scenario)) {
    const double damping =
        table.quantity_or("damping_ratio", Dimension::None, kNonNegative, 0.05, "of every bar");
    context.document.finish();
    coupling::LatticeNeck participant({.damping_ratio = damping,
                                       .has_clavicles = has_clavicles(context.scenario),
                                       .fe_step = step});
    return run_fe_node(context, participant);
  }
  const FePoint point{
      .mass = table.quantity_or("mass", Dimension::Mass, kPositive, 4.5, "of the point"),
      .stiffness = table.quantity_or("stiffness", Dimension::Stiffness, kPositive, 2e5, "spring"),
      .damping = table.quantity_or("damping", Dimension::Damping, kNonNegative, 50, "damper"),
      .x = table.quantity_or("stretch", Dimension::Length, {}, 0, "of the spring at the start"),
      .step = step};
  const double block =
      table.quantity_or("block_mass", Dimension::Mass, kNonNegative, 0.5, "handed to the body");
  context.document.finish();
  WatchedFe participant(point, block);
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
