#include "fe_node/validate/free_head.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/units.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/validate/head_draft.h"
#include "fe_node/validate/injury.h"

namespace crosswalk::fe::validate {

namespace part = generate::part;

FreeHead::FreeHead(generate::Fidelity fidelity) {
  generate::HeadNeckSpec spec;
  spec.fidelity = fidelity;
  const generate::HeadNeck whole = generate::build_head_neck(spec);
  draft = whole_head(whole);
  marks = whole.landmarks;
  for (const generate::Hex& hex : draft.mesh.hexes)
    if (hex.part == part::kScalp || hex.part == part::kFace)
      skin.insert(skin.end(), hex.node.begin(), hex.node.end());
  std::sort(skin.begin(), skin.end());
  skin.erase(std::unique(skin.begin(), skin.end()), skin.end());
}

Vec3 FreeHead::support(const Vec3& direction) const {
  Vec3 best = draft.mesh.nodes[skin.front()];
  for (int n : skin)
    if (draft.mesh.nodes[n].dot(direction) > best.dot(direction)) best = draft.mesh.nodes[n];
  return best;
}

Vec3 FreeHead::brain_surface(const Vec3& direction) const {
  const auto nearest_pia = [&](double radius) {
    const Vec3 target = cranial_centre() + radius * direction;
    Vec3 best = cranial_centre();
    for (const generate::Quad& quad : draft.mesh.quads) {
      if (quad.part != part::kPia) continue;
      const Vec3 p = draft.mesh.nodes[quad.node[0]];
      if ((p - target).squaredNorm() < (best - target).squaredNorm()) best = p;
    }
    return best;
  };
  // The pia lines the brain inside too, along falx and tentorium: come from outside, then from how
  // far out the surface is.
  constexpr double kOutside = 0.12;  // m
  return nearest_pia((nearest_pia(kOutside) - cranial_centre()).norm());
}

HeadSensor::HeadSensor(const DeckRun& run)
    : motion_(
          run.model(),
          run.model().mesh.node_sets[run.model().mesh.find_node_set("skull_fit")].nodes,
          {Quat::Identity(),
           inertia_of_parts(run.model(), run.built().part_sets[run.built().part_set("head")].second)
               .com}),
      before_(motion_.twist(run.state())) {}

void HeadSensor::sample(const State& state) {
  const Twist now = motion_.twist(state);
  if (state.time > 0) {
    time.push_back(state.time);
    acceleration.push_back((now.v - before_.v).norm() / (state.time - last_));
    velocity.push_back(now.v);
  }
  before_ = now;
  last_ = state.time;
}

double HeadSensor::peak() const {
  return *std::max_element(acceleration.begin(), acceleration.end());
}

double HeadSensor::time_of_peak() const {
  return time[std::max_element(acceleration.begin(), acceleration.end()) - acceleration.begin()];
}

double HeadSensor::hic15() const { return hic(time, acceleration, 0.015); }

Series HeadSensor::series(const std::string& label) const {
  Series out{label, {}};
  for (std::size_t i = 0; i < time.size(); ++i)
    out.points.emplace_back(1e3 * time[i], acceleration[i] / kStandardGravity);
  return out;
}

std::vector<int> blocks_of(const DeckRun& run, const std::string& part_set) {
  const std::vector<int>& parts = run.built().part_sets[run.built().part_set(part_set)].second;
  std::vector<int> blocks;
  for (int b = 0; b < static_cast<int>(run.model().blocks.size()); ++b)
    if (std::find(parts.begin(), parts.end(), run.model().blocks[b]->part()) != parts.end())
      blocks.push_back(b);
  return blocks;
}

PressurePatch::PressurePatch(const DeckRun& run, const Vec3& centre, double radius) {
  const Model& model = run.model();
  for (const int b : blocks_of(run, "brain")) {
    const ElementBlock& block = *model.blocks[b];
    if (block.kind() != ElementKind::Hex8) continue;
    for (int e = 0; e < block.element_count(); ++e) {
      Vec3 p = Vec3::Zero();
      for (int c = 0; c < 8; ++c)
        p += model.mesh.position[block.node(e / kLanes, c, e % kLanes)] / 8;
      if ((p - centre).norm() < radius) elements_.push_back({b, e});
    }
  }
}

double PressurePatch::pressure(const DeckRun& run) const {
  const State& state = run.state();
  const StepContext context{state.nodes, state.spin, state.time, 0, false};
  double sum = 0;
  for (const auto& [b, e] : elements_)
    sum -= run.model().blocks[b]->sample(context, state.history[b], e).stress.trace() / 3;
  return elements_.empty() ? 0 : sum / static_cast<double>(elements_.size());
}

std::string energy_note(const DeckRun& run) {
  const double internal = run.largest_internal();
  return fmt::format(
      "hourglass at most {:.1f} % of the largest internal energy, balance {:+.2f} %, added mass "
      "{:.2f} %, stable step {:.2f} us",
      internal > 0 ? 100 * run.largest_hourglass() / internal : 0.0,
      100 * run.state().energies.balance_error(), 100 * run.added_mass_share(),
      1e6 * initial_stable_step(run.model()));
}

}  // namespace crosswalk::fe::validate
