// *INCLUDE_TRANSFORM: a file read with new numbers, in new units, in a new place.
//
// The content of the file, of what it includes in turn included, is first renumbered, then
// converted by the unit factors, then moved by the *DEFINE_TRANSFORMATION of the including file
// (in that file's length unit), and only then joins the including deck [lstc2014,
// *INCLUDE_TRANSFORM].
#pragma once

#include "fe_node/deck/card_io.h"
#include "fe_node/deck/deck.h"
#include "fe_node/deck/deck_problems.h"
#include "fe_node/deck/renumber.h"

namespace crosswalk::fe {

/// The cards after the file name; all of them may be left out.
struct IncludeTransform {
  IdOffsets offsets;
  UnitFactors factors;    ///< what one unit of the file is in units of the deck
  DeckId transformation;  ///< TRANID
  std::string prefix, suffix, temperature, charge;
  Source source;
  bool changes_units() const {
    return factors.length != 1 || factors.mass != 1 || factors.time != 1;
  }
};

void read_include_transform(CardIo& io, IncludeTransform& card);

/// A file that waits for the transformation it names.
struct TransformedInclude {
  IncludeTransform card;
  Deck content;
};

/// Applies the card to the content and adds it to `deck`, in whose transformations it looks.
void add_transformed(Deck& deck, TransformedInclude include, DeckProblems& problems);

}  // namespace crosswalk::fe
