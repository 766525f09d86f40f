#include "recorder/run_report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/log.h"
#include "recorder/description.h"
#include "recorder/field_frame.h"
#include "recorder/run_scene.h"
#include "recorder/run_tables.h"
#include "recorder/run_verdict.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

constexpr double kFrameReach = 1.5e-3;  // s; frames and strain samples come about every 1 ms

std::string text_member(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

json object_member(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_object() ? *found : json::object();
}

std::string subtitle_of(const Summary& s, const json& mb) {
  const json subject = object_member(mb, "subject");
  std::string out = s.manifest.has_head_alone()
                        ? "Finite-element head alone, moved or thrown as in another run"
                    : s.manifest.has_fe ? "Multibody pedestrian with finite-element head and neck"
                                        : "Multibody pedestrian";
  if (subject.contains("standing_height_m") && subject["standing_height_m"].is_number()) {
    out += fmt::format(" · {:.0f} mm, {:.1f} kg", 1e3 * subject["standing_height_m"].get<double>(),
                       subject.value("mass_kg", 0.0));
  }
  const std::string car = text_member(object_member(mb, "vehicle"), "name");
  if (!car.empty()) out += " · car front: " + car;
  return out;
}

std::string story_of(const Summary& s) {
  const std::string speed =
      s.initial_buck_speed ? fmt::format(" at {:.0f} km/h", 3.6 * *s.initial_buck_speed) : "";
  std::string story =
      fmt::format("A car front{} strikes a standing pedestrian from the side. ", speed);
  if (s.head_contact) {
    story += fmt::format("After {:.0f} ms the head hits the car ({}) at {:.1f} m/s",
                         1e3 * s.head_contact->time, s.head_contact->partner,
                         s.head_contact->relative_speed);
    if (s.card.linear) {
      story += fmt::format("; the resulting HIC15 is {:.0f}", s.card.linear->HIC15.value);
      if (const auto risk = risk_of(s, "hic_lognormal", "AIS3+")) {
        story += fmt::format(", which means a {:.0f} % risk of serious head injury", 100 * *risk);
      }
    }
    story += ".";
  } else {
    story += fmt::format("Within the {:.0f} ms computed the head does not touch the car.",
                         1e3 * s.simulated);
  }
  return story;
}

/// A key as words: `head_contact_time_ms` becomes `head contact time ms`.
std::string spaced(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

/// Ids of the parts that are regions of the brain.
std::set<int> brain_parts(const RunRecord& record) {
  const std::vector<std::string> regions = run_names(record).regions;
  std::set<int> ids;
  const json fe = description_of(record, Role::Fe);
  for (const json& part : fe.value("parts", json::array())) {
    if (!part.is_object() || !part.contains("id") || !part["id"].is_number_integer()) continue;
    if (std::find(regions.begin(), regions.end(), text_member(part, "name")) != regions.end())
      ids.insert(part["id"].get<int>());
  }
  return ids;
}

/// Strain of the brain's elements at `t_ns`, when a field frame of that time stands beside the log.
std::optional<StrainMap> strain_map(const RunRecord& record, const fs::path& fields,
                                    std::int64_t t_ns) {
  const auto frame = nearest_frame(fields, 1e-9 * static_cast<double>(t_ns), kFrameReach);
  if (!frame) return std::nullopt;
  const auto head = record.head.lower_bound(std::llround(1e9 * frame->t));
  if (head == record.head.end()) return std::nullopt;
  try {
    StrainMap map = read_strain_map(frame->file, brain_parts(record), head->second.X_WH);
    if (!map.centroids.empty()) return map;
  } catch (const UserError& error) {
    log_warning("no map of the brain strain: {}", error.what());
  }
  return std::nullopt;
}

std::optional<TissuePeak> tissue_of(const RunRecord& record, double t0, const fs::path& fields) {
  const std::vector<std::string> names = run_names(record).regions;
  const TissueSample* peak = nullptr;
  for (const auto& [t_ns, sample] : record.tissue) {
    if (sample.regions.empty()) continue;
    if (peak == nullptr || sample.regions[0].mps_95 > peak->regions[0].mps_95) peak = &sample;
  }
  if (peak == nullptr) return std::nullopt;
  TissuePeak out;
  out.t = 1e-9 * static_cast<double>(peak->t_ns) - t0;
  for (std::size_t i = 0; i < peak->regions.size(); ++i) {
    const TissueSample::Region& r = peak->regions[i];
    out.regions.push_back({i < names.size() ? spaced(names[i]) : fmt::format("region {}", i),
                           r.mps_max, r.mps_95, r.csdm_15, r.csdm_25, r.pressure_min,
                           r.pressure_max, r.von_mises_95});
  }
  out.map = strain_map(record, fields, peak->t_ns);
  return out;
}

void add_flat(std::vector<std::pair<std::string, std::string>>& out, const std::string& key,
              const json& value) {
  if (value.is_object()) {
    for (const auto& [inner, v] : value.items()) add_flat(out, key + " " + inner, v);
  } else if (value.is_array()) {
    std::string joined;
    for (const json& v : value)
      joined += (joined.empty() ? "" : " ") + (v.is_string() ? v.get<std::string>() : v.dump());
    out.emplace_back(key, joined);
  } else {
    out.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
  }
}

std::vector<std::pair<std::string, std::string>> provenance_of(const Summary& s,
                                                               const RunDirectory& directory) {
  std::vector<std::pair<std::string, std::string>> out;
  out.emplace_back("scenario", s.manifest.scenario);
  out.emplace_back("mode", mode_of(s));
  out.emplace_back("windows", fmt::format("{} of {:g} µs", s.windows,
                                          1e-3 * static_cast<double>(s.manifest.window_ns)));
  out.emplace_back("outcome", s.outcome);
  out.emplace_back("messages",
                   fmt::format("{} ({} doubled, {} lost)", s.messages, s.doubled, s.lost));
  std::ifstream file(directory.provenance());
  const json provenance = json::parse(file, nullptr, false);
  if (!provenance.is_object()) return out;
  for (const auto& [key, value] : provenance.items()) {
    add_flat(out, spaced(key), value);
  }
  return out;
}

/// Car components whose curves are not published, and bands that are estimates.
std::vector<Estimate> estimates_of(const Summary& s, const json& mb) {
  std::vector<Estimate> out;
  std::string components;
  const json vehicle = object_member(mb, "vehicle");
  for (const json& c : vehicle.value("components", json::array())) {
    if (!c.is_object() || text_member(c, "provenance") == "published") continue;
    components += (components.empty() ? "" : ", ") + spaced(text_member(c, "name"));
    if (text_member(c, "provenance") == "measured") components += " (measured)";
  }
  if (!components.empty()) {
    out.push_back({"Car front: force against penetration", components,
                   "engineering estimate; see the vehicle's file in the scenarios folder"});
  }
  for (const BandVerdict& v : s.bands) {
    if (v.band.status == "published") continue;
    out.push_back({"Band: " + spaced(v.band.quantity),
                   fmt::format("{:g} – {:g}", v.band.low, v.band.high),
                   v.band.source.empty() ? v.band.status : v.band.status + "; " + v.band.source});
  }
  for (const std::string& statement : s.statements) out.push_back({"General", "", statement});
  return out;
}

Signal signal_of(const Channel& channel) {
  Signal signal{channel.name, channel.unit, channel.description, {}, channel.samples};
  signal.t.reserve(channel.samples.size());
  for (std::size_t i = 0; i < channel.samples.size(); ++i) signal.t.push_back(channel.time(i));
  return signal;
}

}  // namespace

std::string mode_of(const Summary& summary) { return summary.manifest.mode(); }

CurveSet curve_set(const RunChannels& channels, const std::string& label, CurveOrigin origin) {
  CurveSet set{label, origin, {}};
  for (const Channel& channel : channels.channels) set.signals.push_back(signal_of(channel));
  return set;
}

ReportInput report_input(const Analysis& analysis, const RunRecord& record,
                         const RunDirectory& directory) {
  const Summary& s = analysis.summary;
  const json mb = description_of(record, Role::Mb);
  ReportInput input;
  input.title =
      fmt::format("{}, {}", s.manifest.scenario.empty() ? "Run" : s.manifest.scenario, mode_of(s));
  input.subtitle = subtitle_of(s, mb);
  input.story = story_of(s);
  input.verdict = verdict_of(s);
  input.warnings = s.warnings;
  input.curves = {curve_set(analysis.channels, mode_of(s), CurveOrigin::ThisRun)};
  input.time_zero = time_zero_of(s);
  if (s.head_contact) input.marks.push_back({s.head_contact->time, "head contact"});
  input.tables = run_tables(s);
  input.tissue = tissue_of(record, s.t0, directory.fields());
  input.scene = scene_of(record, s.t0);
  input.provenance = provenance_of(s, directory);
  input.estimates = estimates_of(s, mb);
  add_reference_curves(input, s.manifest.scenario);
  return input;
}

void add_reference_curves(ReportInput& input, const std::string& scenario) {
  const auto reference = reference_data(scenario);
  if (!reference || reference->curves.empty()) return;
  CurveSet set{"test " + scenario, CurveOrigin::Reference, {}};
  for (const ReferenceCurve& curve : reference->curves) {
    set.signals.push_back(
        {curve.channel, curve.unit, curve.source, curve.series.t, curve.series.y});
  }
  input.curves.push_back(std::move(set));
}

void overlay(ReportInput& input, const Analysis& other, const std::string& label) {
  const auto reference =
      std::find_if(input.curves.begin(), input.curves.end(),
                   [](const CurveSet& set) { return set.origin == CurveOrigin::Reference; });
  input.curves.insert(reference, curve_set(other.channels, label, CurveOrigin::OtherRun));
}

}  // namespace crosswalk::recording
