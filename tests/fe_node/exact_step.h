// The stable step of solids by the whole eigenvalue problem, for small models.
#pragma once

#include <Eigen/Eigenvalues>

#include "fe_node/solver.h"

namespace crosswalk::fe {

/// 2 over the largest frequency of the assembled stiffness, by central differences of the nodal
/// forces, and the lumped masses. Nodes without mass of their own are held.
inline double exact_stable_step(const Model& model) {
  State state = initial_state(model);
  const auto forces = [&] {
    Scratch scratch(model, 1);
    compute_forces(model, state, scratch);
    return nodal_forces(model, scratch);
  };
  const int size = 3 * model.mesh.node_count();
  Eigen::MatrixXd K(size, size);
  const double h = 1e-6 * model.mesh.position.back().norm();
  for (int column = 0; column < size; ++column) {
    double& x = state.nodes[column / 3].x[column % 3];
    const double kept = x;
    x = kept + h;
    const std::vector<Vec3> up = forces();
    x = kept - h;
    const std::vector<Vec3> down = forces();
    x = kept;
    for (int row = 0; row < size; ++row)
      K(row, column) = -(up[row / 3][row % 3] - down[row / 3][row % 3]) / (2 * h);
  }
  Eigen::VectorXd root(size);
  for (int row = 0; row < size; ++row) root[row] = std::sqrt(state.nodes[row / 3].inverse_mass);
  const Eigen::MatrixXd A = root.asDiagonal() * (0.5 * (K + K.transpose())) * root.asDiagonal();
  return 2 / std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().maxCoeff());
}

}  // namespace crosswalk::fe
