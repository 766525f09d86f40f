// Candidate pairs of one pass of a contact: nodes within the margin of facets.
#pragma once

#include "fe_node/contact/contact.h"
#include "fe_node/contact/surface.h"

namespace crosswalk::fe {

/// Nodes tried against facets. A node skips the facets that hold it or, for a surface against
/// itself, one of its neighbours.
struct ContactPass {
  std::vector<ContactNode> nodes;
  std::vector<ContactFacet> facets;
  std::vector<int> neighbour_begin, neighbours;  ///< mesh nodes per entry of `nodes`, rising
  double thickness_scale = 1;
  /// Pass of the same contact whose facets are the surface of `nodes`; -1: a bare set of nodes.
  int surface_of_nodes = -1;

  void find_neighbours();
  bool skips(int node, const ContactFacet& facet) const;
  /// The farthest a node can be from a facet it touches, m; one value for all facets, so that the
  /// nearest facet is always among the candidates when a farther one is.
  double reach() const;
};

struct NearNode {
  int node = 0;                     ///< entry of ContactPass::nodes
  std::span<const int> candidates;  ///< facets
};

/// A view of the candidate list inside a flat array of ints:
/// near count m, m nodes, m + 1 offsets, candidates.
class CandidateList {
 public:
  explicit CandidateList(std::span<const int> data) : data_(data) {}
  int count() const { return data_.empty() ? 0 : data_[0]; }
  int candidate_count() const { return data_.empty() ? 0 : data_[1 + 2 * count()]; }
  /// Where the candidates of near node i begin among all.
  int first_candidate(int i) const { return data_[1 + count() + i]; }
  NearNode operator[](int i) const {
    const int m = count();
    const int first = data_[1 + m + i], last = data_[1 + m + i + 1];
    return {data_[1 + i], data_.subspan(static_cast<std::size_t>(2 + 2 * m + first), last - first)};
  }

 private:
  std::span<const int> data_;
};

/// Appends the list of this pass to `out`. Facets with a zero in `is_facet_there` are passed over,
/// and so are entries of `nodes` with a zero in `is_node_there`; empty spans: all are there.
void search(const ContactPass& pass, std::span<const NodeRecord> nodes, double margin,
            std::span<const int> is_facet_there, std::span<const int> is_node_there,
            std::vector<int>& out);

}  // namespace crosswalk::fe
