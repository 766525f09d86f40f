// The report of a run: one self-contained HTML page that opens offline. Verdict first, then charts,
// pictures, 3-D playback, brain strain, provenance and the estimates the result rests on.
//
// Needs nothing but ReportInput. Without the bundled page script (npm absent at build time) the
// page still shows every chart and picture as static drawings; with it they become interactive.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "recorder/report/scene.h"

namespace crosswalk::recording {

/// One curve over time. SI samples at strictly increasing times (s, zero at first contact).
struct Signal {
  std::string name;         ///< channel stem, e.g. `head_cog_y`
  std::string unit;         ///< unit of y, as in Channel
  std::string description;  ///< one line: what, which frame, which filter
  std::vector<double> t;
  std::vector<double> y;
};

enum class CurveOrigin { ThisRun, OtherRun, Reference };

/// All curves of one run or one test; charts overlay the sets signal by signal.
struct CurveSet {
  std::string label;  ///< in legends: "coupled", "multibody only", "test V2370 (digitised)"
  CurveOrigin origin = CurveOrigin::ThisRun;
  std::vector<Signal> signals;
};

enum class Verdict { Good, Attention, Bad, Info };

/// One line of the verdict table.
struct VerdictRow {
  std::string group;  ///< "Impact", "Head injury", "Agreement with the test", "Quality of the run"
  std::string label;
  std::string value;  ///< formatted
  std::string unit;
  std::string band;  ///< what it is held against, with its source: "105–135 ms (estimate)"
  Verdict status = Verdict::Info;
  std::string note = {};     ///< one sentence for a reader new to the field
  std::string reading = {};  ///< word beside the symbol; empty: by status
};

struct ReportTable {
  std::string title;
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Bars per group and run with optional band, such as HIC15 by model (paper's Figure 8).
struct BarChart {
  std::string title;
  std::string axis;  ///< quantity and unit: "score C [–]"
  std::vector<std::string> groups;
  std::vector<std::string> labels;          ///< one per bar inside a group
  std::vector<std::vector<double>> values;  ///< [group][bar]; NaN: not available
};

struct TissueRegion {
  std::string name;
  double mps_max = 0, mps_95 = 0, csdm_15 = 0, csdm_25 = 0;
  double pressure_min = 0, pressure_max = 0, von_mises_95 = 0;  ///< Pa
};
/// Strain of single brain elements, for the map: centroids in head axes from the head COG.
struct StrainMap {
  std::vector<Vec3> centroids;  ///< m
  std::vector<double> strain;
};
struct TissuePeak {
  double t = 0;  ///< s, when the whole-brain 95th percentile is largest
  std::vector<TissueRegion> regions;
  std::optional<StrainMap> map;
};

struct TimeMark {
  double t = 0;
  std::string label;  ///< "head contact"
};

/// A number the result rests on that no publication gives.
struct Estimate {
  std::string item, value, basis;
};

struct ReportInput {
  std::string title;     ///< "V2370, coupled"
  std::string subtitle;  ///< subject, car, speed
  std::string story;     ///< two or three plain sentences: what was computed, what came out
  std::vector<VerdictRow> verdict;
  std::vector<std::string> warnings;
  std::vector<CurveSet> curves;  ///< the run itself first
  std::vector<TimeMark> marks;
  std::string time_zero = "first leg contact";  ///< what zero on every time axis means
  std::vector<ReportTable> tables;
  std::vector<BarChart> bars;
  std::optional<TissuePeak> tissue;
  Scene scene;
  std::vector<double> still_times;  ///< s; empty: leg contact to 200 ms every 40 ms
  std::vector<std::pair<std::string, std::string>> provenance;
  std::vector<Estimate> estimates;
};

/// The page as text.
std::string render_report(const ReportInput& input);
/// Throws UserError when the file cannot be written.
void write_report(const std::filesystem::path& file, const ReportInput& input);
/// True when the interactive page script was bundled at build time.
bool report_is_interactive();

}  // namespace crosswalk::recording
