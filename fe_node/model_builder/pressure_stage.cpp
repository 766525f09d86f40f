// *LOAD_SEGMENT and *LOAD_SHELL cards to pressures on facets.
#include <algorithm>

#include <fmt/format.h>

#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

using Facets = std::vector<std::array<int, 4>>;

class PressureStage {
 public:
  explicit PressureStage(BuildContext& context) : c_(context) {}

  void add(const LoadPressure& card) {
    if (card.arrival > 0) {
      c_.problem(card.source, kWho, "no arrival time", fmt::format("{:g}", card.arrival),
                 "shift the curve");
      return;
    }
    const auto curve = c_.curve(card.curve, c_.units.time, c_.units.stress(), card.source, kWho);
    if (!curve) return;
    PressureLoad load{facets(card), *curve, card.scale};
    if (load.facets.empty()) {
      c_.problem(card.source, kWho, "segments or shells of the deck", "none");
      return;
    }
    c_.model().pressures.push_back(std::move(load));
  }

 private:
  static constexpr const char* kWho = "*LOAD_SEGMENT or *LOAD_SHELL";

  Facets facets(const LoadPressure& card) {
    switch (card.kind) {
      case LoadPressure::Target::Segment:
        return {segment(card.nodes, card.source)};
      case LoadPressure::Target::SegmentSet:
        return segment_set(card);
      case LoadPressure::Target::Shell:
        return shells({card.target});
      case LoadPressure::Target::ShellSet:
        return shells(c_.set_ids(SetKind::Shell, card.target, card.source));
    }
    return {};
  }

  std::array<int, 4> segment(const std::array<DeckId, 4>& nodes, Source source) {
    std::array<int, 4> out{};
    for (std::size_t i = 0; i < 4; ++i)
      out[i] = i == 3 && !nodes[3].given() ? out[2] : std::max(0, c_.node(nodes[i], source, kWho));
    return out;
  }

  Facets segment_set(const LoadPressure& card) {
    Facets out;
    for (const SegmentSet& set : c_.deck.segment_sets)
      if (set.id == card.target)
        for (const auto& nodes : set.segments) out.push_back(segment(nodes, set.source));
    return out;
  }

  Facets shells(std::vector<DeckId> ids) const {
    std::sort(ids.begin(), ids.end());
    Facets out;
    for (ElementKind kind : {ElementKind::Quad4, ElementKind::Tri3}) {
      const ElementTable& table = c_.built.model.mesh.table(kind);
      for (int e = 0; e < table.size(); ++e) {
        if (!std::binary_search(ids.begin(), ids.end(), table.id[e])) continue;
        const std::span<const int> n = c_.built.model.mesh.corners(kind, e);
        out.push_back({n[0], n[1], n[2], n.back()});
      }
    }
    return out;
  }

  BuildContext& c_;
};

}  // namespace

void build_pressures(BuildContext& context) {
  for (const LoadPressure& load : context.deck.pressures) PressureStage(context).add(load);
}

}  // namespace crosswalk::fe
