// The verdict table of a run: what happened to the head, how badly it is hurt, how well the run
// agrees with the test, and whether the computation can be trusted.
#pragma once

#include <vector>

#include "recorder/report/report.h"
#include "recorder/summary.h"

namespace crosswalk::recording {

std::vector<VerdictRow> verdict_of(const Summary& summary);

/// What zero of the run's times means, in words.
std::string time_zero_of(const Summary& summary);

/// Probability of a level ("AIS3+") in one family ("hic_lognormal"); nothing when it is not there.
std::optional<double> risk_of(const Summary& summary, const std::string& family,
                              const std::string& level);

}  // namespace crosswalk::recording
