// A head and neck deck that somebody else made, brought to the form of the generated one: rigid
// parts `block_<body>` for the attached bodies, part sets `head`, `brain` and `outer_surface`, node
// set `skull_fit`. The scenario's mapping says which parts those are; the deck's elements, laws and
// numbers stay as they are.
#pragma once

#include "fe_node/deck/deck.h"
#include "fe_node/fe_config.h"

namespace crosswalk::fe {

/// Titles of the generated deck, and of an adapted one.
inline constexpr const char* kHeadParts = "head";
inline constexpr const char* kBrainParts = "brain";
inline constexpr const char* kHeadSurface = "outer_surface";
inline constexpr const char* kSkullNodes = "skull_fit";

/// Title of the rigid part that follows an attached body.
std::string block_title(const std::string& body);

/// True for a part of *MAT_RIGID.
bool is_rigid(const Deck& deck, const Part& part);

/// Reads and adapts the deck of the scenario.
Deck read_own_deck(const FeConfig& config);

/// Throws UserError with everything that the mapping names and the deck lacks.
void adapt_deck(Deck& deck, const HeadNeckConfig& config,
                const std::vector<InterfaceSpec>& interfaces);

}  // namespace crosswalk::fe
