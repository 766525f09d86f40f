// Skull of the head: two tables of cortical bone as shells on the bricks of the diploe, the rigid
// base round the condyles and the foramen magnum. Frame F (head_shape.h).
//
// The bricks fill the whole skull and have the diploe's law; the tables share the nodes of their
// outer and inner faces and lie inwards of them (NLOC of *SECTION_SHELL), so that scalp, skull and
// CSF keep their thickness and the tables their distance. Each quad has the local thickness of its
// table. Where the bricks are rigid there are none.
//
// The foramen magnum is an opening of 15 mm radius through the base. Spinal cord fills it, held by
// its rim and free below: the dural sac of the spine lies in fat and veins and gives way, so the
// canal takes what the brain case gives at no pressure worth mention in a blow's milliseconds.
#pragma once

#include <vector>

#include "fe_node/generate/head_mesh.h"
#include "fe_node/generate/part_spec.h"

namespace crosswalk::fe::generate {

/// Makes bricks of the skull rigid round the condyles, and spinal cord in the foramen.
void mark_skull_base(MeshDraft& draft, const HeadMesh& head, const HeadShape& shape,
                     const Vec3& condyles, int rigid_part);

/// Part of the innermost brick of the skull on each surface quad.
std::vector<int> skull_parts(const MeshDraft& draft, const HeadMesh& head);

/// Outer and inner table on the deformable bricks of a skull whose base is marked.
void add_tables(MeshDraft& draft, const HeadMesh& head, const HeadShape& shape);

/// Density of the diploe's bricks: of the space that the tables leave, kg/m3.
double diploe_density(const ModelDraft& draft, double of_tissue);

/// Those of the nodes that a brick of bone holds.
std::vector<int> on_bone(const MeshDraft& draft, const std::vector<int>& nodes, int rigid_part);

}  // namespace crosswalk::fe::generate
