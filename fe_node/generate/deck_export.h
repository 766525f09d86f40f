// A model draft written as keyword records in a unit system of the field.
//
// Node ids are draft indices + 1; elements are numbered in one row: solids, shells, beams, springs.
// A material has its part's number; its title carries source and grade.
#pragma once

#include "fe_node/deck/deck.h"
#include "fe_node/generate/part_spec.h"

namespace crosswalk::fe::generate {

Deck to_deck(const ModelDraft& draft, UnitSystem units);

}  // namespace crosswalk::fe::generate
