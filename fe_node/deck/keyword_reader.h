// Reads a keyword deck with all its includes into a Deck.
//
// Never throws for what a deck holds: every problem is listed with its place. What the reader does
// not interpret is kept in Deck::unread with the effect of leaving it out; runnable.h tells whether
// the outcome can be run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fe_node/deck/deck.h"
#include "fe_node/deck/deck_problems.h"

namespace crosswalk::fe {

struct ReadOptions {
  enum class Includes { Follow, Ignore };
  Includes includes = Includes::Follow;
  std::vector<std::filesystem::path> include_paths;  ///< searched after the decks' own folders
};

struct ReadDeck {
  Deck deck;
  DeckProblems problems;
};

ReadDeck read_deck(const std::filesystem::path& path, const ReadOptions& options = {});
/// From memory; `name` stands in messages, includes are relative to the working folder.
ReadDeck read_deck_text(std::string text, const std::string& name, const ReadOptions& options = {});

}  // namespace crosswalk::fe
