// The table of keywords the reader understands, and what its entries are given.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fe_node/deck/card_reader.h"
#include "fe_node/deck/card_writer.h"
#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

/// One keyword block being read.
struct KeywordBlock {
  Deck& deck;
  CardReader& io;
  DeckProblems& problems;
  std::string base;                  ///< as in the table
  std::vector<std::string> options;  ///< the rest of the keyword: TITLE, ID, THICKNESS ...
  bool has(std::string_view option) const;
  /// The title line of option TITLE.
  void read_title(std::string& title);
  /// The number-and-title line of option ID (or TITLE where the manual gives it the same card).
  void read_id(DeckId& id, std::string& title);
};

/// A keyword without its options, and the options it may carry.
struct KeywordEntry {
  std::string_view base;
  std::vector<std::string_view> options;
  void (*read)(KeywordBlock&);
};

// One pair per family of keywords: its entries, and the writing of its records.
std::span<const KeywordEntry> mesh_keywords();
std::span<const KeywordEntry> part_keywords();
std::span<const KeywordEntry> material_keywords();
std::span<const KeywordEntry> table_keywords();
std::span<const KeywordEntry> set_keywords();
std::span<const KeywordEntry> condition_keywords();
std::span<const KeywordEntry> constraint_keywords();
std::span<const KeywordEntry> control_keywords();

/// Reads *CONTACT_ (`keyword` without that); false when its kind is not supported.
bool read_contact(KeywordBlock& block, const std::string& keyword);
/// Reads *DATABASE_ (`keyword` without that) when it is an output interval; else false.
bool read_database(KeywordBlock& block, const std::string& keyword);
/// A *MAT_ keyword outside the table: its id and its cards as text.
void read_unsupported_material(KeywordBlock& block, const std::string& keyword);

void write_mesh(CardWriter& out, const Deck& deck);
void write_parts(CardWriter& out, const Deck& deck);
void write_materials(CardWriter& out, const Deck& deck);
void write_tables(CardWriter& out, const Deck& deck);
void write_sets(CardWriter& out, const Deck& deck);
void write_conditions(CardWriter& out, const Deck& deck);
void write_constraints(CardWriter& out, const Deck& deck);
void write_contacts(CardWriter& out, const Deck& deck);
void write_control(CardWriter& out, const Deck& deck);

/// Reads records of one kind until the block ends: `cards(io, record)` for each.
template <class Record, class Cards>
void read_records(KeywordBlock& block, std::vector<Record>& into, Cards cards) {
  while (block.io.has_content()) {
    block.io.restart_numbering();
    Record record;
    cards(block.io, record);
    record.source = block.io.source();
    into.push_back(std::move(record));
  }
}

/// Writes records of one kind under one keyword.
template <class Record, class Cards>
void write_records(CardWriter& out, const std::string& keyword, const std::vector<Record>& records,
                   Cards cards) {
  if (records.empty()) return;
  out.keyword(keyword);
  for (Record record : records) cards(out, record);
}

}  // namespace crosswalk::fe
