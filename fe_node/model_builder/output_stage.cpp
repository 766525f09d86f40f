// *DATABASE_HISTORY and *DATABASE_CROSS_SECTION cards to history requests.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

class OutputStage {
 public:
  explicit OutputStage(BuildContext& context) : c_(context) {}

  void run() {
    HistoryRequests& requests = c_.built.histories;
    for (const HistoryRequest& request : c_.deck.histories) add(request);
    for (const CrossSection& section : c_.deck.cross_sections) add(section);
    double interval = std::numeric_limits<double>::infinity();
    for (const DatabaseRequest& database : c_.deck.databases)
      for (const char* keyword : {"DATABASE_NODOUT", "DATABASE_ELOUT", "DATABASE_SECFORC",
                                  "DATABASE_RCFORC", "DATABASE_JNTFORC", "DATABASE_DEFORC"})
        if (database.keyword == keyword && database.interval > 0)
          interval = std::min(interval, database.interval * c_.units.time);
    if (interval < std::numeric_limits<double>::infinity()) requests.interval = interval;
  }

 private:
  static std::vector<ElementKind> kinds_of(const std::string& kind) {
    if (kind == "SHELL") return {ElementKind::Quad4, ElementKind::Tri3};
    if (kind == "SOLID") return {ElementKind::Hex8, ElementKind::Tet4};
    return {ElementKind::Line2};
  }
  static SetKind set_kind_of(const std::string& kind) {
    if (kind == "SHELL") return SetKind::Shell;
    if (kind == "SOLID") return SetKind::Solid;
    return kind == "BEAM" ? SetKind::Beam : SetKind::Discrete;
  }

  void add(const HistoryRequest& request) {
    const std::string who = "*DATABASE_HISTORY_" + request.kind;
    HistoryRequests& requests = c_.built.histories;
    if (request.kind == "NODE") {
      const std::vector<int> nodes =
          request.is_set ? c_.node_set(request.id, request.source)
                         : std::vector<int>{c_.node(request.id, request.source, who)};
      for (int n : nodes)
        if (n >= 0) requests.nodes.push_back(n);
      return;
    }
    const std::vector<DeckId> ids =
        request.is_set ? c_.set_ids(set_kind_of(request.kind), request.id, request.source)
                       : std::vector<DeckId>{request.id};
    append(kinds_of(request.kind), ids, request.source, who, requests.elements);
  }

  void append(const std::vector<ElementKind>& kinds, std::vector<DeckId> ids, Source source,
              const std::string& who, std::vector<std::pair<ElementKind, int>>& out) {
    std::sort(ids.begin(), ids.end());
    std::size_t found = 0;
    for (ElementKind kind : kinds) {
      const ElementTable& table = c_.mesh().table(kind);
      for (int e = 0; e < table.size(); ++e)
        if (std::binary_search(ids.begin(), ids.end(), table.id[e])) {
          out.emplace_back(kind, e);
          ++found;
        }
    }
    if (found < ids.size())
      c_.problem(source, who, "elements of the deck",
                 fmt::format("{} that it does not have", ids.size() - found));
  }

  void add(const CrossSection& section) {
    const std::string who = fmt::format("*DATABASE_CROSS_SECTION_SET {}", section.id.value);
    SectionCut cut;
    cut.name = section.title.empty()
                   ? fmt::format("section {}", c_.built.histories.sections.size() + 1)
                   : section.title;
    cut.name.erase(cut.name.find_last_not_of(" \t") + 1);
    cut.nodes = c_.node_set(section.nodes, section.source);
    const struct {
      DeckId id;
      const char* kind;
    } sides[] = {{section.solids, "SOLID"},
                 {section.beams, "BEAM"},
                 {section.shells, "SHELL"},
                 {section.discretes, "DISCRETE"}};
    for (const auto& side : sides)
      if (side.id.given())
        append(kinds_of(side.kind), c_.set_ids(set_kind_of(side.kind), side.id, section.source),
               section.source, who, cut.elements);
    if (cut.nodes.empty() || cut.elements.empty() || section.thick_shells.given() ||
        section.reference.given())
      c_.problem(section.source, who,
                 "nodes and solids, shells, beams or springs of one side, in global axes",
                 "something else");
    c_.built.histories.sections.push_back(std::move(cut));
  }

  BuildContext& c_;
};

}  // namespace

void build_outputs(BuildContext& context) { OutputStage(context).run(); }

}  // namespace crosswalk::fe
