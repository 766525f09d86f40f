#include "fe_node/contact/search.h"

#include <algorithm>
#include <map>
#include <set>

#include "fe_node/contact/broad_phase.h"

namespace crosswalk::fe {

void ContactPass::find_neighbours() {
  std::map<int, std::set<int>> around;
  for (const ContactFacet& facet : facets)
    for (int n : facet.node) around[n].insert(facet.node.begin(), facet.node.end());
  neighbour_begin.assign(1, 0);
  neighbours.clear();
  for (const ContactNode& node : nodes) {
    if (auto it = around.find(node.node); it != around.end())
      neighbours.insert(neighbours.end(), it->second.begin(), it->second.end());
    neighbour_begin.push_back(static_cast<int>(neighbours.size()));
  }
}

bool ContactPass::skips(int node, const ContactFacet& facet) const {
  const auto first = neighbours.begin() + neighbour_begin[node],
             last = neighbours.begin() + neighbour_begin[node + 1];
  for (int n : facet.node)
    if (n == nodes[node].node || std::binary_search(first, last, n)) return true;
  return false;
}

double ContactPass::reach() const {
  double node = 0, facet = 0, depth = 0;
  for (const ContactNode& n : nodes) node = std::max(node, n.half_thickness);
  for (const ContactFacet& f : facets) {
    facet = std::max(facet, f.half_thickness);
    if (!f.is_two_sided) depth = std::max(depth, f.depth_limit);
  }
  return std::max(thickness_scale * (node + facet), depth);
}

void search(const ContactPass& pass, std::span<const NodeRecord> nodes, double margin,
            std::span<const int> is_facet_there, std::span<const int> is_node_there,
            std::vector<int>& out) {
  const double reach = pass.reach() + margin;
  Box3 of_nodes, of_facets;
  for (const ContactNode& node : pass.nodes) of_nodes.add(nodes[node.node].position());
  // a facet that is gone keeps an empty box, which contains nothing
  std::vector<Box3> boxes(pass.facets.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    if (!is_facet_there.empty() && is_facet_there[f] == 0) continue;
    for (int n : pass.facets[f].node) boxes[f].add(nodes[n].position());
    boxes[f].grow(reach);
    of_facets.add(boxes[f].low);
    of_facets.add(boxes[f].high);
  }
  Box3 region;
  region.low = of_nodes.low.cwiseMax(of_facets.low);
  region.high = of_nodes.high.cwiseMin(of_facets.high);

  std::vector<int> near, begin{0}, candidates, found;
  if (!region.is_empty()) {
    const BoxGrid grid(boxes, region);
    for (int i = 0; i < static_cast<int>(pass.nodes.size()); ++i) {
      found.clear();
      if (!is_node_there.empty() && is_node_there[i] == 0) continue;
      grid.find(nodes[pass.nodes[i].node].position(), found);
      const std::size_t before = candidates.size();
      for (int f : found)
        if (!pass.skips(i, pass.facets[f])) candidates.push_back(f);
      if (candidates.size() == before) continue;
      near.push_back(i);
      begin.push_back(static_cast<int>(candidates.size()));
    }
  }
  out.push_back(static_cast<int>(near.size()));
  out.insert(out.end(), near.begin(), near.end());
  out.insert(out.end(), begin.begin(), begin.end());
  out.insert(out.end(), candidates.begin(), candidates.end());
}

}  // namespace crosswalk::fe
