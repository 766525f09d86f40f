// Runs a keyword deck from its start to its end time: fields, energy history, restart file.
#pragma once

#include <filesystem>
#include <string>

#include "fe_node/deck/keyword_reader.h"
#include "fe_node/element/element_controls.h"
#include "fe_node/energy.h"
#include "fe_node/model.h"

namespace crosswalk::fe {

struct SolveRequest {
  std::filesystem::path deck;
  ReadOptions reading;
  std::filesystem::path folder;  ///< for the results
  UnitSystem units = UnitSystem::Unknown;
  int threads = 1;
  double end_time = 0;            ///< s; 0: as the deck says
  Precision precision = Precision::Double;
  bool accept_missing = false;    ///< run although the deck has keywords that cannot be honoured
  std::filesystem::path restart;  ///< state to go on from; empty: from the start
};

struct SolveResult {
  double time = 0;
  std::int64_t steps = 0;
  Energies energies;
  double added_mass = 0, total_mass = 0;  ///< kg
};

/// Mass, added mass and stable step of a finished model, a line each.
std::vector<std::string> model_summary(const Model& model);

/// Throws UserError for the deck and NumericalError when the computation leaves its valid range;
/// the last sound frame is then in the folder.
SolveResult solve_deck(const SolveRequest& request);

}  // namespace crosswalk::fe
