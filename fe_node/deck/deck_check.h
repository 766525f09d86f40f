// Checks that need the whole deck: doubled and dangling ids, elements that have no volume or are
// inside out, values no law can take.
#pragma once

#include "fe_node/deck/deck_index.h"
#include "fe_node/deck/deck_problems.h"

namespace crosswalk::fe {

/// Adds to `problems`. While includes are missing, dangling ids are warnings: what they name may be
/// in those files.
void check_deck(const DeckIndex& index, DeckProblems& problems);

/// The parts of check_deck().
void check_ids(const Deck& deck, DeckProblems& problems);
void check_references(const DeckIndex& index, DeckProblems& problems);
void check_elements(const DeckIndex& index, DeckProblems& problems);
void check_values(const DeckIndex& index, DeckProblems& problems);

}  // namespace crosswalk::fe
