// `crosswalk check FILE` and `crosswalk keys`: every program answers for its own tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"

namespace crosswalk {

/// Hands a file to the `check` of each program; throws UserError with everything they found.
void check_with_programs(const std::filesystem::path& file,
                         const std::vector<std::string>& programs);

/// A scenario (.toml) or a keyword deck.
ExitCode check_command(const std::string& file);

/// The key reference of all programs, as Markdown; docs/scenario_keys.md is this text.
ExitCode keys_command();

}  // namespace crosswalk
