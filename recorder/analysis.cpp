#include "recorder/analysis.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "recorder/export_csv.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

namespace {

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) {
    Problem problem;
    problem.place.file = path.string();
    problem.what = "result file";
    problem.expected = "a file that can be written";
    throw UserError(problem);
  }
}

}  // namespace

Analysis analyze_log(const fs::path& log) { return analyze_record(read_run_record(log)); }

Analysis analyze_record(const RunRecord& record) {
  Analysis out;
  out.channels = extract(record);
  const std::string name = record.manifest ? record.manifest->scenario : "";
  out.summary = summarize(record, out.channels, reference_data(name));
  return out;
}

void write_results(const Analysis& a, const RunDirectory& directory) {
  fs::create_directories(directory.root());
  write_channels_csv(
      directory.channels(), a.channels.channels,
      {{"scenario", a.summary.manifest.scenario},
       {"mode", a.summary.manifest.mode()},
       {"time_zero", a.channels.has_first_contact
                         ? "first force between car and pedestrian above 10 N"
                         : "start of the simulation"},
       {"frame",
        "W: x subject's front, y buck travel (impact direction), z up; head axes SAE J211"}});
  write_text(directory.summary_text(), to_text(a.summary));
  write_text(directory.summary(), to_json(a.summary).dump(1) + "\n");
}

}  // namespace crosswalk::recording
