// A head without its neck: what two reference methods run instead of the coupled model.
#pragma once

#include <string>

#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

/// Leaves the parts of the set `head` in the deck, with the nodes, sets, masses, contacts and
/// constraints that belong to them alone. Loads, motions and requests of the deck go as well.
void keep_head_alone(Deck& deck);

/// Makes the nodes of the set `skull_fit` one rigid body of that title, together with the rigid
/// parts that share some of them.
void drive_skull(Deck& deck, const std::string& title);

}  // namespace crosswalk::fe
