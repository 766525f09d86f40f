#include "fe_node/generate/membranes.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "fe_node/generate/hex_faces.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/sheet_fluid.h"
#include "fe_node/generate/skull.h"

namespace crosswalk::fe::generate {

namespace {

constexpr double kFalxInnerShare = 0.55;    // of the brain's radius; the falx lies outside it [E]
constexpr double kFalxFrontZ = 0.035;       // m in F, lowest point in front (crista galli) [E]
constexpr double kFalxBackZ = 0.024;        // m in F, where it meets the tentorium [E]
constexpr double kNotchHalfWidth = 0.028;   // m, opening of the tentorium for the brainstem [E]
constexpr double kNotchBack = -0.028;       // m, x in F of its back [E]
constexpr double kTentoriumFront = -0.016;  // m, x in F of its front edge beside the notch [E]

constexpr double kFluidGap = 0.002;  // m, of the cisterns on each side of falx and tentorium [E]

/// Which of two regions of the cranium a brick belongs to, or neither.
enum class Side { None, One, Other };

/// Quads on the faces where a brick of side One meets one of side Other, oriented out of One.
void add_sheet(MeshDraft& draft, const std::vector<Side>& side, int part,
               const std::function<bool(const Vec3& centre, const Vec3& normal)>& is_wanted) {
  std::map<FaceKey, std::pair<Side, std::array<int, 4>>> open;
  for (std::size_t h = 0; h < side.size(); ++h) {
    if (side[h] == Side::None) continue;
    for (const auto& face : kHexFaces) {
      const std::array<int, 4> node = face_nodes(draft.hexes[h], face);
      const auto [found, is_new] = open.try_emplace(face_key(node), side[h], node);
      if (is_new || found->second.first == side[h]) continue;
      const std::array<int, 4>& out = side[h] == Side::One ? node : found->second.second;
      const auto at = [&](int c) -> const Vec3& { return draft.nodes[out[c]]; };
      const Vec3 centre = 0.25 * (at(0) + at(1) + at(2) + at(3));
      const Vec3 normal = (at(2) - at(0)).cross(at(3) - at(1)).normalized();
      if (is_wanted(centre, normal)) draft.quads.push_back({out, part});
    }
  }
}

double height_of(const MeshDraft& draft, const Hex& hex, int axis) {
  double sum = 0;
  for (const int id : hex.node) sum += draft.nodes[id][axis] / 8;
  return sum;
}

bool is_cerebrum(int part) { return part == part::kCerebrumLeft || part == part::kCerebrumRight; }
bool is_cerebellum(int part) {
  return part == part::kCerebellumLeft || part == part::kCerebellumRight;
}

/// The part of the brain under each brick; CSF bricks continue the brain brick below them.
std::vector<int> brain_parts(const MeshDraft& draft) {
  std::map<FaceKey, int> under;  // a brick's outer face
  std::vector<int> parts(draft.hexes.size(), -1);
  for (std::size_t h = 0; h < draft.hexes.size(); ++h) {
    const Hex& hex = draft.hexes[h];
    if (hex.part == part::kCsf) {
      const auto found = under.find(face_key(inner_face(hex)));
      if (found != under.end()) parts[h] = found->second;
    } else if (is_cerebrum(hex.part) || is_cerebellum(hex.part) || hex.part == part::kBrainstem) {
      parts[h] = hex.part;
    }
    if (parts[h] >= 0) under[face_key(outer_face(hex))] = parts[h];
  }
  return parts;
}

void add_surface(MeshDraft& draft, const CubedSphere& sphere, const std::vector<int>& node,
                 int part, const std::function<bool(int quad)>& is_wanted) {
  for (int q = 0; q < static_cast<int>(sphere.quads().size()); ++q) {
    const auto& quad = sphere.quads()[q];
    if (is_wanted(q))
      draft.quads.push_back({{node[quad[0]], node[quad[1]], node[quad[2]], node[quad[3]]}, part});
  }
}

/// Nodes on the edges of a part that only one of its quads has and that run from side to side,
/// `least_y` m or more from the mid-plane.
std::vector<int> free_cross_edges(const MeshDraft& draft, int part, double least_y) {
  std::map<std::pair<int, int>, int> count;
  for (const Quad& quad : draft.quads)
    for (int c = 0; quad.part == part && c < 4; ++c)
      ++count[std::minmax(quad.node[c], quad.node[(c + 1) % 4])];
  std::set<int> nodes;
  for (const auto& [edge, quads] : count) {
    const Vec3 &a = draft.nodes[edge.first], &b = draft.nodes[edge.second];
    const Vec3 along = (b - a).cwiseAbs(), middle = 0.5 * (a + b);
    if (quads == 1 && along.y() > along.x() && std::abs(middle.y()) > least_y)
      nodes.insert({edge.first, edge.second});
  }
  return {nodes.begin(), nodes.end()};
}

}  // namespace

std::vector<int> add_membranes(MeshDraft& draft, const HeadMesh& head, const HeadShape& shape) {
  // The spinal dura goes on from the rim of the foramen and spans nothing.
  const std::vector<int> skull = skull_parts(draft, head);
  add_surface(draft, head.sphere, head.skull_inner, part::kDura,
              [&](int quad) { return skull[quad] != part::kCord; });
  const std::vector<int> parts = brain_parts(draft);

  std::vector<Side> halves(parts.size(), Side::None), floors(parts.size(), Side::None);
  for (std::size_t h = 0; h < parts.size(); ++h) {
    if (is_cerebrum(parts[h])) {
      halves[h] = height_of(draft, draft.hexes[h], 1) > 0 ? Side::One : Side::Other;
      floors[h] = Side::Other;
    } else if (is_cerebellum(parts[h])) {
      floors[h] = Side::One;
    }
  }
  const Vec3 centre = shape.centre(), scale = shape.scale();
  add_sheet(draft, halves, part::kFalx, [&](const Vec3& p, const Vec3&) {
    const Vec3 q = p.cwiseQuotient(scale), d = p - centre;
    if (q.z() < (q.x() > 0 ? kFalxFrontZ : kFalxBackZ)) return false;
    return d.norm() > kFalxInnerShare * shape.ray(shape.on_ball(d)).brain;
  });
  add_sheet(draft, floors, part::kTentorium, [&](const Vec3& p, const Vec3& normal) {
    if (normal.z() < 0.5) return false;  // the cerebellum's front
    const Vec3 q = p.cwiseQuotient(scale);
    if (std::abs(q.y()) < kNotchHalfWidth) return q.x() < kNotchBack;
    return q.x() < kTentoriumFront;
  });
  std::vector<int> edge = free_cross_edges(draft, part::kTentorium, kNotchHalfWidth * scale.y());
  const std::set<int> on_skull(head.skull_inner.begin(), head.skull_inner.end());
  std::erase_if(edge, [&](int id) { return on_skull.contains(id); });

  std::vector<Side> surface(parts.size(), Side::None);
  for (std::size_t h = 0; h < parts.size(); ++h)
    if (parts[h] >= 0) surface[h] = draft.hexes[h].part == part::kCsf ? Side::Other : Side::One;
  float_sheets(draft, {.sheets = {part::kFalx, part::kTentorium},
                       .tissue = {part::kCerebrumLeft, part::kCerebrumRight, part::kCerebellumLeft,
                                  part::kCerebellumRight, part::kBrainstem},
                       .fluid = part::kCsf,
                       .lining = part::kPia,
                       .gap = kFluidGap,
                       .anchored = head.skull_inner});
  add_sheet(draft, surface, part::kPia, [](const Vec3&, const Vec3&) { return true; });
  return edge;
}

}  // namespace crosswalk::fe::generate
