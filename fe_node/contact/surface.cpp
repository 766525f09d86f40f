#include "fe_node/contact/surface.h"

#include <algorithm>
#include <map>

namespace crosswalk::fe {
namespace {

using FaceKey = std::array<int, 4>;

/// Unique node numbers, rising; -1 fills up.
FaceKey key_of(std::span<const int> nodes) {
  FaceKey key{-1, -1, -1, -1};
  int count = 0;
  for (int n : nodes)
    if (std::find(key.begin(), key.begin() + count, n) == key.begin() + count) key[count++] = n;
  std::sort(key.begin(), key.begin() + count);
  return key;
}
bool is_flat(const FaceKey& key) { return key[2] < 0; }

/// Removes repeated neighbours, so that a collapsed quadrilateral becomes a triangle.
std::array<int, 4> facet_nodes(std::span<const int> nodes) {
  std::vector<int> kept;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] != nodes[(i + 1) % nodes.size()]) kept.push_back(nodes[i]);
  while (kept.size() < 4) kept.push_back(kept.back());
  return {kept[0], kept[1], kept[2], kept[3]};
}

constexpr int kHexFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
constexpr int kTetFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

Vec3 area_vector(const Mesh& mesh, const std::array<int, 4>& n) {
  const auto& x = mesh.position;
  return 0.5 * (x[n[2]] - x[n[0]]).cross(x[n[3]] - x[n[1]]);
}

/// Volume from the outward faces, by the divergence theorem with face centres.
double solid_volume(const Mesh& mesh, const std::vector<std::array<int, 4>>& faces) {
  double volume = 0;
  for (const auto& face : faces) {
    Vec3 centre = Vec3::Zero();
    for (int n : face) centre += 0.25 * mesh.position[n];
    volume += centre.dot(area_vector(mesh, face)) / 3;
  }
  return volume;
}

struct Collector {
  const Mesh& mesh;
  std::map<FaceKey, int> shells;             ///< faces covered by a shell
  std::map<FaceKey, int> count;              ///< how many solids have this face
  std::vector<ContactFacet> solid_facets{};  ///< candidates
  std::vector<FaceKey> solid_keys{};
  ContactSurface surface{};

  /// `local` counts the part's shells over both kinds.
  void add_shells(ElementKind kind, const ContactPart& part, std::size_t& local) {
    const ElementTable& table = mesh.table(kind);
    for (int e = 0; e < table.size(); ++e) {
      if (table.part[e] != part.part) continue;
      const std::span<const int> corners = mesh.corners(kind, e);
      ContactFacet facet;
      facet.node = facet_nodes(corners);
      const double thickness =
          local < part.per_element.size() ? part.per_element[local] : part.thickness;
      ++local;
      facet.half_thickness = 0.5 * thickness;
      facet.is_two_sided = true;
      facet.kind = kind;
      facet.element = e;
      const auto& x = mesh.position;
      const double diagonal = std::max((x[facet.node[2]] - x[facet.node[0]]).norm(),
                                       std::max((x[facet.node[3]] - x[facet.node[1]]).norm(),
                                                (x[facet.node[1]] - x[facet.node[0]]).norm()));
      const double area = area_vector(mesh, facet.node).norm();
      facet.stiffness = part.bulk_modulus * area / diagonal;
      facet.depth_limit = diagonal;
      surface.facets.push_back(facet);
      shells[key_of(corners)] = 1;
    }
  }
  template <std::size_t kFaces, std::size_t kPoints>
  void add_solids(ElementKind kind, const ContactPart& part, const int (&faces)[kFaces][kPoints]) {
    const ElementTable& table = mesh.table(kind);
    for (int e = 0; e < table.size(); ++e) {
      if (table.part[e] != part.part) continue;
      const std::span<const int> corners = mesh.corners(kind, e);
      std::vector<std::array<int, 4>> all;
      std::vector<FaceKey> keys;
      for (const auto& face : faces) {
        int nodes[kPoints];
        for (std::size_t i = 0; i < kPoints; ++i) nodes[i] = corners[face[i]];
        const FaceKey key = key_of(nodes);
        if (is_flat(key)) continue;
        all.push_back(facet_nodes(nodes));
        keys.push_back(key);
      }
      const double volume = std::max(solid_volume(mesh, all), 1e-300);
      for (std::size_t f = 0; f < all.size(); ++f) {
        ContactFacet facet;
        facet.node = all[f];
        facet.kind = kind;
        facet.element = e;
        const double area = area_vector(mesh, facet.node).norm();
        facet.stiffness = part.bulk_modulus * area * area / volume;
        facet.depth_limit = volume / area;
        ++count[keys[f]];
        solid_facets.push_back(facet);
        solid_keys.push_back(keys[f]);
      }
    }
  }
};

}  // namespace

ContactSurface ContactSurface::of_nodes(std::span<const int> nodes) {
  ContactSurface surface;
  for (int n : nodes) surface.nodes.push_back({n, 0, 0});
  return surface;
}

void ContactSurface::collect_nodes() {
  std::map<int, ContactNode> found;
  for (const ContactFacet& facet : facets)
    for (int n : facet.node) {
      auto [it, is_new] =
          found.try_emplace(n, ContactNode{n, facet.half_thickness, facet.stiffness});
      if (is_new) continue;
      it->second.half_thickness = std::max(it->second.half_thickness, facet.half_thickness);
      it->second.stiffness = std::min(it->second.stiffness, facet.stiffness);
    }
  nodes.clear();
  for (const auto& [n, node] : found) nodes.push_back(node);
}

ContactSurface surface_of(const Mesh& mesh, std::span<const ContactPart> parts, InnerFaces inner) {
  Collector collector{mesh, {}, {}};
  for (const ContactPart& part : parts) {
    std::size_t local = 0;
    collector.add_shells(ElementKind::Quad4, part, local);
    collector.add_shells(ElementKind::Tri3, part, local);
    collector.add_solids(ElementKind::Hex8, part, kHexFaces);
    collector.add_solids(ElementKind::Tet4, part, kTetFaces);
    collector.add_solids(ElementKind::Tet10, part, kTetFaces);
  }
  std::map<FaceKey, int> first;  // of a shared face, the facet that came first
  std::vector<ContactFacet>& facets = collector.surface.facets;
  for (std::size_t f = 0; f < collector.solid_facets.size(); ++f) {
    const FaceKey& key = collector.solid_keys[f];
    if (collector.shells.contains(key)) continue;
    const bool is_inner = collector.count[key] > 1;
    if (is_inner && inner == InnerFaces::Left) continue;
    const int index = static_cast<int>(facets.size());
    facets.push_back(collector.solid_facets[f]);
    if (!is_inner) continue;
    const auto [it, is_new] = first.try_emplace(key, index);
    if (is_new) continue;
    facets[index].twin = it->second;
    facets[it->second].twin = index;
  }
  collector.surface.collect_nodes();
  return std::move(collector.surface);
}

}  // namespace crosswalk::fe
