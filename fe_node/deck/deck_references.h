// Every place where one record of a deck names another by its id.
#pragma once

#include <functional>
#include <string>

#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

enum class Named {
  Node,
  Part,
  Section,
  Material,
  EquationOfState,
  Hourglass,
  Integration,
  Curve,
  NodeSet,
  PartSet,
  ShellSet,
  SolidSet,
  BeamSet,
  DiscreteSet,
  SegmentSet,
  Axes,
  Vector,
  SpringOrientation,
  Box,
  Joint
};
const char* named_word(Named kind);

/// One reference: which record makes it ("part 3", "*CONTACT_... 7") and where, and what it names.
struct Reference {
  std::string by;
  Source source;
  Named kind;
  DeckId id;
};

/// Calls `visit` for every reference with a given id (0 is none; curve ids lose their sign).
/// Elements are left out: deck_check looks at their nodes and parts itself.
void for_each_reference(const Deck& deck, const std::function<void(const Reference&)>& visit);

}  // namespace crosswalk::fe
