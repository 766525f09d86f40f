// Reads what a body touches the world with: surface ellipsoids, their flesh, contacts with itself.
#pragma once

#include "common/body_description.h"
#include "common/body_formulas.h"
#include "common/config.h"

namespace crosswalk {

/// Fills regions, ellipsoids, bushings, self-contacts and contact settings of a body whose segments
/// stand. With the girth ratio g and the length ratio l of a region penetrations go with g and
/// forces with g l: flesh of one material.
void read_surface(ConfigTable& subject, const BodyFormulas& formulas, BodyDescription& body);

}  // namespace crosswalk
