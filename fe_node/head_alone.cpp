#include "fe_node/head_alone.h"

#include <algorithm>
#include <set>

#include "common/error.h"
#include "fe_node/own_head.h"

namespace crosswalk::fe {
namespace {

using Ids = std::set<int>;

bool holds(const Ids& ids, DeckId id) { return ids.contains(id.value); }

Ids parts_of_head(const Deck& deck) {
  Ids parts;
  for (const DeckSet& set : deck.sets)
    if (set.kind == SetKind::Part && set.title == kHeadParts)
      for (const DeckId id : set.ids) parts.insert(id.value);
  return parts;
}

/// Erases elements of other parts and gathers the nodes of the rest.
template <class Element>
void keep_elements(std::vector<Element>& elements, const Ids& parts, Ids& nodes) {
  std::erase_if(elements, [&](const Element& e) { return !holds(parts, e.part); });
  for (const Element& e : elements)
    for (const DeckId n : e.nodes)
      if (n.given()) nodes.insert(n.value);
}

class HeadAlone {
 public:
  explicit HeadAlone(Deck& deck) : deck_(deck), parts_(parts_of_head(deck)) {}

  void run() {
    keep_elements(deck_.solids, parts_, nodes_);
    keep_elements(deck_.shells, parts_, nodes_);
    keep_elements(deck_.thick_shells, parts_, nodes_);
    keep_elements(deck_.beams, parts_, nodes_);
    keep_elements(deck_.discretes, parts_, nodes_);
    keep_elements(deck_.seatbelts, parts_, nodes_);
    std::erase_if(deck_.nodes, [this](const DeckNode& n) { return !holds(nodes_, n.id); });
    std::erase_if(deck_.parts, [this](const Part& p) { return !holds(parts_, p.id); });
    keep_sets();
    keep_constraints();
    std::erase_if(deck_.contacts,
                  [this](const Contact& c) { return !is_there(c.slave) || !is_there(c.master); });
    forget_loads();
  }

 private:
  void keep_sets() {
    std::erase_if(deck_.sets, [this](DeckSet& set) {
      const bool is_of_nodes = set.kind == SetKind::Node, is_of_parts = set.kind == SetKind::Part;
      if (!is_of_nodes && !is_of_parts) return false;
      if (set.ids.empty()) return false;
      const Ids& kept = is_of_nodes ? nodes_ : parts_;
      std::erase_if(set.ids, [&kept](DeckId id) { return !holds(kept, id); });
      return set.ids.empty();
    });
    std::erase_if(deck_.segment_sets, [this](SegmentSet& set) {
      std::erase_if(set.segments, [this](const std::array<DeckId, 4>& segment) {
        return std::any_of(segment.begin(), segment.end(),
                           [this](DeckId n) { return !holds(nodes_, n); });
      });
      return set.segments.empty();
    });
    for (const DeckSet& set : deck_.sets) {
      if (set.kind == SetKind::Node) node_sets_.insert(set.id.value);
      if (set.kind == SetKind::Part) part_sets_.insert(set.id.value);
    }
    for (const SegmentSet& set : deck_.segment_sets) segment_sets_.insert(set.id.value);
  }

  bool is_there(NodeTarget kind, DeckId target) const {
    return holds(kind == NodeTarget::Node ? nodes_ : node_sets_, target);
  }

  bool is_there(const ContactSide& side) const {
    switch (side.kind) {
      case SurfaceKind::SegmentSet:
        return !side.id.given() || holds(segment_sets_, side.id);
      case SurfaceKind::PartSet:
      case SurfaceKind::ExemptedPartSet:
        return holds(part_sets_, side.id);
      case SurfaceKind::Part:
        return holds(parts_, side.id);
      case SurfaceKind::NodeSet:
        return holds(node_sets_, side.id);
      case SurfaceKind::ShellSet:
      case SurfaceKind::All:
        break;
    }
    return true;
  }

  void keep_constraints() {
    std::erase_if(deck_.masses, [this](const MassElement& m) {
      switch (m.kind) {
        case MassTarget::Node:
          return !holds(nodes_, m.target);
        case MassTarget::NodeSet:
          return !holds(node_sets_, m.target);
        case MassTarget::Part:
          return !holds(parts_, m.target);
        case MassTarget::PartSet:
          break;
      }
      return !holds(part_sets_, m.target);
    });
    std::erase_if(deck_.inertias,
                  [this](const InertiaElement& e) { return !holds(nodes_, e.node); });
    std::erase_if(deck_.extra_nodes, [this](const ExtraNodes& e) {
      return !holds(parts_, e.part) || !is_there(e.kind, e.target);
    });
    std::erase_if(deck_.merged_rigid_bodies, [this](const MergedRigidBodies& m) {
      return !holds(parts_, m.lead) || !holds(parts_, m.follower);
    });
    std::erase_if(deck_.nodal_rigid_bodies,
                  [this](const NodalRigidBody& b) { return !holds(node_sets_, b.node_set); });
    std::erase_if(deck_.node_ties, [this](const NodeTie& tie) {
      return tie.node_set.given() ? !holds(node_sets_, tie.node_set)
                                  : !holds(nodes_, tie.nodes[0]) || !holds(nodes_, tie.nodes[1]);
    });
    std::erase_if(deck_.dampings, [this](const Damping& d) {
      return d.kind != Damping::Kind::Global &&
             !holds(d.is_part_set ? part_sets_ : parts_, d.target);
    });
    deck_.joints.clear();  // between vertebrae
    deck_.joint_stiffnesses.clear();
  }

  void forget_loads() {
    deck_.spcs.clear();
    deck_.prescribed_motions.clear();
    deck_.initial_velocities.clear();
    deck_.nodal_velocities.clear();
    deck_.rigid_velocities.clear();
    deck_.generated_velocities.clear();
    deck_.nodal_loads.clear();
    deck_.rigid_loads.clear();
    deck_.pressures.clear();
    deck_.accelerometers.clear();
    deck_.histories.clear();
    deck_.cross_sections.clear();
  }

  Deck& deck_;
  Ids parts_, nodes_, node_sets_, part_sets_, segment_sets_;
};

}  // namespace

void keep_head_alone(Deck& deck) { HeadAlone(deck).run(); }

void drive_skull(Deck& deck, const std::string& title) {
  const auto set = std::find_if(deck.sets.begin(), deck.sets.end(), [](const DeckSet& s) {
    return s.kind == SetKind::Node && s.title == kSkullNodes;
  });
  CW_ASSERT(set != deck.sets.end());
  Ids skull, sharing;
  for (const DeckId id : set->ids) skull.insert(id.value);
  for (const SolidElement& e : deck.solids)
    if (std::any_of(e.nodes.begin(), e.nodes.end(), [&](DeckId n) { return holds(skull, n); }))
      sharing.insert(e.part.value);
  Part* lead = nullptr;
  for (Part& part : deck.parts) {
    if (!holds(sharing, part.id) || !is_rigid(deck, part)) continue;
    if (lead == nullptr) {
      lead = &part;
      lead->title = title;
    } else {
      deck.merged_rigid_bodies.push_back({lead->id, part.id, 0, {}});
    }
  }
  if (lead != nullptr) {
    deck.extra_nodes.push_back({NodeTarget::Set, lead->id, set->id, 0, {}});
    return;
  }
  NodalRigidBody body;
  for (const Part& part : deck.parts) body.id = DeckId(std::max(body.id.value, part.id.value + 1));
  body.node_set = set->id;
  body.title = title;
  deck.nodal_rigid_bodies.push_back(body);
}

}  // namespace crosswalk::fe
