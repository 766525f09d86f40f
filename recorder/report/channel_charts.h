// Which channels make which chart: the panels of the seed paper's Figure 6 first, then rotation,
// forces, energies and coupling; whatever channel is left gets a chart of its own at the end.
#pragma once

#include <string>
#include <vector>

#include "recorder/report/chart.h"

namespace crosswalk::recording {

struct ChartGroup {
  std::string title;
  bool is_folded = false;  ///< closed until asked for
  std::vector<Chart> charts;
};

/// Charts of the given sets; a chart appears when at least one set has one of its channels. The
/// first set decides about the order of channels without a place. `time_zero` says what zero on the
/// time axes means.
std::vector<ChartGroup> channel_charts(const std::vector<CurveSet>& sets,
                                       const std::vector<TimeMark>& marks,
                                       const std::string& time_zero);

}  // namespace crosswalk::recording
