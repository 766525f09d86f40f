#include "fe_node/contact/tied.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "fe_node/contact/tie.h"

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

  void initialise(ContactHistory& history, const ContactContext& context) const override {
    history = {};
    const double reach = tie_reach(pass_, context.nodes, settings_.tolerance);
    std::vector<int> found;
    search(pass_, context.nodes, reach, {}, {}, found);
    const CandidateList list(found);
    for (int i = 0; i < list.count(); ++i) {
      const auto tie = find_tie(pass_, list[i], context.nodes, settings_.tolerance);
      if (!tie) continue;
      history.indices.insert(history.indices.end(), {list[i].node, tie->facet, tie->sector});
      history.values.insert(history.values.end(), tie->weight.begin(), tie->weight.end());
      history.values.push_back(tie->offset);
    }
  }

  int max_nodal_loads() const override { return 5 * static_cast<int>(pass_.nodes.size()); }

  ContactReport forces(const ContactContext& context, ContactHistory& history,
                       ContactLoads& loads) const override {
    ContactReport report;
    const int count = static_cast<int>(history.indices.size()) / kIndices;
    double omega2 = 0;
    for (int i = 0; i < count; ++i) {
      const int* index = history.indices.data() + kIndices * i;
      const double* value = history.values.data() + kValues * i;
      const ContactNode& node = pass_.nodes[index[0]];
      const ContactFacet& facet = pass_.facets[index[1]];
      if (context.failed != nullptr && context.failed->contains(facet.kind, facet.element))
        continue;
      const Tie tie{index[1], index[2], {value[0], value[1], value[2], value[3]}, value[4]};
      const auto load = tie_load(node, facet, tie, context.nodes, settings_.nominal_step);
      if (!load) continue;
      loads.nodal.push_back({node.node, load->forces.on_node});
      for (int c = 0; c < (facet.is_triangle() ? 3 : 4); ++c)
        loads.nodal.push_back({facet.node[c], load->forces.on_corner[c]});
      report.stored += 0.5 * load->stiffness * load->stretch.squaredNorm();
      report.force += load->forces.on_node;
      report.max_penetration = std::max(report.max_penetration, load->stretch.norm());
      omega2 = std::max(omega2, load->stiffness * load->inverse);
      ++report.active;
    }
    if (omega2 > 0) report.stable_step = 2 / std::sqrt(2 * omega2);
    return report;
  }

 private:
  ContactPass pass_;
  TiedSettings settings_;
};

}  // namespace

std::unique_ptr<ContactInterface> make_tied_contact(std::string name, ContactSurface nodes,
                                                    ContactSurface facets,
                                                    const TiedSettings& settings) {
  return std::make_unique<TiedContact>(std::move(name), nodes, facets, settings);
}

}  // namespace crosswalk::fe
