// Writes a Deck as keyword text that this reader and other programs read.
//
// Order and format depend on the content only. Reading the text gives an equal Deck, numbers to
// within CardWriter::kWrittenPrecision; keywords that were kept as text are written as they stood.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

void write_deck(std::ostream& out, const Deck& deck);
std::string deck_text(const Deck& deck);
/// Throws UserError when the file cannot be written.
void write_deck(const std::filesystem::path& path, const Deck& deck);

}  // namespace crosswalk::fe
