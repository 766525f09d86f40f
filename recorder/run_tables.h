// The tables of a run's report below the verdict: ratings with all their parts, injury metrics with
// their windows, risks, published scores.
#pragma once

#include <string>
#include <vector>

#include "recorder/report/report.h"
#include "recorder/summary.h"

namespace crosswalk::recording {

std::vector<ReportTable> run_tables(const Summary& summary);

/// All parameters of a rating in one line, under CORA's names.
std::string parameter_text(const CoraParameters& parameters);

}  // namespace crosswalk::recording
