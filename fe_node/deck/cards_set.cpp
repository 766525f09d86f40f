// *SET_ cards of every kind: lists, columns, ranges, GENERAL rules, sums of sets, segments.
#include "fe_node/deck/keyword_table.h"

namespace crosswalk::fe {

namespace {

template <class Set>
void head(CardIo& io, Set& set) {
  io.card();
  io.id("SID", set.id);
  io.reals("DA", set.attributes);
  io.text("SOLVER", set.solver);
}

enum class Form { List, Column, Ranges, General, Sum };

void ranges(CardIo& io, std::vector<std::pair<DeckId, DeckId>>& values) {
  constexpr std::size_t kPerCard = 4;
  if (io.is_reading()) {
    while (io.has_content()) {
      io.card();
      for (std::size_t i = 0; i < kPerCard; ++i) {
        std::pair<DeckId, DeckId> range;
        io.id("BBEG", range.first);
        io.id("BEND", range.second);
        if (range.first.given() || range.second.given()) values.push_back(range);
      }
    }
    return;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % kPerCard == 0) io.card();
    io.id("BBEG", values[i].first);
    io.id("BEND", values[i].second);
  }
}

void general(CardIo& io, std::vector<GeneralEntry>& values) {
  io.rows(values, [&io](GeneralEntry& entry) {
    io.card();
    io.text("OPTION", entry.option);
    entry.ids.resize(7);
    for (DeckId& id : entry.ids) io.id("E", id);
    while (!entry.ids.empty() && !entry.ids.back().given()) entry.ids.pop_back();
  });
}

void column(CardIo& io, std::vector<DeckId>& values) {
  io.rows(values, [&io](DeckId& id) {
    io.card();
    io.id("ID", id);
  });
}

void body(CardIo& io, DeckSet& set, Form form) {
  switch (form) {
    case Form::List:
      return io.id_list("ID", set.ids);
    case Form::Column:
      return column(io, set.ids);
    case Form::Ranges:
      return ranges(io, set.ranges);
    case Form::General:
      return general(io, set.general);
    case Form::Sum:
      return io.id_list("SID", set.added_sets);
  }
}

Form form_of(const KeywordBlock& block) {
  if (block.has("COLUMN")) return Form::Column;
  if (block.has("GENERATE")) return Form::Ranges;
  if (block.has("GENERAL")) return Form::General;
  return block.has("ADD") ? Form::Sum : Form::List;
}

template <SetKind Kind>
void read_set(KeywordBlock& block) {
  DeckSet set;
  set.kind = Kind;
  set.source = block.io.keyword_source();
  block.read_title(set.title);
  head(block.io, set);
  body(block.io, set, form_of(block));
  block.deck.sets.push_back(std::move(set));
}

void segment_body(CardIo& io, SegmentSet& set, bool is_general) {
  if (is_general) return general(io, set.general);
  io.rows(set.segments, [&io](std::array<DeckId, 4>& segment) {
    io.card();
    constexpr std::array<const char*, 4> kNames{"N1", "N2", "N3", "N4"};
    for (std::size_t i = 0; i < 4; ++i) io.id(kNames[i], segment[i]);
    if (!segment[3].given()) segment[3] = segment[2];
  });
}

void read_segments(KeywordBlock& block) {
  SegmentSet set;
  set.source = block.io.keyword_source();
  block.read_title(set.title);
  head(block.io, set);
  segment_body(block.io, set, block.has("GENERAL"));
  block.deck.segment_sets.push_back(std::move(set));
}

const std::vector<KeywordEntry>& entries() {
  static const std::vector<std::string_view> kForms{"LIST",    "COLUMN", "GENERATE",
                                                    "GENERAL", "ADD",    "TITLE"};
  static const std::vector<KeywordEntry> kEntries{
      {"SET_NODE", kForms, read_set<SetKind::Node>},
      {"SET_PART", kForms, read_set<SetKind::Part>},
      {"SET_SHELL", kForms, read_set<SetKind::Shell>},
      {"SET_SOLID", kForms, read_set<SetKind::Solid>},
      {"SET_BEAM", kForms, read_set<SetKind::Beam>},
      {"SET_DISCRETE", kForms, read_set<SetKind::Discrete>},
      {"SET_SEGMENT", {"GENERAL", "TITLE"}, read_segments},
  };
  return kEntries;
}

/// The forms a record holds; a set read from a deck has exactly one, or none (an empty list).
void write_set(CardWriter& out, DeckSet set) {
  constexpr const char* kNames[] = {"SET_NODE",  "SET_PART", "SET_SHELL",
                                    "SET_SOLID", "SET_BEAM", "SET_DISCRETE"};
  const std::string name = kNames[static_cast<int>(set.kind)];
  Form form = Form::List;
  std::string suffix = "_LIST";
  if (!set.ranges.empty()) {
    form = Form::Ranges;
    suffix = "_LIST_GENERATE";
  } else if (!set.general.empty()) {
    form = Form::General;
    suffix = "_GENERAL";
  } else if (!set.added_sets.empty()) {
    form = Form::Sum;
    suffix = "_ADD";
  }
  out.keyword_with_title(name + suffix, set.title);
  head(out, set);
  body(out, set, form);
}

}  // namespace

std::span<const KeywordEntry> set_keywords() { return entries(); }

void write_sets(CardWriter& out, const Deck& deck) {
  for (const DeckSet& set : deck.sets) write_set(out, set);
  for (SegmentSet set : deck.segment_sets) {
    out.keyword_with_title(set.general.empty() ? "SET_SEGMENT" : "SET_SEGMENT_GENERAL", set.title);
    head(out, set);
    segment_body(out, set, !set.general.empty());
  }
}

}  // namespace crosswalk::fe
