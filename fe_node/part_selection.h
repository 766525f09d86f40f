// Parts of a deck as a user names them: the title of a part set, or a list of part numbers and
// titles, separated by commas.
#pragma once

#include <string>
#include <vector>

#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

/// In the order of the deck's parts. Names that are no part are problems of `what`, all at once;
/// throws UserError.
std::vector<DeckId> select_parts(const Deck& deck, const std::string& names,
                                 const std::string& what);

/// The nodes of a node set of that title; without one, those of the parts that `names` selects.
std::vector<DeckId> select_nodes(const Deck& deck, const std::string& names,
                                 const std::string& what);

}  // namespace crosswalk::fe
