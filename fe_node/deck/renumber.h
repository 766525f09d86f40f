// New numbers for everything in a deck: the id offsets of *INCLUDE_TRANSFORM.
#pragma once

#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

/// What is added to ids of each kind, definitions and references alike. An id of 0 (not given)
/// stays; of a curve with a minus sign the number behind the sign moves.
struct IdOffsets {
  int node = 0, element = 0;
  int part = 0;      ///< also nodal rigid bodies
  int material = 0;  ///< also equations of state
  int set = 0;
  int curve = 0;       ///< also tables and curve functions
  int definition = 0;  ///< everything else from *DEFINE_
  int other = 0;       ///< sections, hourglass, contacts, joints, conditions with numbers ...
  bool operator==(const IdOffsets&) const = default;
};

/// Adds the offsets everywhere. False when an id would leave the range of 32 bits: it then keeps
/// its number.
bool renumber(Deck& deck, const IdOffsets& offsets);

}  // namespace crosswalk::fe
