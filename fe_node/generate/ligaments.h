// Ligaments, facet joints and the two pivot joints of the upper neck as lines between rigid bodies.
//
// Ligaments pull only: force over elongation with toe, linear part, failure and softening, one
// normalised shape scaled by failure force and elongation. Facets push only, along struts normal to
// the joint surface. The occipital and atlanto-axial joints are pivots: stiff struts that meet in
// the centre of rotation, so turning is free until ligaments stop it.
#pragma once

#include "fe_node/generate/spine.h"

namespace crosswalk::fe::generate {

void add_ligaments(ModelDraft& draft, const Spine& spine);

}  // namespace crosswalk::fe::generate
