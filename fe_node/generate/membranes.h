// Membranes of the cranium on faces of its bricks, with shared nodes: dura under the skull, pia on
// the brain, falx between the hemispheres, tentorium over the cerebellum. Frame F (head_shape.h).
//
// The falx lies in the mid-plane in the outer 45 % of the brain and reaches through the CSF to the
// skull; its lower edge is free above the callosum. The tentorium follows the brick faces above the
// cerebellum and leaves a notch for the brainstem; the petrous bones hold its front edge beside the
// notch. Both have CSF on either side (sheet_fluid.h). Outlines and gaps are estimates [E].
#pragma once

#include <vector>

#include "fe_node/generate/head_mesh.h"

namespace crosswalk::fe::generate {

/// Adds the quads to a draft that holds the cranium and its tables and nothing else. Returns the
/// nodes of the tentorium's front edge beside the notch, short of the skull.
std::vector<int> add_membranes(MeshDraft& draft, const HeadMesh& head, const HeadShape& shape);

}  // namespace crosswalk::fe::generate
