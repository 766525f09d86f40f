// Commands of fe_node beyond run, check and keys.
#pragma once

#include <filesystem>

#include "common/node_main.h"

namespace crosswalk::fe {

NodeCommand solve_command();     ///< a keyword deck alone
NodeCommand validate_command();  ///< component tests against experiments and closed forms
NodeCommand bench_command();     ///< speed of the solver on generated workloads
/// `check` of a keyword deck: the report of its contents, or UserError.
void check_deck(const std::filesystem::path& file);

}  // namespace crosswalk::fe
