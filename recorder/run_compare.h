// Several runs side by side, as the seed paper compares its models: scores by signal [yu2020, Table
// 3 and Figure 7], HIC15 by test and model [yu2020, Figure 8], curves overlaid.
#pragma once

#include <string>
#include <vector>

#include "recorder/analysis.h"
#include "recorder/report/report.h"
#include "recorder/run_rating.h"

namespace crosswalk::recording {

struct ComparedRun {
  std::string name;  ///< of the run folder
  Analysis analysis;
  Scene scene;  ///< drawn for the first run only
};

/// What is rated and how; by default the five head signals, equal weights, CORA's own parameters.
struct ComparisonSettings {
  std::vector<RatedSignal> set = rating_set({});
  RatingParameters parameters;
};

/// At least two runs. Runs of one scenario are also rated against the first of them.
ReportInput comparison_input(const std::vector<ComparedRun>& runs,
                             const ComparisonSettings& settings = {});

/// The tables of the comparison for the terminal.
std::string comparison_text(const std::vector<ComparedRun>& runs,
                            const ComparisonSettings& settings = {});

}  // namespace crosswalk::recording
