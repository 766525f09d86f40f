// *CONSTRAINED_JOINT cards to penalty joints between rigid bodies.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

/// What a kind of joint holds: pairs of nodes on its card, how many of them are held and in which
/// part of their gap, and what is kept of the axes from node 1 to 3 and from node 2 to 4.
struct JointForm {
  int pairs = 0, held = 0;
  JointHold hold = JointHold::All;
  JointAxes axes = JointAxes::Free;
};

JointForm form_of(JointKind kind) {
  switch (kind) {
    case JointKind::Spherical:
      return {.pairs = 1, .held = 1};
    case JointKind::Revolute:
      return {.pairs = 2, .held = 2};
    case JointKind::Locking:
      return {.pairs = 3, .held = 3};
    case JointKind::Cylindrical:
      return {.pairs = 2, .held = 2, .hold = JointHold::AcrossAxis};
    case JointKind::Translational:
      return {.pairs = 3, .held = 3, .hold = JointHold::AcrossAxis};
    case JointKind::Planar:
      return {.pairs = 2, .held = 1, .hold = JointHold::AlongAxis, .axes = JointAxes::Parallel};
    case JointKind::Universal:
      return {.pairs = 2, .held = 1, .axes = JointAxes::AtRightAngles};
  }
  CW_ASSERT(false);
  return {};
}

class JointStage {
 public:
  explicit JointStage(BuildContext& context) : c_(context) {
    body_of_node_.assign(c_.mesh().node_count(), -1);
    const std::vector<RigidBody>& bodies = c_.model().bodies;
    for (int b = 0; b < static_cast<int>(bodies.size()); ++b)
      for (int n : bodies[b].nodes) body_of_node_[n] = b;
  }

  void add(const Joint& card) {
    const std::string who = fmt::format("*CONSTRAINED_JOINT {}", card.id.value);
    const JointForm form = form_of(card.kind);
    JointSpec spec;
    spec.name = card.title.empty() ? fmt::format("joint {}", card.id.value) : card.title;
    spec.stiffness_scale *= card.penalty_scale > 0 ? card.penalty_scale : 1;
    spec.damping_ratio *= card.damping > 0 ? card.damping : 1;
    spec.body_a = spec.body_b = -1;
    spec.hold = form.hold;
    spec.axes = form.axes;
    for (int i = 0; i < form.pairs; ++i) {
      const int a = node(card, 2 * i, who), b = node(card, 2 * i + 1, who);
      if (a < 0 || b < 0) return;
      if (!belongs(card, who, a, spec.body_a) || !belongs(card, who, b, spec.body_b)) return;
      if (i == 0 || form.axes != JointAxes::AtRightAngles)
        largest_gap_ = std::max(largest_gap_, between(a, b).norm());
      if (i < 2) (i == 0 ? spec.axis.first : spec.axis.second) = a;
      if (i < 2) (i == 0 ? spec.axis_b.first : spec.axis_b.second) = b;
      if (i < form.held) spec.points.emplace_back(a, b);
    }
    if (!has_sound_axes(card, who, spec)) return;
    const RigidBody &a = c_.model().bodies[spec.body_a], &b = c_.model().bodies[spec.body_b];
    if (spec.body_a == spec.body_b || (a.role != BodyRole::Free && b.role != BodyRole::Free)) {
      c_.problem(card.source, who, "two bodies of which one moves freely",
                 fmt::format("'{}' and '{}'", a.name, b.name));
      return;
    }
    constexpr double kTogether = 1e-6;  // m; nodes of a pair lie at one place
    if (largest_gap_ > kTogether) {
      c_.problem(card.source, who, "nodes of a pair at the same place",
                 fmt::format("{:.3g} m apart", largest_gap_));
      return;
    }
    c_.built.joints.push_back(std::move(spec));
  }

 private:
  int node(const Joint& card, int slot, const std::string& who) {
    return c_.node(card.nodes[static_cast<std::size_t>(slot)], card.source, who);
  }
  Vec3 between(int from, int to) { return c_.mesh().position[to] - c_.mesh().position[from]; }

  bool has_sound_axes(const Joint& card, const std::string& who, const JointSpec& spec) {
    if (spec.hold == JointHold::All && spec.axes == JointAxes::Free) return true;
    const Vec3 a = between(spec.axis.first, spec.axis.second);
    if (a == Vec3::Zero()) {
      c_.problem(card.source, who, "an axis from node 1 to node 3", "both at one place");
      return false;
    }
    if (spec.axes != JointAxes::AtRightAngles) return true;
    const Vec3 b = between(spec.axis_b.first, spec.axis_b.second);
    constexpr double kRightAngle = 1e-3;  // rad; coordinates of a deck have few digits
    const double off = std::abs(a.dot(b)) / (a.norm() * b.norm());
    if (off <= kRightAngle) return true;
    c_.problem(card.source, who, "arms from node 1 to 3 and from node 2 to 4 at right angles",
               b == Vec3::Zero() ? "nodes 2 and 4 at one place"
                                 : fmt::format("{:.3g} degrees off", std::asin(std::min(off, 1.0)) *
                                                                         180 / std::numbers::pi));
    return false;
  }

  /// The body of a node, the same for all nodes of a side.
  bool belongs(const Joint& card, const std::string& who, int node, int& body) {
    const int found = body_of_node_[node];
    if (found >= 0 && (body < 0 || body == found)) {
      body = found;
      return true;
    }
    c_.problem(
        card.source, who, "nodes 1 3 5 of one rigid body and 2 4 6 of another",
        fmt::format("node {} of {}", c_.mesh().node_id[node].value, found < 0 ? "none" : "a third"),
        "add it by *CONSTRAINED_EXTRA_NODES");
    return false;
  }

  BuildContext& c_;
  std::vector<int> body_of_node_;
  double largest_gap_ = 0;
};

}  // namespace

void build_joints(BuildContext& context) {
  for (const Joint& joint : context.deck.joints) JointStage(context).add(joint);
}

}  // namespace crosswalk::fe
