#include "fe_node/own_head.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.h"
#include "fe_node/deck/runnable.h"
#include "fe_node/part_selection.h"

namespace crosswalk::fe {
namespace {

class Adapter {
 public:
  Adapter(Deck& deck, const HeadNeckConfig& config) : deck_(deck), config_(config) {}

  void run(const std::vector<InterfaceSpec>& interfaces) {
    for (const InterfaceSpec& interface : interfaces)
      if (interface.is_attached) attempt([&] { make_block(interface); });
    const PartNames& names = config_.names;
    attempt([&] { add_part_set(kHeadParts, names.head, "head_neck.head_parts"); });
    attempt([&] { add_part_set(kBrainParts, names.brain, "head_neck.brain_parts"); });
    attempt([&] { add_part_set(kHeadSurface, names.surface, "head_neck.surface_parts"); });
    attempt([&] { add_skull_nodes(); });
    problems_.finish();
  }

 private:
  template <class Step>
  void attempt(const Step& step) {
    try {
      step();
    } catch (const UserError& error) {
      for (const Problem& problem : error.problems()) problems_.add(problem);
    }
  }

  /// A rigid part by title or number, or the nodes of a set made rigid.
  void make_block(const InterfaceSpec& interface) {
    const std::string title = block_title(interface.body);
    const std::string what = fmt::format("interfaces.{}.part", interface.body);
    for (const Part& part : deck_.parts)
      if (part.title == title && interface.part == interface.body) return require_rigid(part, what);
    for (const DeckSet& set : deck_.sets) {
      if (set.kind != SetKind::Node || set.title != interface.part) continue;
      NodalRigidBody body;
      body.id = DeckId(free_part_id());
      body.node_set = set.id;
      body.title = title;
      deck_.nodal_rigid_bodies.push_back(body);
      return;
    }
    const std::vector<DeckId> parts = select_parts(deck_, interface.part, what);
    Part& first = part_of(parts.front());
    for (const DeckId id : parts) require_rigid(part_of(id), what);
    first.title = title;
    for (std::size_t i = 1; i < parts.size(); ++i)
      deck_.merged_rigid_bodies.push_back({first.id, parts[i], 0, {}});
  }

  void require_rigid(const Part& part, const std::string& what) {
    if (is_rigid(deck_, part)) return;
    problems_.add(Problem{deck_.place(part.source),
                          what,
                          "a part of *MAT_RIGID, or a node set",
                          fmt::format("part {} '{}', which deforms", part.id.value, part.title),
                          {}});
  }

  Part& part_of(DeckId id) {
    return *std::find_if(deck_.parts.begin(), deck_.parts.end(),
                         [id](const Part& part) { return part.id == id; });
  }

  int free_part_id() const {
    int id = 0;
    for (const Part& part : deck_.parts) id = std::max(id, part.id.value);
    for (const NodalRigidBody& body : deck_.nodal_rigid_bodies) id = std::max(id, body.id.value);
    return id + 1;
  }

  int free_set_id() const {
    int id = 0;
    for (const DeckSet& set : deck_.sets) id = std::max(id, set.id.value);
    return id + 1;
  }

  /// A set that has the title already, of the deck's own, keeps it only when it is the one meant.
  void add_set(SetKind kind, const char* title, const std::string& name, std::vector<DeckId> ids) {
    for (DeckSet& set : deck_.sets) {
      if (set.kind != kind || set.title != title) continue;
      if (name == title) return;
      set.title += " (of the deck)";
    }
    DeckSet set;
    set.kind = kind;
    set.id = DeckId(free_set_id());
    set.title = title;
    set.ids = std::move(ids);
    deck_.sets.push_back(std::move(set));
  }

  void add_part_set(const char* title, const std::string& names, const std::string& what) {
    add_set(SetKind::Part, title, names, select_parts(deck_, names, what));
  }

  void add_skull_nodes() {
    constexpr std::size_t kFewest = 3;
    std::vector<DeckId> nodes = select_nodes(deck_, config_.names.skull, "head_neck.skull_nodes");
    if (nodes.size() < kFewest) {
      problems_.add(Problem{{deck_.files.names.empty() ? "" : deck_.files.names.front()},
                            "head_neck.skull_nodes",
                            "three nodes or more",
                            std::to_string(nodes.size()),
                            {}});
      return;
    }
    add_set(SetKind::Node, kSkullNodes, config_.names.skull, std::move(nodes));
  }

  Deck& deck_;
  const HeadNeckConfig& config_;
  Diagnostics problems_;
};

}  // namespace

bool is_rigid(const Deck& deck, const Part& part) {
  return std::any_of(deck.materials.begin(), deck.materials.end(), [&part](const Material& m) {
    return m.id == part.material && std::holds_alternative<mat::Rigid>(m.law);
  });
}

std::string block_title(const std::string& body) { return "block_" + body; }

Deck read_own_deck(const FeConfig& config) {
  ReadDeck read = read_deck(config.head_neck.deck);
  require_runnable(read, MissingPolicy::Refuse);
  adapt_deck(read.deck, config.head_neck,
             config.is_head_alone ? std::vector<InterfaceSpec>{} : config.interfaces);
  return std::move(read.deck);
}

void adapt_deck(Deck& deck, const HeadNeckConfig& config,
                const std::vector<InterfaceSpec>& interfaces) {
  Adapter(deck, config).run(interfaces);
}

}  // namespace crosswalk::fe
