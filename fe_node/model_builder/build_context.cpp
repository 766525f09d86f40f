#include "fe_node/model_builder/build_context.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk::fe {

void BuildContext::problem(Source source, std::string what, std::string expected, std::string found,
                           std::string hint) {
  ++problem_count;
  problems.add(deck.place(source), std::move(what), std::move(expected), std::move(found),
               std::move(hint));
}

int BuildContext::node(DeckId id, Source source, std::string_view who) {
  const auto found = node_index.find(id);
  if (found != node_index.end()) return found->second;
  problem(source, std::string(who), "a node of the deck", std::to_string(id.value));
  return -1;
}

std::optional<Curve> BuildContext::curve(DeckId id, double x_unit, double y_unit, Source source,
                                         std::string_view who, Curve::Outside outside) {
  const auto found = curves.find(id);
  if (found == curves.end()) {
    problem(source, std::string(who), "a *DEFINE_CURVE of the deck", std::to_string(id.value));
    return std::nullopt;
  }
  std::vector<double> x, y;
  for (const auto& [a, b] : scaled_points(*found->second)) {
    x.push_back(a * x_unit);
    y.push_back(b * y_unit);
  }
  try {
    return Curve(std::move(x), std::move(y), outside);
  } catch (const std::invalid_argument& reason) {
    problem(found->second->source, fmt::format("*DEFINE_CURVE {}", id.value),
            "strictly rising abscissae and finite numbers", reason.what());
    return std::nullopt;
  }
}

namespace {

/// Gathers the members of a set, of the sets it adds, and of those they add: each set once.
class SetMembers {
 public:
  SetMembers(BuildContext& context, SetKind kind) : c_(context), kind_(kind) {}

  void add(DeckId id, Source source) {
    const auto found = c_.sets.find({kind_, id});
    if (found == c_.sets.end())
      return c_.problem(source, "set", "a set of the deck", std::to_string(id.value));
    const DeckSet& set = *found->second;
    if (std::find(open_.begin(), open_.end(), &set) != open_.end())
      return c_.problem(set.source, fmt::format("set {}", id.value), "sets that do not name it",
                        "itself among the sets it adds");
    if (!done_.insert(&set).second) return;
    open_.push_back(&set);
    ids.insert(ids.end(), set.ids.begin(), set.ids.end());
    for (const auto& [first, last] : set.ranges) add_range(first, last);
    for (const DeckId other : set.added_sets) add(other, set.source);
    for (const GeneralEntry& entry : set.general) add_general(set, entry);
    open_.pop_back();
  }

  std::vector<DeckId> ids;

 private:
  /// Only members that exist: a range may span more numbers than a deck has entities.
  void add_range(DeckId first, DeckId last) {
    const auto add_within = [&](DeckId id) {
      if (first <= id && id <= last) ids.push_back(id);
    };
    if (kind_ == SetKind::Node)
      for (const DeckNode& node : c_.deck.nodes) add_within(node.id);
    else if (kind_ == SetKind::Part)
      for (const Part& part : c_.deck.parts) add_within(part.id);
    else
      for (const ElementKind kind : kElementKinds)
        if (is_of_set(kind))
          for (const DeckId id : c_.mesh().table(kind).id) add_within(id);
  }

  bool is_of_set(ElementKind kind) const {
    if (kind_ == SetKind::Shell) return kind == ElementKind::Quad4 || kind == ElementKind::Tri3;
    if (kind_ == SetKind::Solid) return kind == ElementKind::Hex8 || kind == ElementKind::Tet4;
    return kind == ElementKind::Line2;
  }

  void add_general(const DeckSet& set, const GeneralEntry& entry) {
    if (entry.option == "ALL" && kind_ == SetKind::Node) {
      for (const DeckNode& n : c_.deck.nodes) ids.push_back(n.id);
    } else if (entry.option == "PART" && kind_ == SetKind::Node) {
      for (DeckId part : entry.ids)
        if (const auto index = c_.part_index.find(part); index != c_.part_index.end())
          for (int n : c_.nodes_of_parts({index->second})) ids.push_back(c_.mesh().node_id[n]);
    } else if (entry.option == "NODE" || entry.option == "PART") {
      ids.insert(ids.end(), entry.ids.begin(), entry.ids.end());
    } else {
      c_.problem(set.source, fmt::format("set {} option {}", set.id.value, entry.option),
                 "ALL, PART or NODE", entry.option);
    }
  }

  BuildContext& c_;
  SetKind kind_;
  std::vector<const DeckSet*> open_;
  std::set<const DeckSet*> done_;
};

}  // namespace

std::vector<DeckId> BuildContext::set_ids(SetKind kind, DeckId id, Source source) {
  SetMembers members(*this, kind);
  members.add(id, source);
  return std::move(members.ids);
}

std::vector<int> BuildContext::node_set(DeckId id, Source source) {
  std::vector<int> nodes;
  for (DeckId n : set_ids(SetKind::Node, id, source))
    // Members a range names without existing are left out, as the manual has it.
    if (const auto found = node_index.find(n); found != node_index.end())
      nodes.push_back(found->second);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<int> BuildContext::part_set(DeckId id, Source source) {
  std::vector<int> parts;
  for (DeckId p : set_ids(SetKind::Part, id, source))
    if (const auto found = part_index.find(p); found != part_index.end())
      parts.push_back(found->second);
  std::sort(parts.begin(), parts.end());
  return parts;
}

std::vector<int> BuildContext::nodes_of_parts(const std::vector<int>& parts) const {
  std::vector<char> is_wanted(deck.parts.size(), 0);
  for (int p : parts) is_wanted[p] = 1;
  std::vector<int> nodes;
  for (ElementKind kind : kElementKinds) {
    const ElementTable& table = built.model.mesh.table(kind);
    for (int e = 0; e < table.size(); ++e)
      if (is_wanted[table.part[e]]) {
        const std::span<const int> corners = built.model.mesh.corners(kind, e);
        nodes.insert(nodes.end(), corners.begin(), corners.end());
      }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

const Section* BuildContext::section_of(const Part& part) const {
  const auto found = sections.find(part.section);
  return found == sections.end() ? nullptr : found->second;
}

const Material* BuildContext::material_of(const Part& part) const {
  const auto found = materials.find(part.material);
  return found == materials.end() ? nullptr : found->second;
}

}  // namespace crosswalk::fe
