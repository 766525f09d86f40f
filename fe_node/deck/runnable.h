// Whether a deck that was read can be run.
#pragma once

#include "fe_node/deck/keyword_reader.h"

namespace crosswalk::fe {

enum class MissingPolicy { Refuse, Accept };

/// Runs the whole-deck checks, which add to the deck's problems. Throws UserError with all errors,
/// and with missing includes and unread keywords that change the physics unless those are accepted.
void require_runnable(ReadDeck& read, MissingPolicy policy);

}  // namespace crosswalk::fe
