#include "fe_node/generate/skull.h"

#include <array>
#include <map>

#include "fe_node/generate/hex_faces.h"
#include "fe_node/generate/mass_report.h"
#include "fe_node/generate/part_ids.h"

namespace crosswalk::fe::generate {

namespace {

constexpr double kOcciputRadius = 0.026;  // of the rigid skull base round the condyles, m [E]
constexpr double kForamenRadius = 0.015;  // m; adult foramina are 35 by 30 mm [L]
constexpr double kForamenX = -0.015;      // m, of its centre in the reference head [E]

std::array<int, 4> corners(const CubedSphere& sphere, int quad, const std::vector<int>& surface) {
  const auto& q = sphere.quads()[quad];
  return {surface[q[0]], surface[q[1]], surface[q[2]], surface[q[3]]};
}

Vec3 mean(const MeshDraft& draft, const int* node, int count) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < count; ++i) sum += draft.nodes[node[i]] / count;
  return sum;
}

}  // namespace

// Whole columns of bricks: what stands on an opening of the inner surface is open outside too.
void mark_skull_base(MeshDraft& draft, const HeadMesh& head, const HeadShape& shape,
                     const Vec3& condyles, int rigid_part) {
  std::map<FaceKey, bool> is_open;  // by the inner face of a brick; grows outwards with the column
  const Vec3 foramen(kForamenX * shape.scale().x(), 0, 0);
  for (int q = 0; q < static_cast<int>(head.sphere.quads().size()); ++q) {
    const std::array<int, 4> node = corners(head.sphere, q, head.skull_inner);
    const Vec3 centre = mean(draft, node.data(), 4);
    is_open[face_key(node)] =
        centre.z() < 0 && (centre - foramen).head<2>().norm() < kForamenRadius;
  }
  for (Hex& hex : draft.hexes) {
    if (hex.part != part::kDiploe) continue;
    const bool open = is_open.at(face_key(inner_face(hex)));
    is_open[face_key(outer_face(hex))] = open;
    const Vec3 centre = mean(draft, hex.node.data(), 8);
    if (open)
      hex.part = part::kCord;
    else if ((centre - condyles).head<2>().norm() < kOcciputRadius && centre.z() < 0)
      hex.part = rigid_part;
  }
}

std::vector<int> skull_parts(const MeshDraft& draft, const HeadMesh& head) {
  std::map<FaceKey, int> part_on;
  for (const Hex& hex : draft.hexes) part_on[face_key(inner_face(hex))] = hex.part;
  std::vector<int> parts;
  for (int q = 0; q < static_cast<int>(head.sphere.quads().size()); ++q)
    parts.push_back(part_on.at(face_key(corners(head.sphere, q, head.skull_inner))));
  return parts;
}

void add_tables(MeshDraft& draft, const HeadMesh& head, const HeadShape& shape) {
  std::map<FaceKey, int> outside;  // part under an outer face
  for (const Hex& hex : draft.hexes) outside[face_key(outer_face(hex))] = hex.part;
  const std::vector<int> inside = skull_parts(draft, head);
  for (int q = 0; q < static_cast<int>(inside.size()); ++q) {
    const std::array<int, 4> inner = corners(head.sphere, q, head.skull_inner),
                             outer = corners(head.sphere, q, head.skull_outer);
    const Vec3 to_outer = (mean(draft, outer.data(), 4) - shape.centre()).normalized();
    if (outside.at(face_key(outer)) == part::kDiploe)
      draft.quads.push_back({outer, part::kOuterTable, HeadShape::outer_table_thickness(to_outer)});
    if (inside[q] == part::kDiploe)
      draft.quads.push_back({inner, part::kInnerTable, HeadShape::inner_table_thickness(to_outer)});
  }
}

double diploe_density(const ModelDraft& draft, double of_tissue) {
  const auto volume = [&draft](int id) {
    return inertia_of(draft, {id}, false).mass / draft.part(id).density;
  };
  const double tables = volume(part::kOuterTable) + volume(part::kInnerTable);
  return of_tissue * (1 - tables / volume(part::kDiploe));
}

std::vector<int> on_bone(const MeshDraft& draft, const std::vector<int>& nodes, int rigid_part) {
  std::vector<bool> is_bone(draft.nodes.size(), false);
  for (const Hex& hex : draft.hexes)
    if (hex.part == part::kDiploe || hex.part == rigid_part)
      for (const int id : hex.node) is_bone[id] = true;
  std::vector<int> kept;
  for (const int id : nodes)
    if (is_bone[id]) kept.push_back(id);
  return kept;
}

}  // namespace crosswalk::fe::generate
