// A new place for everything in a deck: the transformation of *INCLUDE_TRANSFORM.
//
// Points go where the map sends them; directions, velocities and inertia tensors in global axes
// turn with its rotation. What acts along the global axes themselves (fixed directions, prescribed
// motion, loads, gravity) is left alone and told. SCALE changes positions only, not thicknesses,
// masses or springs.
#pragma once

#include "fe_node/deck/affine_map.h"

namespace crosswalk::fe {

void move_deck(Deck& deck, const AffineMap& map, DeckProblems& problems);

}  // namespace crosswalk::fe
