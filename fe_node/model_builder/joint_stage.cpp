// *CONSTRAINED_JOINT cards to penalty joints between rigid bodies.
#include <fmt/format.h>

#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

/// What a kind of joint holds: pairs of nodes on its card, how many of them are held and in which
/// part of their gap, and whether the axis from node 1 to node 3 stays parallel.
struct JointForm {
  int pairs = 0, held = 0;
  JointHold hold = JointHold::All;
  bool keeps_axis = false;
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
      return {.pairs = 2, .held = 1, .hold = JointHold::AlongAxis, .keeps_axis = true};
    case JointKind::Universal:
      break;
  }
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
    if (form.pairs == 0) {
      c_.problem(card.source, who,
                 "a spherical, revolute, cylindrical, planar, translational or locking joint",
                 "another kind");
      return;
    }
    JointSpec spec;
    spec.name = card.title.empty() ? fmt::format("joint {}", card.id.value) : card.title;
    spec.stiffness_scale *= card.penalty_scale > 0 ? card.penalty_scale : 1;
    spec.damping_ratio *= card.damping > 0 ? card.damping : 1;
    spec.body_a = spec.body_b = -1;
    spec.hold = form.hold;
    spec.keeps_axis = form.keeps_axis;
    for (int i = 0; i < form.pairs; ++i) {
      const int a = node(card, 2 * i, who), b = node(card, 2 * i + 1, who);
      if (a < 0 || b < 0) return;
      if (!belongs(card, who, a, spec.body_a) || !belongs(card, who, b, spec.body_b)) return;
      const double gap = (c_.mesh().position[a] - c_.mesh().position[b]).norm();
      if (i == 0 || gap > largest_gap_) largest_gap_ = gap;
      if (i < 2) (i == 0 ? spec.axis.first : spec.axis.second) = a;
      if (i < form.held) spec.points.emplace_back(a, b);
    }
    if (form.hold != JointHold::All &&
        c_.mesh().position[spec.axis.first] == c_.mesh().position[spec.axis.second]) {
      c_.problem(card.source, who, "an axis from node 1 to node 3", "both at one place");
      return;
    }
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
