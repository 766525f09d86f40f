// Two-node line elements: trusses, cables, springs, dampers and muscle strands. A strand is a chain
// of segments that slides through its via-points: all its segments carry the force of the whole
// length.
#pragma once

#include <memory>
#include <vector>

#include "fe_node/element/element_block.h"
#include "fe_node/material/line_law.h"

namespace crosswalk::fe {

struct LineProperties {
  LineLaw law = {};
  double length_density = 0;  ///< kg/m, lumped on the ends
  /// Chains of block-local elements that share one elongation; elements not named stand alone.
  std::vector<std::vector<int>> strands = {};
  /// Added to each element's undeformed length to give its rest length, m; empty: nothing.
  std::vector<double> slack = {};
};

std::unique_ptr<ElementBlock> make_line_block(const Mesh& mesh, int part, std::vector<int> elements,
                                              const LineProperties& properties);

}  // namespace crosswalk::fe
