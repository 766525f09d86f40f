// Boxes of elastic elements in a state of prescribed uniform deformation, for output tests.
#pragma once

#include "fe_node/solver.h"
#include "tests/fe_node/box_model.h"

namespace crosswalk::fe {

/// Every node moved to F X; forces computed once, so that stresses are those of F.
inline State deformed_state(const Model& model, const Mat3& F) {
  State state = initial_state(model);
  for (int n = 0; n < model.mesh.node_count(); ++n)
    state.nodes[n].set_position(F * model.mesh.position[n]);
  Scratch scratch(model, 1);
  compute_forces(model, state, scratch);
  return state;
}

inline Mat3 stretch(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

}  // namespace crosswalk::fe
