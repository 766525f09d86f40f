// What each part of a deck consists of: element counts by kind and mass, in the deck's units.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fe_node/deck/deck_index.h"

namespace crosswalk::fe {

struct PartRow {
  const Part* part = nullptr;
  std::map<std::string, long> elements;  ///< "hex8", "quad4", "beam" ... and how many
  double mass = 0;        ///< from density and geometry, or as *PART_INERTIA gives it
  double added_mass = 0;  ///< *ELEMENT_MASS_PART
};

struct PartTable {
  std::vector<PartRow> rows;             ///< in the order of the deck
  std::map<std::string, long> elements;  ///< of the whole deck, parts known or not
  double nodal_mass = 0;                 ///< *ELEMENT_MASS and *ELEMENT_INERTIA
  double mass() const;
};

/// Cross-section area of a beam section, deck units; 0 where it has none (discrete beams).
double beam_area(const SectionBeam& beam);

PartTable part_table(const DeckIndex& index);

}  // namespace crosswalk::fe
