// Test bodies: boxes of hexahedra with one part, in the simplest way.
#pragma once

#include <cmath>
#include <functional>

#include "fe_node/element/hex8.h"
#include "fe_node/model.h"

namespace crosswalk::fe {

struct Box {
  int nx = 1, ny = 1, nz = 1;
  Vec3 size{1, 1, 1};
  int node(int i, int j, int k) const { return (k * (ny + 1) + j) * (nx + 1) + i; }
};

/// Nodes run x first, then y, then z. `warp` moves each reference node.
inline Mesh box_mesh(const Box& box, const std::function<Vec3(const Vec3&)>& warp = {}) {
  Mesh mesh;
  for (int k = 0; k <= box.nz; ++k)
    for (int j = 0; j <= box.ny; ++j)
      for (int i = 0; i <= box.nx; ++i) {
        const Vec3 p(box.size.x() * i / box.nx, box.size.y() * j / box.ny,
                     box.size.z() * k / box.nz);
        mesh.position.push_back(warp ? warp(p) : p);
        mesh.node_id.push_back(DeckId{mesh.node_count()});
      }
  ElementTable& hexes = mesh.table(ElementKind::Hex8);
  for (int k = 0; k < box.nz; ++k)
    for (int j = 0; j < box.ny; ++j)
      for (int i = 0; i < box.nx; ++i) {
        for (int corner = 0; corner < 8; ++corner) {
          const int di = (corner % 4 == 1 || corner % 4 == 2) ? 1 : 0;
          const int dj = (corner % 4 >= 2) ? 1 : 0;
          hexes.nodes.push_back(box.node(i + di, j + dj, k + corner / 4));
        }
        hexes.part.push_back(0);
        hexes.id.push_back(DeckId{hexes.size()});
      }
  mesh.parts.push_back({DeckId{1}, "box", false});
  return mesh;
}

inline std::vector<int> all_of(const ElementTable& table) {
  std::vector<int> indices(table.size());
  for (int i = 0; i < table.size(); ++i) indices[i] = i;
  return indices;
}

/// Not finished: add constraints, then call finish().
inline Model box_model(const Box& box, const SolidLaw& law, const ElementControls& controls = {},
                       const std::function<Vec3(const Vec3&)>& warp = {}) {
  Model model;
  model.mesh = box_mesh(box, warp);
  model.blocks.push_back(
      make_hex8_block(model.mesh, 0, all_of(model.mesh.table(ElementKind::Hex8)), law, controls));
  return model;
}

/// Bulk viscosity off, for tests that count every joule.
inline ElementControls without_viscosity(ElementControls controls = {}) {
  controls.quadratic_bulk = controls.linear_bulk = 0;
  return controls;
}

/// A smooth distortion that leaves no element a parallelepiped.
inline Vec3 wavy(const Vec3& p) {
  return p + 0.08 * Vec3(std::sin(3 * p.y() + 2 * p.z()), std::sin(2 * p.z() + 4 * p.x()),
                         std::sin(3 * p.x() * p.y()));
}

}  // namespace crosswalk::fe
