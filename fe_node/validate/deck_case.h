// A validation case as a keyword deck: a generated draft with the case's loading, written to a
// file, read back and run by the solver as any deck is.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "fe_node/deck/deck.h"
#include "fe_node/generate/part_spec.h"
#include "fe_node/model_builder/model_builder.h"
#include "fe_node/solver.h"
#include "fe_node/validate/computing.h"

namespace crosswalk::fe::validate {

using Points = std::vector<std::pair<double, double>>;

/// Adds loading to a generated deck; every argument is SI, nodes are indices of the draft.
class DeckCase {
 public:
  DeckCase(const generate::ModelDraft& draft, UnitSystem units);

  /// Velocity of a rigid part over time; axis 0..2 along, 3..5 about the global axes.
  void guide_part(int part, int axis, const Points& velocity);
  void guide_nodes(const std::vector<int>& nodes, int axis, const Points& velocity);
  void fix_nodes(const std::vector<int>& nodes);
  /// Force over time, shared evenly by the nodes.
  void load_nodes(const std::vector<int>& nodes, int axis, const Points& total_force);
  void start_velocity(const Vec3& velocity);
  void start_velocity(const std::vector<int>& nodes, const Vec3& velocity);
  /// A fixed rigid plane or sphere; only `nodes` touch it.
  void add_plane(const Vec3& point, const Vec3& normal, const std::vector<int>& nodes,
                 double friction);
  void add_sphere(const Vec3& centre, double radius, const std::vector<int>& nodes,
                  double friction);
  void end_at(double time);

  Deck deck;

 private:
  DeckId add_curve(const Points& points, double y_unit);
  DeckId add_set(const std::vector<int>& nodes);
  UnitFactors units_;
  int next_ = 9001;  ///< above every number of the generators' sets and curves
};

/// The deck in the solver.
class DeckRun {
 public:
  /// Writes folder/case.k and builds the model from what is read back. `added_mass_limit`: share of
  /// the mass that mass scaling may add; 0: none.
  DeckRun(const Deck& deck, const std::filesystem::path& folder, const Computing& computing,
          double added_mass_limit = 0);

  const Model& model() const { return built_.model; }
  const BuiltModel& built() const { return built_; }
  const State& state() const { return state_; }
  const Scratch& scratch() const { return *scratch_; }
  double added_mass_share() const;
  double largest_internal() const { return largest_internal_; }    ///< energy until now, J
  double largest_hourglass() const { return largest_hourglass_; }  ///< likewise
  /// The solver's own index of a draft node: the solver orders nodes anew.
  int node_of(int draft_node) const { return node_of_[draft_node]; }

  /// Runs to `end`; calls `watch` with the state at 0 and about every `interval` (0: every step).
  void run(double end, double interval, const std::function<void(const State&)>& watch);

 private:
  BuiltModel built_;
  State state_;
  std::unique_ptr<Scratch> scratch_;
  std::vector<int> node_of_;
  double largest_internal_ = 0, largest_hourglass_ = 0;
};

}  // namespace crosswalk::fe::validate
