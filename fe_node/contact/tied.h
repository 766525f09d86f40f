// Nodes tied to facets for good (tie.h).
#pragma once

#include <memory>

#include "fe_node/contact/contact.h"
#include "fe_node/contact/surface.h"

namespace crosswalk::fe {

struct TiedSettings {
  double nominal_step = 0;  ///< s; the solver's step
  double tolerance = 0;     ///< m; see tie_tolerance()
};

/// Nodes that find no facet stay free, those whose facet's element has failed come free; `active`
/// of the report counts the tied ones.
std::unique_ptr<ContactInterface> make_tied_contact(std::string name, ContactSurface nodes,
                                                    ContactSurface facets,
                                                    const TiedSettings& settings);

}  // namespace crosswalk::fe
