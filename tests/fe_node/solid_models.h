// The boxes of box_model.h in every solid element there is.
#pragma once

#include "fe_node/element/hex8_full.h"
#include "fe_node/element/tet4.h"
#include "tests/fe_node/box_model.h"

namespace crosswalk::fe {

enum class SolidForm { OnePointBrick, FullBrick, Wedge, Pyramid, Tet, NodalTet };

inline const char* name_of(SolidForm form) {
  constexpr const char* kNames[] = {"OnePointBrick", "FullBrick", "Wedge",
                                    "Pyramid",       "Tet",       "NodalTet"};
  return kNames[static_cast<int>(form)];
}

/// Splits every brick of a box: into two wedges, six pyramids on its centre, or six tetrahedra
/// about the diagonal of its corners 0 and 6.
inline Mesh split_mesh(const Mesh& bricks, SolidForm form) {
  const bool is_tet = form == SolidForm::Tet || form == SolidForm::NodalTet;
  if (form == SolidForm::OnePointBrick || form == SolidForm::FullBrick) return bricks;
  Mesh mesh = bricks;
  mesh.table(ElementKind::Hex8) = {};
  ElementTable& table = mesh.table(is_tet ? ElementKind::Tet4 : ElementKind::Hex8);
  const auto add = [&](std::initializer_list<int> nodes) {
    table.nodes.insert(table.nodes.end(), nodes);
    table.part.push_back(0);
    table.id.push_back(DeckId{table.size()});
  };
  for (int e = 0; e < bricks.table(ElementKind::Hex8).size(); ++e) {
    const std::span<const int> n = bricks.corners(ElementKind::Hex8, e);
    if (form == SolidForm::Wedge) {
      add({n[0], n[1], n[2], n[2], n[4], n[5], n[6], n[6]});
      add({n[0], n[2], n[3], n[3], n[4], n[6], n[7], n[7]});
    } else if (form == SolidForm::Pyramid) {
      const int c = mesh.node_count();
      Vec3 centre = Vec3::Zero();
      for (int k : n) centre += mesh.position[k] / 8;
      mesh.position.push_back(centre);
      mesh.node_id.push_back(DeckId{c + 1});
      constexpr int kInward[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                     {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
      for (const auto& f : kInward) add({n[f[0]], n[f[1]], n[f[2]], n[f[3]], c, c, c, c});
    } else {
      constexpr int kTets[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
      for (const auto& t : kTets) add({n[0], n[t[0]], n[t[1]], n[6]});
    }
  }
  return mesh;
}

/// Not finished: add constraints, then call finish().
inline Model solid_model(SolidForm form, const Box& box, const SolidLaw& law,
                         const ElementControls& controls = {},
                         const std::function<Vec3(const Vec3&)>& warp = {}) {
  Model model;
  model.mesh = split_mesh(box_mesh(box, warp), form);
  const bool is_tet = form == SolidForm::Tet || form == SolidForm::NodalTet;
  std::vector<int> all = all_of(model.mesh.table(is_tet ? ElementKind::Tet4 : ElementKind::Hex8));
  if (is_tet)
    model.blocks.push_back(
        make_tet4_block(model.mesh, 0, std::move(all), law, controls,
                        form == SolidForm::Tet ? TetPressure::Own : TetPressure::NodalMean));
  else if (form == SolidForm::FullBrick)
    model.blocks.push_back(make_full_hex8_block(model.mesh, 0, std::move(all), law, controls));
  else
    model.blocks.push_back(make_hex8_block(model.mesh, 0, std::move(all), law, controls));
  return model;
}

}  // namespace crosswalk::fe
