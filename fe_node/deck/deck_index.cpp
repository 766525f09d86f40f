#include "fe_node/deck/deck_index.h"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>

namespace crosswalk::fe {

void IdTable::sort() {
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

std::int32_t IdTable::find(DeckId id) const {
  const auto at = std::lower_bound(entries_.begin(), entries_.end(), id,
                                   [](const auto& entry, DeckId key) { return entry.first < key; });
  return at != entries_.end() && at->first == id ? at->second : -1;
}

DeckIndex::DeckIndex(const Deck& deck)
    : deck_(&deck),
      nodes_(deck.nodes),
      parts_(deck.parts),
      sections_(deck.sections),
      materials_(deck.materials),
      hourglasses_(deck.hourglasses),
      curves_(deck.curves),
      tables_(deck.tables),
      vectors_(deck.vectors),
      boxes_(deck.boxes),
      segment_sets_(deck.segment_sets),
      solids_(deck.solids),
      shells_(deck.shells),
      beams_(deck.beams),
      discretes_(deck.discretes) {
  for (std::size_t i = 0; i < deck.sets.size(); ++i)
    sets_[static_cast<int>(deck.sets[i].kind)].add(deck.sets[i].id, static_cast<std::int32_t>(i));
  for (IdTable& table : sets_) table.sort();
}

const DeckSet* DeckIndex::set(SetKind kind, DeckId id) const {
  return at(deck_->sets, sets_[static_cast<int>(kind)], id);
}

const IdTable& DeckIndex::elements(SetKind kind) const {
  switch (kind) {
    case SetKind::Node:
      return nodes_;
    case SetKind::Part:
      return parts_;
    case SetKind::Shell:
      return shells_;
    case SetKind::Solid:
      return solids_;
    case SetKind::Beam:
      return beams_;
    case SetKind::Discrete:
      break;
  }
  return discretes_;
}

namespace {

template <class Elements>
void add_nodes_of(const Elements& elements, DeckId part, std::vector<DeckId>& nodes) {
  for (const auto& element : elements)
    if (element.part == part)
      for (const DeckId node : element.nodes)
        if (node.given()) nodes.push_back(node);
}

template <class Elements>
void add_elements_of(const Elements& elements, DeckId part, std::vector<DeckId>& ids) {
  for (const auto& element : elements)
    if (element.part == part) ids.push_back(element.id);
}

}  // namespace

std::vector<DeckId> DeckIndex::nodes_of_part(DeckId part) const {
  std::vector<DeckId> nodes;
  add_nodes_of(deck_->solids, part, nodes);
  add_nodes_of(deck_->shells, part, nodes);
  add_nodes_of(deck_->thick_shells, part, nodes);
  add_nodes_of(deck_->beams, part, nodes);
  add_nodes_of(deck_->discretes, part, nodes);
  add_nodes_of(deck_->seatbelts, part, nodes);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Gathers the members of one set; sums of sets are followed once each, so cycles end.
class DeckIndex::Expander {
 public:
  Expander(const DeckIndex& index, SetKind kind, std::vector<std::string>* unknown)
      : index_(index), kind_(kind), unknown_(unknown) {}

  std::vector<DeckId> run(DeckId id) {
    add_set(id);
    return std::move(out_);
  }

 private:
  void add_set(DeckId id) {
    std::vector<DeckId> waiting{id};
    while (!waiting.empty()) {
      const DeckId next = waiting.back();
      waiting.pop_back();
      const DeckSet* set = index_.set(kind_, next);
      if (set == nullptr || !followed_.insert(next).second) continue;
      add(set->ids);
      for (const auto& [first, last] : set->ranges) add_range(first, last);
      for (const GeneralEntry& entry : set->general) add_general(*set, entry);
      waiting.insert(waiting.end(), set->added_sets.rbegin(), set->added_sets.rend());
    }
  }

  void add(const std::vector<DeckId>& ids) {
    for (const DeckId id : ids)
      if (seen_.insert(id).second) out_.push_back(id);
  }
  void remove(const std::vector<DeckId>& ids) {
    const std::unordered_set<DeckId> gone(ids.begin(), ids.end());
    std::erase_if(out_, [&](DeckId id) { return gone.contains(id); });
    for (const DeckId id : ids) seen_.erase(id);
  }

  void add_range(DeckId first, DeckId last) {
    const auto& entries = index_.elements(kind_).entries();
    auto at = std::lower_bound(entries.begin(), entries.end(), first,
                               [](const auto& entry, DeckId key) { return entry.first < key; });
    std::vector<DeckId> ids;
    for (; at != entries.end() && at->first <= last; ++at) ids.push_back(at->first);
    add(ids);
  }

  std::vector<DeckId> of_part(DeckId part) const {
    const Deck& deck = index_.deck();
    std::vector<DeckId> ids;
    if (kind_ == SetKind::Node) return index_.nodes_of_part(part);
    if (kind_ == SetKind::Part) return {part};
    if (kind_ == SetKind::Shell) add_elements_of(deck.shells, part, ids);
    if (kind_ == SetKind::Solid) add_elements_of(deck.solids, part, ids);
    if (kind_ == SetKind::Beam) add_elements_of(deck.beams, part, ids);
    if (kind_ == SetKind::Discrete) add_elements_of(deck.discretes, part, ids);
    return ids;
  }

  std::vector<DeckId> in_box(DeckId id) const {
    std::vector<DeckId> ids;
    const DefinedBox* box = index_.box(id);
    if (box == nullptr) return ids;
    for (const DeckNode& node : index_.deck().nodes)
      if ((node.position.array() >= box->low.array()).all() &&
          (node.position.array() <= box->high.array()).all())
        ids.push_back(node.id);
    return ids;
  }

  /// ALL, PART, BOX, and the plain name of the members; with a D in front they are taken away.
  void add_general(const DeckSet& set, const GeneralEntry& entry) {
    constexpr const char* kOwn[] = {"NODE", "PART", "ELEM", "ELEM", "ELEM", "ELEM"};
    constexpr const char* kOwnByKind[] = {"NODE", "PART", "SHELL", "SOLID", "BEAM", "DISCRETE"};
    std::string option = entry.option;
    const auto is_own = [&](const std::string& word) {
      return word == kOwn[static_cast<int>(kind_)] || word == kOwnByKind[static_cast<int>(kind_)];
    };
    const bool is_removal = option.size() > 1 && option.front() == 'D' && !is_own(option);
    if (is_removal) option.erase(0, 1);
    std::vector<DeckId> ids;
    if (option == "ALL") {
      for (const auto& [id, at] : index_.elements(kind_).entries()) ids.push_back(id);
    } else if (is_own(option)) {
      ids = entry.ids;
    } else if (option == "PART") {
      for (const DeckId part : entry.ids)
        for (const DeckId id : of_part(part)) ids.push_back(id);
    } else if (option == "BOX" && kind_ == SetKind::Node) {
      for (const DeckId box : entry.ids)
        for (const DeckId id : in_box(box)) ids.push_back(id);
    } else {
      if (unknown_ != nullptr)
        unknown_->push_back(fmt::format("set {}: GENERAL option {}", set.id.value, entry.option));
      return;
    }
    is_removal ? remove(ids) : add(ids);
  }

  const DeckIndex& index_;
  SetKind kind_;
  std::vector<std::string>* unknown_;
  std::vector<DeckId> out_;
  std::unordered_set<DeckId> seen_, followed_;
};

std::vector<DeckId> DeckIndex::members(SetKind kind, DeckId id,
                                       std::vector<std::string>* unknown) const {
  return Expander(*this, kind, unknown).run(id);
}

}  // namespace crosswalk::fe
