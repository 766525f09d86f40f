// From a judged run to the input of its report.
#pragma once

#include <filesystem>

#include "common/run_directory.h"
#include "recorder/analysis.h"
#include "recorder/report/report.h"

namespace crosswalk::recording {

/// The run's curves under a label.
CurveSet curve_set(const RunChannels& channels, const std::string& label, CurveOrigin origin);

/// "coupled" or "multibody".
std::string mode_of(const Summary& summary);

ReportInput report_input(const Analysis& analysis, const RunRecord& record,
                         const RunDirectory& directory);

/// Adds the measured curves of a test, when somebody has put them there.
void add_reference_curves(ReportInput& input, const std::string& scenario);

/// Adds another run's curves to the charts.
void overlay(ReportInput& input, const Analysis& other, const std::string& label);

}  // namespace crosswalk::recording
