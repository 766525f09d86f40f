// One node tied to one facet by a stiff spring, its offset kept: the node stays at its place over
// the facet, point + offset x normal. The spring's force and the facet's forces balance exactly,
// moments included, so a rigid motion of both costs nothing and momenta are kept. Stiffness is the
// most the step allows, m* / (4 dt^2) (penalty.h). Pure functions, shared by ties that hold for
// good and ties that break.
#pragma once

#include <optional>

#include "fe_node/contact/pair.h"
#include "fe_node/contact/search.h"

namespace crosswalk::fe {

struct Tie {
  int facet = -1, sector = 0;
  std::array<double, 4> weight{};
  double offset = 0;  ///< m, along the facet's normal
};

/// How far a node may be from its facet, m: `given`, or when that is 0 the larger of 0.6 (t1 + t2)
/// and 5 % of the smaller diagonal [hallquist2006, 26.10].
double tie_tolerance(const ContactNode& node, const ContactFacet& facet, const FacetCorners& x,
                     double given);
/// The largest tolerance of a pass, m: the margin its search needs.
double tie_reach(const ContactPass& pass, std::span<const NodeRecord> nodes, double given);
/// To the nearest of the candidates that is near enough; of equally near ones that with the
/// greatest `rank` (per facet of the pass; empty: the first).
std::optional<Tie> find_tie(const ContactPass& pass, const NearNode& near,
                            std::span<const NodeRecord> nodes, double given_tolerance,
                            std::span<const int> rank = {});
/// How many of the near nodes have each facet as their nearest, or one of them: at an edge of a
/// block this tells the face that the others lie on from the face around the corner.
std::vector<int> rank_of_facets(const ContactPass& pass, const CandidateList& list,
                                std::span<const NodeRecord> nodes, double given_tolerance);

struct TieLoad {
  PairForces forces;
  Vec3 stretch = Vec3::Zero(), normal = Vec3::Zero();
  double stiffness = 0;  ///< N/m
  double inverse = 0;    ///< 1/kg, of the pair along the spring
};
/// Nothing when constraints move both sides.
std::optional<TieLoad> tie_load(const ContactNode& node, const ContactFacet& facet, const Tie& tie,
                                std::span<const NodeRecord> nodes, double nominal_step);

}  // namespace crosswalk::fe
