// What a deck says about its units: `$ crosswalk: unit_system=NAME` and *CONTROL_UNITS.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fe_node/deck/card_io.h"
#include "fe_node/deck/deck.h"
#include "fe_node/deck/deck_problems.h"

namespace crosswalk::fe {

void read_control_units(CardIo& io, Deck& deck);
void read_directives(const std::vector<std::pair<std::string, Source>>& directives, Deck& deck,
                     DeckProblems& problems);

}  // namespace crosswalk::fe
