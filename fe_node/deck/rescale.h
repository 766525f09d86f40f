// Other units for everything in a deck: the unit factors of *INCLUDE_TRANSFORM.
//
// Every number with a dimension is multiplied. A curve has the dimensions of the fields that name
// it; one that two fields read as different quantities, or that belongs to a law whose dimensions
// are not known here, is an error and never left half converted in silence.
#pragma once

#include "fe_node/deck/deck.h"
#include "fe_node/deck/deck_problems.h"

namespace crosswalk::fe {

/// `factors`: what one present unit of length, mass and time is in the new ones.
void rescale(Deck& deck, const UnitFactors& factors, DeckProblems& problems);

}  // namespace crosswalk::fe
