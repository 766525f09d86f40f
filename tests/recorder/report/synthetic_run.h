// A made-up impact for tests of drawing and writing: a jointed figure of ellipsoids that tips over
// a car front along simple curves. No physics; nothing here is a result.
#pragma once

#include "recorder/report/report.h"

namespace crosswalk::recording::synthetic {

constexpr double kHeadContact = 0.118;  // s

Scene scene();
/// Head channels of the paper's Figure 6 and a few more, 5 kHz over 0 .. 200 ms; `lateness` (s)
/// shifts the impact so that overlays differ.
CurveSet curves(const std::string& label, CurveOrigin origin, double lateness);
/// A full report: verdict, warnings, curves of run, second run and reference, scene, tissue.
ReportInput report_input();

}  // namespace crosswalk::recording::synthetic
