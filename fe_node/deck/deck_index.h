// Finds the records of a deck by user id, and expands sets.
//
// Holds pointers into the deck, which must outlive it unchanged. Of two records with one id the
// first is found.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

/// Ids and where they stand in their list.
class IdTable {
 public:
  template <class Record>
  explicit IdTable(const std::vector<Record>& records) {
    entries_.reserve(records.size());
    for (std::size_t i = 0; i < records.size(); ++i)
      entries_.emplace_back(records[i].id, static_cast<std::int32_t>(i));
    sort();
  }
  IdTable() = default;
  void add(DeckId id, std::int32_t index) { entries_.emplace_back(id, index); }
  void sort();
  /// Index in the list, or -1.
  std::int32_t find(DeckId id) const;
  bool has(DeckId id) const { return find(id) >= 0; }
  /// All (id, index) in the order of ids.
  const std::vector<std::pair<DeckId, std::int32_t>>& entries() const { return entries_; }

 private:
  std::vector<std::pair<DeckId, std::int32_t>> entries_;
};

class DeckIndex {
 public:
  explicit DeckIndex(const Deck& deck);
  const Deck& deck() const { return *deck_; }

  const DeckNode* node(DeckId id) const { return at(deck_->nodes, nodes_, id); }
  const Part* part(DeckId id) const { return at(deck_->parts, parts_, id); }
  const Section* section(DeckId id) const { return at(deck_->sections, sections_, id); }
  const Material* material(DeckId id) const { return at(deck_->materials, materials_, id); }
  const Hourglass* hourglass(DeckId id) const { return at(deck_->hourglasses, hourglasses_, id); }
  const DeckCurve* curve(DeckId id) const { return at(deck_->curves, curves_, id); }
  const DeckTable* table(DeckId id) const { return at(deck_->tables, tables_, id); }
  const DefinedVector* vector(DeckId id) const { return at(deck_->vectors, vectors_, id); }
  const DefinedBox* box(DeckId id) const { return at(deck_->boxes, boxes_, id); }
  const DeckSet* set(SetKind kind, DeckId id) const;
  const SegmentSet* segment_set(DeckId id) const {
    return at(deck_->segment_sets, segment_sets_, id);
  }
  /// Index of a node in Deck::nodes, or -1.
  std::int32_t node_index(DeckId id) const { return nodes_.find(id); }

  /// Members of a set: lists, existing ids of ranges, GENERAL rules, sums; each once, in order of
  /// appearance. What cannot be expanded is named in `unknown` (set, then reason). A set that does
  /// not exist is empty.
  std::vector<DeckId> members(SetKind kind, DeckId id,
                              std::vector<std::string>* unknown = nullptr) const;
  /// Nodes of all elements of a part, in the order of ids.
  std::vector<DeckId> nodes_of_part(DeckId part) const;

 private:
  template <class Record>
  static const Record* at(const std::vector<Record>& records, const IdTable& table, DeckId id) {
    const std::int32_t index = table.find(id);
    return index < 0 ? nullptr : &records[static_cast<std::size_t>(index)];
  }
  const IdTable& elements(SetKind kind) const;
  class Expander;

  const Deck* deck_;
  IdTable nodes_, parts_, sections_, materials_, hourglasses_, curves_, tables_, vectors_, boxes_,
      segment_sets_, solids_, shells_, beams_, discretes_;
  IdTable sets_[6];  ///< by SetKind
};

}  // namespace crosswalk::fe
