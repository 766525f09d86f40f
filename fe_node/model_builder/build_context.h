// What the stages of the model builder share: the deck, unit factors, look-ups by user id, and the
// problems found so far.
#pragma once

#include <map>
#include <optional>
#include <unordered_map>

#include "fe_node/deck/deck_problems.h"
#include "fe_node/element/element_controls.h"
#include "fe_node/model_builder/model_builder.h"

namespace crosswalk::fe {

struct BuildContext {
  const Deck& deck;
  const BuildOptions& options;
  UnitFactors units;
  BuiltModel& built;
  ProblemList problems{};
  int problem_count = 0;

  std::unordered_map<DeckId, int> node_index{};
  std::unordered_map<DeckId, int> part_index{};  ///< into Deck::parts and Mesh::parts alike
  std::unordered_map<DeckId, const Section*> sections{};
  std::unordered_map<DeckId, const Material*> materials{};
  std::unordered_map<DeckId, const DeckCurve*> curves{};
  std::unordered_map<DeckId, const Hourglass*> hourglasses{};
  std::map<std::pair<SetKind, DeckId>, const DeckSet*> sets{};
  std::unordered_map<DeckId, double> shell_thickness{};  ///< m, of shells with their own
  std::unordered_map<int, int> body_of_part{};           ///< mesh part -> index into Model::bodies

  Model& model() { return built.model; }
  Mesh& mesh() { return built.model.mesh; }
  void problem(Source source, std::string what, std::string expected, std::string found,
               std::string hint = {});
  void note(std::string text) { built.notes.push_back(std::move(text)); }

  /// Index of a node, or -1 and a problem.
  int node(DeckId id, Source source, std::string_view who);
  /// A curve in SI, or nothing and a problem.
  std::optional<Curve> curve(DeckId id, double x_unit, double y_unit, Source source,
                             std::string_view who, Curve::Outside outside = Curve::Outside::Hold);
  /// Members of a node or part set by user id: list, ranges and added sets.
  std::vector<DeckId> set_ids(SetKind kind, DeckId id, Source source);
  std::vector<int> node_set(DeckId id, Source source);  ///< indices, rising
  std::vector<int> part_set(DeckId id, Source source);
  /// Nodes of the elements of these parts, rising.
  std::vector<int> nodes_of_parts(const std::vector<int>& parts) const;
  const Section* section_of(const Part& part) const;
  const Material* material_of(const Part& part) const;
};

// The stages, in their order.
void build_mesh(BuildContext& context);
void build_bodies(BuildContext& context);
void build_blocks(BuildContext& context);
void build_conditions(BuildContext& context);
void build_pressures(BuildContext& context);
void build_joints(BuildContext& context);
void build_joint_stiffness(BuildContext& context);
void build_contacts(BuildContext& context);
void build_mesh_contacts(BuildContext& context);
void build_outputs(BuildContext& context);
/// What would let a run end in nonsense: bodies without mass, elements without a stable step.
void check_model(BuildContext& context);

}  // namespace crosswalk::fe
