#include "fe_node/contact/tiebreak.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

double area_of(const ContactFacet& facet, std::span<const NodeRecord> places) {
  const FacetCorners x = corners_of(facet, places);
  return facet.is_triangle() ? 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm()
                             : 0.5 * (x[2] - x[0]).cross(x[3] - x[1]).norm();
}

bool is_tied(const double* slots, int stride, int node) {
  return slots[static_cast<std::ptrdiff_t>(stride) * node + BreakingTies::kTied] > 0;
}

}  // namespace

bool TiebreakLimits::are_reached(const TieLoad& load, double area) const {
  const Vec3 force = -load.stiffness * load.stretch;
  const double along = force.dot(load.normal), share = is_stress ? area : 1.0;
  const double pull = std::max(0.0, -along), slide = (force - along * load.normal).norm();
  double sum = 0;
  if (normal > 0) sum += std::pow(pull / (normal * share), normal_exponent);
  if (shear > 0) sum += std::pow(slide / (shear * share), shear_exponent);
  return sum >= 1;
}

BreakingTies::BreakingTies(const TiebreakLimits& limits, double nominal_step,
                           std::vector<ContactNode> nodes, std::vector<ContactFacet> facets)
    : limits_(limits), step_(nominal_step), nodes_(std::move(nodes)), facets_(std::move(facets)) {
  for (const ContactFacet& facet : facets_) {
    std::array<int, 4>& entries = entries_.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) {
      const auto at =
          std::lower_bound(nodes_.begin(), nodes_.end(), facet.node[c],
                           [](const ContactNode& node, int wanted) { return node.node < wanted; });
      CW_ASSERT(at != nodes_.end() && at->node == facet.node[c]);
      entries[c] = static_cast<int>(at - nodes_.begin());
    }
  }
}

void BreakingTies::tie(const ContactPass& pass, const CandidateList& list,
                       std::span<const NodeRecord> places, double* slots, int stride) const {
  const auto slot_of = [&](int node) { return slots + static_cast<std::ptrdiff_t>(stride) * node; };
  const std::vector<int> rank = rank_of_facets(pass, list, places, limits_.tolerance);
  for (int i = 0; i < list.count(); ++i) {
    const NearNode near = list[i];
    const auto found = find_tie(pass, near, places, limits_.tolerance, rank);
    if (!found) continue;
    double* slot = slot_of(near.node);
    slot[kTied] = 1;
    slot[kFacet] = found->facet;
    slot[kSector] = found->sector;
    std::copy(found->weight.begin(), found->weight.end(), slot + kWeight);
    slot[kOffset] = found->offset;
  }
  share_area(places, slots, stride);
}

/// Facets that are tied as a whole give their area to their nodes. A node of none, at the rim of
/// a surface that reaches farther than the other, has its share of its smallest facet.
void BreakingTies::share_area(std::span<const NodeRecord> places, double* slots, int stride) const {
  std::vector<double> smallest(nodes_.size(), 1e300);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const int corners = facets_[f].is_triangle() ? 3 : 4;
    const double share = area_of(facets_[f], places) / corners;
    const bool is_whole = std::all_of(entries_[f].begin(), entries_[f].end(),
                                      [&](int entry) { return is_tied(slots, stride, entry); });
    for (int c = 0; c < corners; ++c) {
      const int node = entries_[f][static_cast<std::size_t>(c)];
      double& least = smallest[static_cast<std::size_t>(node)];
      least = std::min(least, share);
      if (is_whole) slots[static_cast<std::ptrdiff_t>(stride) * node + kArea] += share;
    }
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    double& area = slots[static_cast<std::ptrdiff_t>(stride) * static_cast<int>(n) + kArea];
    if (area == 0 && smallest[n] < 1e300) area = smallest[n];
  }
}

BreakingTies::Answer BreakingTies::hold(const ContactPass& pass, int node,
                                        const ContactContext& context, double* slots) const {
  const double* w = slots + kWeight;
  const Tie tie{static_cast<int>(slots[kFacet]),
                static_cast<int>(slots[kSector]),
                {w[0], w[1], w[2], w[3]},
                slots[kOffset]};
  const ContactFacet& facet = pass.facets[static_cast<std::size_t>(tie.facet)];
  const auto load =
      tie_load(pass.nodes[static_cast<std::size_t>(node)], facet, tie, context.nodes, step_);
  if (!load) return {};
  Answer answer;
  answer.stored = 0.5 * load->stiffness * load->stretch.squaredNorm();
  if ((context.failed != nullptr && context.failed->contains(facet.kind, facet.element)) ||
      limits_.are_reached(*load, slots[kArea])) {
    slots[kTied] = 0;
    answer.lost = answer.stored;
    return answer;
  }
  answer.holds = true;
  answer.facet = tie.facet;
  answer.forces = load->forces;
  answer.omega2 = load->stiffness * load->inverse;
  return answer;
}

bool BreakingTies::hold_facet(int facet, const double* slots, int stride) const {
  const auto& entries = entries_[static_cast<std::size_t>(facet)];
  return std::any_of(entries.begin(), entries.end(),
                     [&](int entry) { return is_tied(slots, stride, entry); });
}

}  // namespace crosswalk::fe
