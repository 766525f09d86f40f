// The results of validation cases as text for the terminal, as CSV, and as gnuplot pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fe_node/validate/measure.h"

namespace crosswalk::fe::validate {

/// The table printed at the end: one line per measure.
std::string table_text(const CaseResult& result);
/// validation.csv, and per plot its numbers, a gnuplot script and, where gnuplot is installed, a
/// picture. Returns what the user should know (no gnuplot).
std::vector<std::string> write_results(const std::vector<CaseResult>& results,
                                       const std::filesystem::path& folder);
/// Closed forms that are not met.
int failed_gates(const std::vector<CaseResult>& results);

}  // namespace crosswalk::fe::validate
