// The built model before it is finished: masses, stable steps and coordinates a run can begin with.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

/// One problem for each part that has an element without a mass or a stable step.
void check_blocks(BuildContext& c) {
  for (const auto& block : c.model().blocks) {
    for (int e = 0; e < block->element_count(); ++e) {
      const double mass = block->corner_mass(e), step = block->initial_stable_step(e);
      const bool is_line = block->kind() == ElementKind::Line2;
      // Springs have neither a mass nor a step of their own.
      const bool is_sound = is_line ? mass >= 0 && std::isfinite(mass) && step > 0
                                    : is_positive(mass) && is_positive(step);
      if (is_sound) continue;
      const DeckId element = c.mesh().table(block->kind()).id[block->mesh_element(e)];
      const Part& part = c.deck.parts[block->part()];
      c.problem(part.source, fmt::format("element {} of part {}", element.value, part.id.value),
                "a finite mass and stable step above zero",
                fmt::format("{:.3g} kg and {:.3g} s", mass * block->corners(), step),
                "look at the values of its material and section");
      break;
    }
  }
}

void check_bodies(BuildContext& c) {
  const Model& model = c.model();
  std::vector<double> mass(c.mesh().node_count(), 0.0);
  std::copy(model.point_mass.begin(), model.point_mass.end(), mass.begin());
  for (const auto& block : model.blocks)
    for (int e = 0; e < block->element_count(); ++e)
      for (int corner = 0; corner < block->corners(); ++corner)
        mass[block->node(e / kLanes, corner, e % kLanes)] += block->corner_mass(e);
  for (const RigidBody& body : model.bodies) {
    if (body.role != BodyRole::Free) continue;
    double total = body.own.mass;
    for (int n : body.nodes) total += mass[n];
    if (is_positive(total)) continue;
    const Source source = body.parts.empty() ? Source{} : c.deck.parts[body.parts.front()].source;
    c.problem(source, fmt::format("rigid body '{}'", body.name), "a mass above zero",
              fmt::format("{:.3g} kg of {} nodes", total, body.nodes.size()),
              "give it elements with a density, or *PART_INERTIA");
  }
}

}  // namespace

void check_model(BuildContext& c) {
  if (c.problem_count > 0) return;  // the model is not whole
  check_blocks(c);
  check_bodies(c);
}

}  // namespace crosswalk::fe
