#include "fe_node/part_selection.h"

#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>

#include "common/error.h"
#include "fe_node/deck/deck_index.h"

namespace crosswalk::fe {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> split(const std::string& names) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  while (begin <= names.size()) {
    const std::size_t comma = std::min(names.find(',', begin), names.size());
    words.push_back(trimmed(names.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  return words;
}

const DeckSet* set_titled(const Deck& deck, SetKind kind, const std::string& title) {
  for (const DeckSet& set : deck.sets)
    if (set.kind == kind && trimmed(set.title) == title) return &set;
  return nullptr;
}

const Part* part_named(const Deck& deck, const std::string& word) {
  int number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_number = error == std::errc{} && end == word.data() + word.size();
  for (const Part& part : deck.parts)
    if (is_number ? part.id.value == number : trimmed(part.title) == word) return &part;
  return nullptr;
}

std::string known_names(const Deck& deck, SetKind kind) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> names;
  for (const DeckSet& set : deck.sets)
    if (set.kind == kind && !set.title.empty()) names.push_back(trimmed(set.title));
  for (const Part& part : deck.parts)
    names.push_back(fmt::format("{} '{}'", part.id.value, trimmed(part.title)));
  const bool is_long = names.size() > kMost;
  if (is_long) names.resize(kMost);
  return fmt::format("the deck has {}{}", fmt::join(names, ", "), is_long ? ", ..." : "");
}

}  // namespace

std::vector<DeckId> select_parts(const Deck& deck, const std::string& names,
                                 const std::string& what) {
  std::set<DeckId> chosen;
  if (const DeckSet* set = set_titled(deck, SetKind::Part, names)) {
    const std::vector<DeckId> members = DeckIndex(deck).members(SetKind::Part, set->id);
    chosen.insert(members.begin(), members.end());
  } else {
    Diagnostics problems;
    for (const std::string& word : split(names)) {
      if (const Part* part = part_named(deck, word)) {
        chosen.insert(part->id);
        continue;
      }
      problems.add(Problem{{deck.files.names.empty() ? "" : deck.files.names.front()},
                           what,
                           "the title of a part set, or part numbers and titles",
                           "`" + word + "`",
                           known_names(deck, SetKind::Part)});
    }
    problems.finish();
  }
  std::vector<DeckId> parts;
  for (const Part& part : deck.parts)
    if (chosen.count(part.id) > 0) parts.push_back(part.id);
  return parts;
}

std::vector<DeckId> select_nodes(const Deck& deck, const std::string& names,
                                 const std::string& what) {
  if (const DeckSet* set = set_titled(deck, SetKind::Node, names))
    return DeckIndex(deck).members(SetKind::Node, set->id);
  const std::vector<DeckId> parts = select_parts(deck, names, what);
  const DeckIndex index(deck);
  std::set<DeckId> nodes;
  for (const DeckId part : parts)
    for (const DeckId node : index.nodes_of_part(part)) nodes.insert(node);
  return {nodes.begin(), nodes.end()};
}

}  // namespace crosswalk::fe
