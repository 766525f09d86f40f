#include "mb_node/mb_config.h"

#include <fmt/format.h>

#include "common/units.h"

namespace crosswalk::mb {
namespace {

MultibodySettings read_multibody(ConfigTable table) {
  MultibodySettings s;
  s.substep = table.quantity_or("substep", Dimension::Time, {1e-7, 1e-4}, 1e-5,
                                "largest time step; a window is divided evenly");
  const std::string stepper = table.choice_or(
      "stepper", {"direct", "dense", "quick"}, "direct",
      "direct: joint forces exact, solved along the tree; dense: the same by ODE's own "
      "factorisation, slow; quick: ODE's iterations");
  s.stepper = stepper == "direct"  ? Stepper::Direct
              : stepper == "dense" ? Stepper::Dense
                                   : Stepper::Quick;
  s.quick_iterations = table.integer_or("quick_iterations", 5, 1000, OdeWorld::kQuickIterations,
                                        "iterations of the quick stepper");
  s.fracture = table.flag_or("fracture", true, "long bones may break, once each");
  s.knee_failure = table.flag_or("knee_failure", true, "knee ligaments may tear");
  s.self_contact = table.flag_or("self_contact", true, "arms, trunk, legs and chin may touch");
  s.replaces_t1_t3 =
      table.flag_or("replaces_t1_t3", true,
                    "the finite-element block tied to torso_up (T1 to T3) replaces an "
                    "equal part of its mass [E]");
  s.tie_stiffness = table.quantity_or("tie_stiffness", Dimension::Stiffness, kNonNegative, 2e4,
                                      "tension-only tie of bound wrists [E]");
  s.tie_damping = table.quantity_or("tie_damping", Dimension::Damping, kNonNegative, 30,
                                    "damping of the tie [E]");
  return s;
}

}  // namespace

MbConfig read_mb_config(ConfigDocument& document, const Scenario& scenario) {
  ConfigTable root = document.root();
  MbConfig config;
  config.body = read_body_description(root.table("subject", "The pedestrian."));
  if (scenario.mode == RunMode::Coupled) config.body = without_head_and_neck(config.body);
  config.posture = read_posture(root.table("posture", "Stance at the start."));
  config.vehicle = read_vehicle(root.table("vehicle", "The car."));
  config.multibody = read_multibody(root.table("multibody", "The multibody solver."));
  ConfigTable environment = root.table("environment", "What is around.");
  config.multibody.gravity =
      Vec3(0, 0,
           -environment.quantity_or("gravity", Dimension::Acceleration, {0, 100}, kStandardGravity,
                                    "downwards"));
  config.interfaces = scenario.interfaces;
  for (const InterfaceSpec& spec : config.interfaces) {
    if (spec.body == "buck" && !spec.is_attached) continue;
    if (config.body.find_segment(spec.body) >= 0) continue;
    std::vector<std::string> names = {"buck"};
    for (const Segment& segment : config.body.segments) names.push_back(segment.name);
    const std::string near = did_you_mean(spec.body, names);
    root.problem(
        "interfaces",
        spec.body == "buck" ? "`attached = false` for the buck" : "bodies of the pedestrian",
        fmt::format("`{}`", spec.body),
        near.empty() ? "" : fmt::format("did you mean `{}`?", near));
  }
  return config;
}

}  // namespace crosswalk::mb
