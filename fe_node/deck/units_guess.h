// Which unit system a deck is written in, when it does not say.
//
// Every system is tried on what the deck tells of densities, moduli, size, end time, speeds and
// gravity; the one whose SI values look most like a crash or impact model is named, with the
// reasons. A close second makes the guess ambiguous.
#pragma once

#include <string>
#include <vector>

#include "fe_node/deck/deck.h"
#include "fe_node/deck/deck_problems.h"

namespace crosswalk::fe {

struct UnitsGuess {
  enum class Certainty { Stated, Likely, Ambiguous, None };
  UnitSystem system = UnitSystem::Unknown;
  Certainty certainty = Certainty::None;
  UnitSystem second = UnitSystem::Unknown;  ///< the runner-up of an ambiguous guess
  std::vector<std::string> reasons;         ///< "density 7.83e-06 -> 7830 kg/m3"
};

UnitsGuess guess_units(const Deck& deck);
/// Warns when the numbers speak clearly against the system that is stated.
void check_units(const Deck& deck, DeckProblems& problems);

}  // namespace crosswalk::fe
