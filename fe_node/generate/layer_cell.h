// The cell of a layer between two quads that may share corners: a brick, a wedge, or the pyramids
// and tetrahedra in which a layer runs out at a corner of its outline. All are bricks with repeated
// nodes.
#pragma once

#include <array>

#include "fe_node/generate/mesh_draft.h"

namespace crosswalk::fe::generate {

/// `top[c]` lies above `bottom[c]` or is the same node; both run anticlockwise seen from above.
void add_layer_cell(MeshDraft& draft, std::array<int, 4> bottom, std::array<int, 4> top, int part);

}  // namespace crosswalk::fe::generate
