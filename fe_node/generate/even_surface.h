// Evens out the quads of the cubed sphere on the head. Where the cranium is flat, under the
// forehead, equal angles make narrow and oblique cells, and a few of them would set the time step
// of the whole model.
#pragma once

#include <vector>

#include "fe_node/generate/head_shape.h"
#include "fe_node/generate/primitives.h"

namespace crosswalk::fe::generate {

/// Directions for the surface nodes of the sphere, found from those it has. A corner with edges a
/// and b is measured by (|a|^2 + |b|^2) / |a x b|^2, to which the square of the highest frequency
/// of a cell is proportional (2 / h^2 for a square), on the outside of the skull. In every sweep
/// each node of one half tries small moves over the surface and keeps the one with the least sum of
/// cubes over its cells' corners; the other half is its mirror image, the mid-plane keeps its
/// nodes.
std::vector<Vec3> even_directions(const CubedSphere& sphere, const HeadShape& shape, int sweeps);

}  // namespace crosswalk::fe::generate
