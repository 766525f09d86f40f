// A model draft written as keyword records in a unit system of the field.
//
// Nodes are numbered in draft order, elements in one row: solids, shells, beams, springs, masses. A
// material has its part's number; its title carries source and grade.
#pragma once

#include "fe_node/deck/deck.h"
#include "fe_node/generate/part_spec.h"

namespace crosswalk::fe::generate {

/// Where the numbers of a deck start, so that decks can be put together.
struct DeckNumbers {
  int node = 1, element = 1;
  int section = 1, hourglass = 1, set = 1;
};

Deck to_deck(const ModelDraft& draft, UnitSystem units, const DeckNumbers& first = {});

}  // namespace crosswalk::fe::generate
