// Test bodies: rectangular plates of quadrilaterals or triangles in the plane z = 0.
#pragma once

#include <functional>

#include <Eigen/Dense>

#include "fe_node/element/shell.h"
#include "fe_node/model.h"

namespace crosswalk::fe {

struct Plate {
  int nx = 1, ny = 1;
  double length = 1, width = 1;  ///< m, along x and y
  ElementKind kind = ElementKind::Quad4;
  int node(int i, int j) const { return j * (nx + 1) + i; }
};

inline Mesh plate_mesh(const Plate& plate, const std::function<Vec3(const Vec3&)>& warp = {}) {
  Mesh mesh;
  for (int j = 0; j <= plate.ny; ++j)
    for (int i = 0; i <= plate.nx; ++i) {
      const Vec3 p(plate.length * i / plate.nx, plate.width * j / plate.ny, 0);
      mesh.position.push_back(warp ? warp(p) : p);
      mesh.node_id.push_back(DeckId{mesh.node_count()});
    }
  ElementTable& table = mesh.table(plate.kind);
  auto add = [&](std::initializer_list<int> nodes) {
    table.nodes.insert(table.nodes.end(), nodes);
    table.part.push_back(0);
    table.id.push_back(DeckId{table.size()});
  };
  for (int j = 0; j < plate.ny; ++j)
    for (int i = 0; i < plate.nx; ++i) {
      const int a = plate.node(i, j), b = a + 1, c = plate.node(i + 1, j + 1), d = c - 1;
      if (plate.kind == ElementKind::Quad4) {
        add({a, b, c, d});
      } else if ((i + j) % 2 == 0) {  // diagonals alternate: no preferred direction
        add({a, b, c});
        add({a, c, d});
      } else {
        add({a, b, d});
        add({b, c, d});
      }
    }
  mesh.parts.push_back({DeckId{1}, "plate", false});
  return mesh;
}

/// Not finished: add constraints, then call finish().
inline Model plate_model(const Plate& plate, const ShellSection& section,
                         const ElementControls& controls = {},
                         const std::function<Vec3(const Vec3&)>& warp = {}) {
  Model model;
  model.mesh = plate_mesh(plate, warp);
  std::vector<int> elements(model.mesh.table(plate.kind).size());
  for (std::size_t i = 0; i < elements.size(); ++i) elements[i] = static_cast<int>(i);
  model.blocks.push_back(
      make_shell_block(model.mesh, plate.kind, 0, std::move(elements), section, controls));
  return model;
}

/// Displacement and rotation vector of every node, applied in one step of dt = 1 s.
struct PlateMotion {
  std::vector<Vec3> displacement, rotation;
};

struct NodalLoads {
  std::vector<Vec3> force, moment;
};

/// Loads on the nodes after the motion, from the undeformed stress-free state. For small motions
/// this is minus the stiffness matrix times the motion.
inline NodalLoads loads_after(const Model& model, const PlateMotion& motion) {
  const ElementBlock& block = *model.blocks[0];
  std::vector<NodeRecord> nodes(model.mesh.node_count());
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    nodes[n].set_position(model.mesh.position[n] + motion.displacement[n]);
    nodes[n].set_velocity(motion.displacement[n]);
  }
  const std::size_t size = block.corner_array_size(block.group_count());
  std::vector<double, Eigen::aligned_allocator<double>> history(
      static_cast<std::size_t>(block.group_count()) * block.history_per_group()),
      forces(size), moments(size);
  block.initialise(history);
  BlockSums sums;
  block.forces({nodes, motion.rotation, 0, 1.0, true}, history, forces, moments, 0,
               block.group_count(), sums);
  NodalLoads out;
  out.force.assign(nodes.size(), Vec3::Zero());
  out.moment.assign(nodes.size(), Vec3::Zero());
  for (int element = 0; element < block.element_count(); ++element)
    for (int corner = 0; corner < block.corners(); ++corner) {
      const int group = element / kLanes, lane = element % kLanes;
      const std::size_t slot = block.corner_slot(group, corner, lane);
      const int node = block.node(group, corner, lane);
      for (int axis = 0; axis < 3; ++axis) {
        out.force[node][axis] += forces[slot + axis];
        out.moment[node][axis] += moments[slot + axis];
      }
    }
  return out;
}

inline PlateMotion still(const Model& model) {
  const std::size_t count = model.mesh.position.size();
  return {std::vector<Vec3>(count, Vec3::Zero()), std::vector<Vec3>(count, Vec3::Zero())};
}

/// By differences of the loads; per node three displacements, then three rotations. The strains are
/// linear in the step, so that it may be small enough to leave the geometry as it is.
inline Eigen::MatrixXd stiffness_matrix(const Model& model) {
  constexpr double h = 1e-12;
  const int size = 6 * model.mesh.node_count();
  Eigen::MatrixXd K(size, size);
  for (int column = 0; column < size; ++column) {
    PlateMotion motion = still(model);
    (column % 6 < 3 ? motion.displacement : motion.rotation)[column / 6][column % 3] = h;
    const NodalLoads loads = loads_after(model, motion);
    for (int row = 0; row < size; ++row)
      K(row, column) = -(row % 6 < 3 ? loads.force : loads.moment)[row / 6][row % 3] / h;
  }
  return K;
}

inline ShellSection fully_integrated(ShellSection section) {
  section.integration = ShellIntegration::Full;
  return section;
}

}  // namespace crosswalk::fe
