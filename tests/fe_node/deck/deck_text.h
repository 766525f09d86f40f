// Reads a deck from text in tests, and shows its problems when one is not expected.
#pragma once

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fe_node/deck/keyword_reader.h"

namespace crosswalk::fe {

inline std::string all_problems(const DeckProblems& problems) {
  std::string out;
  for (const Problem& problem : problems.errors.kept()) out += "error " + problem.text() + '\n';
  for (const Problem& problem : problems.warnings.kept()) out += "warning " + problem.text() + '\n';
  return out;
}

inline ReadDeck read_text(const std::string& text) {
  return read_deck_text(text, "test.k",
                        {.includes = ReadOptions::Includes::Ignore, .include_paths = {}});
}

/// The deck of a text that must read without a problem.
inline Deck sound(const std::string& text) {
  ReadDeck read = read_text(text);
  EXPECT_EQ(all_problems(read.problems), "");
  return std::move(read.deck);
}

/// The errors of a text, one a line.
inline std::string errors_of(const std::string& text) {
  const ReadDeck read = read_text(text);
  std::string out;
  for (const Problem& problem : read.problems.errors.kept()) out += problem.text() + '\n';
  return out;
}

}  // namespace crosswalk::fe
