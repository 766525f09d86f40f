#include "fe_node/contact/tie.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace crosswalk::fe {

double tie_tolerance(const ContactNode& node, const ContactFacet& facet, const FacetCorners& x,
                     double given) {
  if (given > 0) return given;
  const double diagonal = std::min((x[2] - x[0]).norm(), (x[3] - x[1]).norm());
  return std::max(1.2 * (node.half_thickness + facet.half_thickness), 0.05 * diagonal);
}

double tie_reach(const ContactPass& pass, std::span<const NodeRecord> nodes, double given) {
  double reach = 0;
  for (const ContactFacet& facet : pass.facets)
    for (const ContactNode& node : pass.nodes)
      reach = std::max(reach, tie_tolerance(node, facet, corners_of(facet, nodes), given));
  return reach;
}

namespace {

/// Facets within the tolerance, as near as the nearest but for round-off.
struct Nearest {
  std::vector<std::pair<int, Projection>> found;
  double distance = 1e300;
  void add(int facet, const Projection& p, double tolerance) {
    const double margin = 1e-6 * tolerance;
    if (p.distance > distance + margin) return;
    if (p.distance < distance - margin) found.clear();
    distance = std::min(distance, p.distance);
    found.emplace_back(facet, p);
  }
};

Nearest nearest_of(const ContactPass& pass, const NearNode& near, std::span<const NodeRecord> nodes,
                   double given_tolerance) {
  const ContactNode& node = pass.nodes[near.node];
  const Vec3 x = nodes[node.node].position();
  Nearest nearest;
  for (int f : near.candidates) {
    const FacetCorners corners = corners_of(pass.facets[f], nodes);
    const Projection p = closest_point(x, corners, pass.facets[f].is_triangle());
    const double tolerance = tie_tolerance(node, pass.facets[f], corners, given_tolerance);
    if (p.distance <= tolerance) nearest.add(f, p, tolerance);
  }
  return nearest;
}

}  // namespace

std::optional<Tie> find_tie(const ContactPass& pass, const NearNode& near,
                            std::span<const NodeRecord> nodes, double given_tolerance,
                            std::span<const int> rank) {
  const Nearest nearest = nearest_of(pass, near, nodes, given_tolerance);
  if (nearest.found.empty()) return std::nullopt;
  const auto is_worse = [&](const auto& a, const auto& b) {
    if (rank.empty()) return b.second.distance < a.second.distance;
    return rank[static_cast<std::size_t>(a.first)] < rank[static_cast<std::size_t>(b.first)];
  };
  const auto best = std::max_element(nearest.found.begin(), nearest.found.end(), is_worse);
  const auto& [facet, p] = *best;
  const Vec3 x = nodes[pass.nodes[near.node].node].position();
  return Tie{facet, p.sector, p.weight, (x - p.point).dot(p.normal)};
}

std::vector<int> rank_of_facets(const ContactPass& pass, const CandidateList& list,
                                std::span<const NodeRecord> nodes, double given_tolerance) {
  std::vector<int> rank(pass.facets.size(), 0);
  for (int i = 0; i < list.count(); ++i)
    for (const auto& [facet, p] : nearest_of(pass, list[i], nodes, given_tolerance).found)
      ++rank[static_cast<std::size_t>(facet)];
  return rank;
}

std::optional<TieLoad> tie_load(const ContactNode& node, const ContactFacet& facet, const Tie& tie,
                                std::span<const NodeRecord> nodes, double nominal_step) {
  const FacetCorners x = corners_of(facet, nodes);
  TieLoad load;
  Projection at;
  load.inverse = nodes[node.node].inverse_mass;
  double heaviest = 0;
  at.sector = tie.sector;
  at.point.setZero();
  for (int c = 0; c < 4; ++c) {
    at.weight[c] = tie.weight[c];
    at.point += tie.weight[c] * x[c];
    const double corner = nodes[facet.node[c]].inverse_mass;
    load.inverse += tie.weight[c] * tie.weight[c] * corner;
    heaviest = std::max(heaviest, corner);
  }
  const Vec3 centre = facet.is_triangle() ? x[2] : Vec3(0.25 * (x[0] + x[1] + x[2] + x[3]));
  const Vec3& a = x[facet.is_triangle() ? 0 : at.sector];
  const Vec3& b = x[facet.is_triangle() ? 1 : (at.sector + 1) % 4];
  at.normal = load.normal = (b - a).cross(centre - a).normalized();
  const double bound = nodes[node.node].inverse_mass + heaviest;
  if (bound == 0) return std::nullopt;
  load.stiffness = 0.25 / (bound * nominal_step * nominal_step);
  load.stretch = nodes[node.node].position() - at.point - tie.offset * at.normal;
  load.forces = balanced_forces(pair_frame(x, facet.is_triangle(), at, at.normal, tie.offset),
                                -load.stiffness * load.stretch);
  return load;
}

}  // namespace crosswalk::fe
