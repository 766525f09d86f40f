#include "fe_node/explosion.h"

#include <cmath>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

/// The freely moving node with the most speed; one whose speed is not a number wins.
int fastest_node(const Model& model, const State& state) {
  int fastest = -1;
  double speed = -1;
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const double v = state.nodes[n].velocity().norm();
    if (v <= speed) continue;
    fastest = n;
    speed = v;
    if (!std::isfinite(v)) break;
  }
  return fastest;
}

std::string element_at(const Model& model, int node) {
  for (int b = 0; b < static_cast<int>(model.blocks.size()); ++b) {
    const ElementBlock& block = *model.blocks[b];
    for (int e = 0; e < block.element_count(); ++e)
      for (int c = 0; c < block.corners(); ++c)
        if (block.node(e / kLanes, c, e % kLanes) == node) return describe_element(model, b, e);
  }
  for (const RigidBody& body : model.bodies)
    for (int n : body.nodes)
      if (n == node) return fmt::format("rigid body '{}'", body.name);
  return "no element";
}

std::string largest_contact(const Model& model, const Scratch& scratch) {
  int largest = -1;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const ContactReport& r = scratch.contact_reports[c];
    if (r.active == 0) continue;
    if (largest < 0 || !(r.stored <= scratch.contact_reports[largest].stored))
      largest = static_cast<int>(c);
  }
  if (largest < 0) return "no contact is active";
  const ContactReport& r = scratch.contact_reports[largest];
  return fmt::format("contact '{}' holds {:.3g} J at {} nodes, {:.3g} mm deep",
                     model.contacts[largest]->name(), r.stored, r.active, 1e3 * r.max_penetration);
}

}  // namespace

void ExplosionWatch::require_step(const Model& model, const State& state, const Scratch& scratch,
                                  const StepReport& report) {
  if (first_step_ == 0) first_step_ = report.stable_step;
  if (std::isinf(report.stable_step) || report.stable_step > kLeastStepShare * first_step_) return;
  throw NumericalError(
      state.time,
      fmt::format("the stable step has fallen from {:.3g} to {:.3g} us, for {}", 1e6 * first_step_,
                  1e6 * report.stable_step,
                  report.critical_element >= 0
                      ? describe_element(model, report.critical_block, report.critical_element)
                      : largest_contact(model, scratch)));
}

void ExplosionWatch::look(const Model& model, const State& state, const Scratch& scratch) {
  const double error = state.energies.balance_error();
  const bool is_sound =
      error <= kExplosionShare || state.energies.total() - state.energies.supplied() <= floor_;
  steps_ = is_sound ? 0 : steps_ + 1;
  if (steps_ < kExplosionSteps && std::isfinite(state.energies.total())) return;
  const int node = fastest_node(model, state);
  throw NumericalError(
      state.time,
      fmt::format(
          "the run makes energy: {:.3g} % of it comes from nowhere; fastest is node {} of {} "
          "at {:.3g} m/s; {}",
          100 * error, node < 0 ? 0 : model.mesh.node_id[node].value,
          node < 0 ? "nothing" : element_at(model, node),
          node < 0 ? 0.0 : state.nodes[node].velocity().norm(), largest_contact(model, scratch)));
}

}  // namespace crosswalk::fe
