// *PARAMETER and its forms: names with values, expressions and their scope.
#pragma once

#include <string>

#include "fe_node/deck/card_reader.h"
#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

/// Reads the block when `keyword` is PARAMETER[_EXPRESSION][_LOCAL] or PARAMETER_DUPLICATION.
bool read_parameter_keyword(const std::string& keyword, CardReader& io, Parameters& parameters,
                            DeckProblems& problems, const Deck& deck);

}  // namespace crosswalk::fe
