// The report of `check DECK`: what a deck holds, what is not interpreted and what that means, what
// is missing or wrong, and whether it can be run.
#pragma once

#include <filesystem>
#include <string>

#include "fe_node/deck/keyword_reader.h"

namespace crosswalk::fe {

struct DeckReport {
  std::string text;
  bool is_sound = false;  ///< no error, no missing file, nothing left out that changes the physics
};

/// Reads, checks and reports; never throws for what the deck holds.
DeckReport report_deck(const std::filesystem::path& path, const ReadOptions& options = {});
/// The report of a deck that was read; adds what the whole-deck checks find to its problems.
DeckReport report_deck(ReadDeck& read, const std::string& name);

}  // namespace crosswalk::fe
