// Commands of fe_node beyond run and keys.
#pragma once

#include "common/node_main.h"
#include "fe_node/deck/deck.h"
#include "fe_node/deck/deck_problems.h"

namespace crosswalk::fe {

NodeCommand solve_command();     ///< a keyword deck alone
NodeCommand validate_command();  ///< component tests against experiments and closed forms
NodeCommand model_command();     ///< the generated decks of a scenario and their report
NodeCommand bench_command();     ///< speed of the solver on generated workloads
CheckFile check_command(CLI::App& options);  ///< `check` of a keyword deck: prints its report

/// Builds the model as `solve` would and tells its mass and step.
std::vector<std::string> try_model(const Deck& deck, DeckProblems& problems);

}  // namespace crosswalk::fe
