#include "recorder/analysis.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "common/vehicle_front.h"
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

/// Wrap-around distance of the head's nearest profile point, when the run's scenario tells the car.
std::optional<double> wrap_around(const fs::path& scenario, const RunRecord& record,
                                  const RunChannels& run) {
  if (!run.head_contact || !fs::exists(scenario)) return std::nullopt;
  const RunNames names = run_names(record);
  const auto p_head = head_position_at(record, run.t0 + run.head_contact->time);
  const auto foremost = buck_origin_at(record, names, run.t0 + run.head_contact->time);
  if (!p_head || !foremost) return std::nullopt;
  try {
    ConfigDocument document(scenario);
    const VehicleFront front = read_vehicle_front(document.root().table("vehicle", ""));
    if (front.facets.empty()) return std::nullopt;
    return wrap_around_distance(front, {p_head->y() - foremost->y(), p_head->z() - foremost->z()});
  } catch (const UserError&) {
    return std::nullopt;  // another node's table; that node has judged it
  }
}

}  // namespace

Analysis analyze_log(const fs::path& log) {
  return analyze_record(read_run_record(log), log.parent_path() / "scenario.toml");
}

Analysis analyze_record(const RunRecord& record, const fs::path& scenario) {
  Analysis out;
  out.channels = extract(record);
  if (out.channels.head_contact) {
    out.channels.head_contact->wrap_around_distance = wrap_around(scenario, record, out.channels);
  }
  const std::string name = record.manifest ? record.manifest->scenario : "";
  out.summary = summarize(record, out.channels, reference_data(name));
  return out;
}

void write_results(const Analysis& a, const RunDirectory& directory) {
  fs::create_directories(directory.root());
  write_channels_csv(
      directory.channels(), a.channels.channels,
      {{"scenario", a.summary.manifest.scenario},
       {"mode", a.summary.manifest.has_fe ? "coupled" : "multibody"},
       {"time_zero", a.channels.has_first_contact
                         ? "first force between car and pedestrian above 10 N"
                         : "start of the simulation"},
       {"frame",
        "W: x subject's front, y buck travel (impact direction), z up; head axes SAE J211"}});
  write_text(directory.summary(), to_json(a.summary).dump(1) + "\n");
  write_text(directory.summary_text(), to_text(a.summary));
}

}  // namespace crosswalk::recording
