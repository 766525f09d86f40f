// Nodes tied to facets by stiff springs, offsets kept: each node stays at its place over the facet,
// point + offset x normal. The spring's force and the facet's forces balance exactly, moments
// included, so a rigid motion of both costs nothing and momenta are kept. Stiffness is the most
// the step allows, m* / (4 dt^2) (penalty.h).
#pragma once

#include <memory>

#include "fe_node/contact/contact.h"
#include "fe_node/contact/surface.h"

namespace crosswalk::fe {

struct TiedSettings {
  double nominal_step = 0;  ///< s; the solver's step
  /// Nodes are tied when nearer than this to their facet, m; 0: 0.6 (t1 + t2) and 5 % of the
  /// smaller diagonal, whichever is larger [hallquist2006, 26.10].
  double tolerance = 0;
};

/// Nodes that find no facet stay free, those whose facet's element has failed come free; `active`
/// of the report counts the tied ones.
std::unique_ptr<ContactInterface> make_tied_contact(std::string name, ContactSurface nodes,
                                                    ContactSurface facets,
                                                    const TiedSettings& settings);

}  // namespace crosswalk::fe
