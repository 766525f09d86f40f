#include "fe_node/deck/deck_check.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "fe_node/deck/deck_references.h"
#include "fe_node/deck/element_measure.h"
#include "fe_node/deck/units_guess.h"

namespace crosswalk::fe {

namespace {

/// A corner Jacobian below this share of the largest is as good as inverted.
constexpr double kFlatCorner = 1e-6;

template <class Record>
void check_list(const Deck& deck, const std::vector<Record>& records, const char* word,
                DeckProblems& problems) {
  const IdTable table(records);
  const auto& entries = table.entries();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Record& record = records[static_cast<std::size_t>(entries[i].second)];
    if (entries[i].first.value <= 0)
      problems.errors.add(deck.place(record.source), fmt::format("{} id", word),
                          "a positive number", fmt::format("{}", entries[i].first.value));
    if (i == 0 || entries[i - 1].first != entries[i].first) continue;
    const Record& first = records[static_cast<std::size_t>(entries[i - 1].second)];
    const bool is_same = first == record;
    (is_same ? problems.warnings : problems.errors)
        .add(deck.place(record.source), fmt::format("{} id {}", word, entries[i].first.value),
             "one definition", is_same ? "the same one twice" : "another one",
             fmt::format("the first is at {}", deck.place(first.source).text()));
  }
}

void check_sets(const Deck& deck, DeckProblems& problems) {
  constexpr const char* kWords[] = {"node set",  "part set", "shell set",
                                    "solid set", "beam set", "discrete set"};
  for (int kind = 0; kind < 6; ++kind) {
    std::vector<DeckSet> of_kind;
    for (const DeckSet& set : deck.sets)
      if (static_cast<int>(set.kind) == kind) of_kind.push_back(set);
    check_list(deck, of_kind, kWords[kind], problems);
  }
}

}  // namespace

void check_ids(const Deck& deck, DeckProblems& problems) {
  check_list(deck, deck.nodes, "node", problems);
  check_list(deck, deck.solids, "solid", problems);
  check_list(deck, deck.shells, "shell", problems);
  check_list(deck, deck.thick_shells, "thick shell", problems);
  check_list(deck, deck.beams, "beam", problems);
  check_list(deck, deck.discretes, "discrete", problems);
  check_list(deck, deck.seatbelts, "seatbelt", problems);
  check_list(deck, deck.parts, "part", problems);
  check_list(deck, deck.sections, "section", problems);
  check_list(deck, deck.materials, "material", problems);
  check_list(deck, deck.hourglasses, "hourglass", problems);
  check_list(deck, deck.equations_of_state, "equation-of-state", problems);
  check_list(deck, deck.curves, "curve", problems);
  check_list(deck, deck.tables, "table", problems);
  check_list(deck, deck.segment_sets, "segment set", problems);
  check_sets(deck, problems);
}

namespace {

/// Ids by kind of reference.
class Known {
 public:
  explicit Known(const DeckIndex& index) : index_(index), deck_(index.deck()) {
    for (const CurveFunction& function : deck_.curve_functions) functions_.add(function.id, 0);
    functions_.sort();
    for (const CoordinateNodes& axes : deck_.coordinate_nodes) axes_.add(axes.id, 0);
    for (const CoordinateSystem& axes : deck_.coordinate_systems) axes_.add(axes.id, 0);
    axes_.sort();
  }

  bool has(Named kind, DeckId id) const {
    switch (kind) {
      case Named::Node:
        return index_.node_index(id) >= 0;
      case Named::Part:
        return index_.part(id) != nullptr || nodal_bodies_.has(id);
      case Named::Section:
        return index_.section(id) != nullptr;
      case Named::Material:
        return index_.material(id) != nullptr;
      case Named::EquationOfState:
        return equations_.has(id);
      case Named::Hourglass:
        return index_.hourglass(id) != nullptr;
      case Named::Integration:
        return integrations_.has(id);
      case Named::Curve:
        return index_.curve(id) != nullptr || index_.table(id) != nullptr || functions_.has(id);
      default:
        return has_set_or_other(kind, id);
    }
  }

 private:
  bool has_set_or_other(Named kind, DeckId id) const {
    switch (kind) {
      case Named::NodeSet:
        return index_.set(SetKind::Node, id) != nullptr;
      case Named::PartSet:
        return index_.set(SetKind::Part, id) != nullptr;
      case Named::ShellSet:
        return index_.set(SetKind::Shell, id) != nullptr;
      case Named::SolidSet:
        return index_.set(SetKind::Solid, id) != nullptr;
      case Named::BeamSet:
        return index_.set(SetKind::Beam, id) != nullptr;
      case Named::DiscreteSet:
        return index_.set(SetKind::Discrete, id) != nullptr;
      case Named::SegmentSet:
        return index_.segment_set(id) != nullptr;
      case Named::Axes:
        return axes_.has(id);
      case Named::Vector:
        return index_.vector(id) != nullptr;
      case Named::Box:
        return index_.box(id) != nullptr;
      case Named::SpringOrientation:
        return orientations_.has(id);
      case Named::Joint:
        return joints_.has(id);
      default:
        return false;
    }
  }

  const DeckIndex& index_;
  const Deck& deck_;
  IdTable functions_, axes_;
  IdTable equations_{deck_.equations_of_state}, integrations_{deck_.integrations};
  IdTable orientations_{deck_.spring_orientations}, joints_{deck_.joints};
  IdTable nodal_bodies_{deck_.nodal_rigid_bodies};
};

/// Gathers dangling ids: one problem for each record and kind of record it misses, one for each
/// part that elements miss; while files are missing, one warning for each kind.
class Dangling {
 public:
  Dangling(const Deck& deck, DeckProblems& problems) : deck_(deck), problems_(problems) {}
  ~Dangling() {
    flush();
    for (const auto& [key, group] : elements_without_part_) report(group, "elements like it");
    for (const auto& [word, group] : in_missing_files_)
      problems_.warnings.add(deck_.place(group.source), group.by,
                             fmt::format("{} {}", word, group.first.value), "none of that number",
                             fmt::format("{} such references; what they name may be in the files "
                                         "that are missing",
                                         group.count));
  }
  Dangling(const Dangling&) = delete;
  Dangling& operator=(const Dangling&) = delete;

  void add(Source source, const std::string& by, const char* word, DeckId id) {
    if (!deck_.missing_includes.empty()) {
      ++in_missing_files_.try_emplace(word, Group{source, by, word, id, 0}).first->second.count;
      return;
    }
    const bool is_same = group_.count > 0 && group_.by == by && group_.word == word &&
                         group_.source.line == source.line && group_.source.file == source.file;
    if (!is_same) {
      flush();
      group_ = {source, by, word, id, 0};
    }
    ++group_.count;
  }

  /// The part of an element; `kind` is the element's.
  void add_part(Source source, const char* kind, DeckId element, DeckId part) {
    const std::string by = fmt::format("{} {}", kind, element.value);
    if (!deck_.missing_includes.empty()) return add(source, by, "part", part);
    ++elements_without_part_.try_emplace({kind, part}, Group{source, by, "part", part, 0})
          .first->second.count;
  }

 private:
  struct Group {
    Source source;
    std::string by, word;
    DeckId first;
    long count = 0;
  };
  void flush() {
    if (group_.count > 0) report(group_, "more like it");
    group_.count = 0;
  }
  void report(const Group& group, const char* others) {
    std::string found = "none of that number";
    if (group.count > 1) found += fmt::format(", and {} {}", group.count - 1, others);
    problems_.errors.add(deck_.place(group.source), group.by,
                         fmt::format("{} {}", group.word, group.first.value), std::move(found));
  }

  const Deck& deck_;
  DeckProblems& problems_;
  Group group_;
  std::map<std::string, Group> in_missing_files_;
  std::map<std::pair<std::string, DeckId>, Group> elements_without_part_;
};

template <class Element>
void check_element_ids(const DeckIndex& index, const std::vector<Element>& elements,
                       const char* word, Dangling& dangling) {
  for (const Element& element : elements) {
    if (index.part(element.part) == nullptr)
      dangling.add_part(element.source, word, element.id, element.part);
    for (const DeckId node : element.nodes)
      if (node.given() && index.node_index(node) < 0)
        dangling.add(element.source, fmt::format("{} {}", word, element.id.value), "node", node);
  }
}

}  // namespace

void check_references(const DeckIndex& index, DeckProblems& problems) {
  const Deck& deck = index.deck();
  const Known known(index);
  Dangling dangling(deck, problems);
  check_element_ids(index, deck.solids, "solid", dangling);
  check_element_ids(index, deck.shells, "shell", dangling);
  check_element_ids(index, deck.thick_shells, "thick-shell", dangling);
  check_element_ids(index, deck.beams, "beam", dangling);
  check_element_ids(index, deck.discretes, "discrete", dangling);
  check_element_ids(index, deck.seatbelts, "seatbelt", dangling);
  for (const MassElement& mass : deck.masses) {
    constexpr Named kTargets[] = {Named::Node, Named::NodeSet, Named::Part, Named::PartSet};
    const Named kind = kTargets[static_cast<int>(mass.kind)];
    if (!known.has(kind, mass.target))
      dangling.add(mass.source, "*ELEMENT_MASS", named_word(kind), mass.target);
  }
  for_each_reference(deck, [&](const Reference& reference) {
    if (!known.has(reference.kind, reference.id))
      dangling.add(reference.source, reference.by, named_word(reference.kind), reference.id);
  });
}

namespace {

/// Positions of an element's nodes; false when one of them does not exist (reported elsewhere).
bool positions(const DeckIndex& index, std::span<const DeckId> ids, std::array<Vec3, 10>& x) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const DeckNode* node = index.node(ids[i]);
    if (node == nullptr) return false;
    x[i] = node->position;
  }
  return true;
}

void check_solid(const DeckIndex& index, const SolidElement& element, DeckProblems& problems) {
  const Deck& deck = index.deck();
  const ShapedSolid solid = solid_shape(element);
  const std::size_t count = static_cast<std::size_t>(solid.count);
  const auto at = [&] { return deck.place(element.source); };
  const std::string name = fmt::format("solid {}", element.id.value);
  for (std::size_t i = 0; i < count; ++i)
    if (!solid.nodes[i].given())
      return problems.errors.add(at(), name, "4, 5, 6, 8 or 10 nodes", "a node that is missing");
  std::array<Vec3, 10> x;
  if (!positions(index, {solid.nodes.data(), count}, x)) return;
  const Measure measure = solid_measure(solid.shape, {x.data(), count});
  const std::string found =
      fmt::format("{} of volume {:.4g} (part {})", solid_shape_name(solid.shape), measure.size,
                  element.part.value);
  if (measure.size == 0)
    return problems.errors.add(at(), name, "a positive volume", found, "its nodes lie in a plane");
  if (measure.size < 0)
    return problems.errors.add(at(), name, "a positive volume", found,
                               "it is inside out: turn the order of its nodes");
  if (measure.worst <= kFlatCorner)
    problems.warnings.add(at(), name, "positive corner Jacobians",
                          fmt::format("{:.2g} of the largest", measure.worst));
}

void check_shell(const DeckIndex& index, const ShellElement& element, DeckProblems& problems) {
  const Deck& deck = index.deck();
  const std::string name = fmt::format("shell {}", element.id.value);
  const std::size_t count = is_triangle(element) ? 3 : 4;
  const std::span<const DeckId> nodes(element.nodes.data(), count);
  for (const DeckId node : nodes)
    if (!node.given())
      return problems.errors.add(deck.place(element.source), name, "3 or 4 nodes",
                                 "a node that is missing");
  std::array<Vec3, 10> x;
  if (!positions(index, nodes, x)) return;
  const Measure measure = shell_measure({x.data(), count});
  if (measure.size == 0)
    return problems.errors.add(deck.place(element.source), name, "a positive area",
                               fmt::format("zero (part {})", element.part.value));
  if (measure.worst <= kFlatCorner)
    problems.warnings.add(deck.place(element.source), name, "a convex quadrilateral",
                          fmt::format("a corner of {:.2g}", measure.worst));
}

bool may_have_no_length(const DeckIndex& index, const BeamElement& element) {
  const Part* part = index.part(element.part);
  const Section* section = part == nullptr ? nullptr : index.section(part->section);
  const auto* beam = section == nullptr ? nullptr : std::get_if<SectionBeam>(&section->law);
  return beam == nullptr || beam->formulation == 6;
}

}  // namespace

void check_elements(const DeckIndex& index, DeckProblems& problems) {
  const Deck& deck = index.deck();
  if (!deck.thick_shells.empty())
    problems.errors.add(deck.place(deck.thick_shells.front().source), "*ELEMENT_TSHELL",
                        "solids or shells",
                        fmt::format("{} thick shells", deck.thick_shells.size()),
                        "elements of this kind are not computed");
  for (const SolidElement& element : deck.solids) check_solid(index, element, problems);
  for (const ShellElement& element : deck.shells) check_shell(index, element, problems);
  for (const BeamElement& element : deck.beams) {
    const DeckNode* a = index.node(element.nodes[0]);
    const DeckNode* b = index.node(element.nodes[1]);
    const std::string name = fmt::format("beam {}", element.id.value);
    if (!element.nodes[0].given() || !element.nodes[1].given())
      problems.errors.add(deck.place(element.source), name, "2 nodes", "a node that is missing");
    else if (a != nullptr && b != nullptr && a->position == b->position &&
             !may_have_no_length(index, element))
      problems.errors.add(deck.place(element.source), name, "a length", "zero");
  }
}

void check_deck(const DeckIndex& index, DeckProblems& problems) {
  check_ids(index.deck(), problems);
  check_references(index, problems);
  check_elements(index, problems);
  check_values(index, problems);
  check_units(index.deck(), problems);
}

}  // namespace crosswalk::fe
