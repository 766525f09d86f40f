// Volumes, areas and lengths of deck elements, and their worst corner.
//
// The deck's own length unit. Used by checks and the mass table, not by the solver.
#pragma once

#include <span>

#include "fe_node/deck/mesh_records.h"

namespace crosswalk::fe {

/// Size of an element and how good it is: `worst` is the least corner Jacobian over its largest
/// (<= 0: an inverted corner; a zero-volume element has volume 0).
struct Measure {
  double size = 0;   ///< volume, area or length
  double worst = 0;  ///< -1 .. 1
};

Measure solid_measure(SolidShape shape, std::span<const Vec3> nodes);
Measure shell_measure(std::span<const Vec3> nodes);  ///< three or four

}  // namespace crosswalk::fe
