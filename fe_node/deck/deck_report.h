// The report of `check DECK`: what a deck holds, what is not interpreted and what that means, what
// is missing or wrong, and whether it can be run.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fe_node/deck/keyword_reader.h"

namespace crosswalk::fe {

struct DeckReport {
  std::string text;
  bool is_sound = false;  ///< no error, no missing file, nothing left out that changes the physics
};

/// Tries what running the deck would begin with: adds what stands against it, returns lines to
/// tell.
using ModelTrial =
    std::function<std::vector<std::string>(const Deck& deck, DeckProblems& problems)>;

/// Reads, checks and reports; never throws for what the deck holds.
DeckReport report_deck(const std::filesystem::path& path, const ReadOptions& options = {});
/// The report of a deck that was read; adds what the whole-deck checks find to its problems. A deck
/// without errors that is complete is tried as well.
DeckReport report_deck(ReadDeck& read, const std::string& name, const ModelTrial& trial = {});

}  // namespace crosswalk::fe
