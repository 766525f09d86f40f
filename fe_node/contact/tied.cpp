#include "fe_node/contact/tied.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "fe_node/contact/pair.h"
#include "fe_node/contact/search.h"

namespace crosswalk::fe {
namespace {

/// A tied node: indices (node entry, facet, sector), values (four weights, offset along the
/// normal).
constexpr int kIndices = 3, kValues = 5;

class TiedContact final : public ContactInterface {
 public:
  TiedContact(std::string name, const ContactSurface& nodes, const ContactSurface& facets,
              const TiedSettings& settings)
      : ContactInterface(std::move(name)), settings_(settings) {
    CW_ASSERT(settings.nominal_step > 0);
    pass_.nodes = nodes.nodes;
    pass_.facets = facets.facets;
    pass_.neighbour_begin.assign(pass_.nodes.size() + 1, 0);
  }
  void initialise(ContactHistory& history, const ContactContext& context) const override;
  int max_nodal_loads() const override { return 5 * static_cast<int>(pass_.nodes.size()); }
  ContactReport forces(const ContactContext& context, ContactHistory& history,
                       ContactLoads& loads) const override;

 private:
  double tolerance(const ContactNode& node, const ContactFacet& facet, const FacetCorners& x) const;
  ContactPass pass_;
  TiedSettings settings_;
};

double TiedContact::tolerance(const ContactNode& node, const ContactFacet& facet,
                              const FacetCorners& x) const {
  if (settings_.tolerance > 0) return settings_.tolerance;
  const double diagonal = std::min((x[2] - x[0]).norm(), (x[3] - x[1]).norm());
  return std::max(1.2 * (node.half_thickness + facet.half_thickness), 0.05 * diagonal);
}

void TiedContact::initialise(ContactHistory& history, const ContactContext& context) const {
  history = {};
  double reach = 0;
  for (const ContactFacet& facet : pass_.facets)
    for (const ContactNode& node : pass_.nodes)
      reach = std::max(reach, tolerance(node, facet, corners_of(facet, context.nodes)));
  std::vector<int> found;
  search(pass_, context.nodes, reach, {}, {}, found);
  const CandidateList list(found);
  for (int i = 0; i < list.count(); ++i) {
    const NearNode near = list[i];
    const ContactNode& node = pass_.nodes[near.node];
    const Vec3 x = context.nodes[node.node].position();
    Projection best;
    int best_facet = -1;
    for (int f : near.candidates) {
      const FacetCorners corners = corners_of(pass_.facets[f], context.nodes);
      const Projection p = closest_point(x, corners, pass_.facets[f].is_triangle());
      if (p.distance > tolerance(node, pass_.facets[f], corners)) continue;
      if (best_facet < 0 || p.distance < best.distance) {
        best = p;
        best_facet = f;
      }
    }
    if (best_facet < 0) continue;
    history.indices.insert(history.indices.end(), {near.node, best_facet, best.sector});
    history.values.insert(history.values.end(), best.weight.begin(), best.weight.end());
    history.values.push_back((x - best.point).dot(best.normal));
  }
}

ContactReport TiedContact::forces(const ContactContext& context, ContactHistory& history,
                                  ContactLoads& loads) const {
  ContactReport report;
  const int count = static_cast<int>(history.indices.size()) / kIndices;
  double omega2 = 0;
  for (int i = 0; i < count; ++i) {
    const ContactNode& node = pass_.nodes[history.indices[kIndices * i]];
    const ContactFacet& facet = pass_.facets[history.indices[kIndices * i + 1]];
    if (context.failed != nullptr && context.failed->contains(facet.kind, facet.element)) continue;
    const double* value = history.values.data() + kValues * i;
    const FacetCorners x = corners_of(facet, context.nodes);
    Projection at;
    double inverse = context.nodes[node.node].inverse_mass, heaviest = 0;
    at.sector = history.indices[kIndices * i + 2];
    at.point.setZero();
    for (int c = 0; c < 4; ++c) {
      at.weight[c] = value[c];
      at.point += value[c] * x[c];
      const double corner = context.nodes[facet.node[c]].inverse_mass;
      inverse += value[c] * value[c] * corner;
      heaviest = std::max(heaviest, corner);
    }
    const Vec3 centre = facet.is_triangle() ? x[2] : Vec3(0.25 * (x[0] + x[1] + x[2] + x[3]));
    const Vec3& a = x[facet.is_triangle() ? 0 : at.sector];
    const Vec3& b = x[facet.is_triangle() ? 1 : (at.sector + 1) % 4];
    at.normal = (b - a).cross(centre - a).normalized();
    const double bound = context.nodes[node.node].inverse_mass + heaviest;
    if (bound == 0) continue;  // both moved by constraints
    const double k = 0.25 / (bound * settings_.nominal_step * settings_.nominal_step);
    const Vec3 stretch = context.nodes[node.node].position() - at.point - value[4] * at.normal;
    const PairForces f =
        balanced_forces(pair_frame(x, facet.is_triangle(), at, at.normal, value[4]), -k * stretch);
    loads.nodal.push_back({node.node, f.on_node});
    for (int c = 0; c < (facet.is_triangle() ? 3 : 4); ++c)
      loads.nodal.push_back({facet.node[c], f.on_corner[c]});
    report.stored += 0.5 * k * stretch.squaredNorm();
    report.force += f.on_node;
    report.max_penetration = std::max(report.max_penetration, stretch.norm());
    omega2 = std::max(omega2, k * inverse);
    ++report.active;
  }
  if (omega2 > 0) report.stable_step = 2 / std::sqrt(2 * omega2);
  return report;
}

}  // namespace

std::unique_ptr<ContactInterface> make_tied_contact(std::string name, ContactSurface nodes,
                                                    ContactSurface facets,
                                                    const TiedSettings& settings) {
  return std::make_unique<TiedContact>(std::move(name), nodes, facets, settings);
}

}  // namespace crosswalk::fe
