// summary.json (docs/summary_schema.md).
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "recorder/scoring/score_json.h"
#include "recorder/summary.h"

namespace crosswalk::recording {

namespace {

using nlohmann::ordered_json;

ordered_json optional(const std::optional<double>& value, double factor = 1) {
  return value ? ordered_json(*value * factor) : ordered_json(nullptr);
}

ordered_json run_block(const Summary& s) {
  return {{"id", s.manifest.run_id},
          {"scenario", s.manifest.scenario},
          {"scenario_digest",
           fmt::format("{:016x}", static_cast<std::uint64_t>(s.manifest.scenario_digest))},
          {"mode", s.manifest.mode()},
          {"scheme", s.manifest.has_fe ? ordered_json(s.manifest.scheme_name())
                                       : ordered_json(nullptr)},
          {"windows", s.windows},
          {"window_us", 1e-3 * static_cast<double>(s.manifest.window_ns)},
          {"simulated_ms", 1e3 * s.simulated},
          {"time_zero_ms", 1e3 * s.t0},
          {"has_first_contact", s.has_first_contact},
          {"initial_buck_speed_mps", optional(s.initial_buck_speed)}};
}

ordered_json head_contact_block(const Summary& s) {
  if (!s.head_contact) return nullptr;
  const HeadContact& c = *s.head_contact;
  ordered_json out = {{"time_ms", 1e3 * c.time},
                      {"partner", c.partner},
                      {"relative_speed_mps", c.relative_speed},
                      {"buck_speed_mps", c.buck_speed}};
  out["speed_ratio"] =
      c.buck_speed > 0 ? ordered_json(c.relative_speed / c.buck_speed) : ordered_json(nullptr);
  out["wrap_around_distance_mm"] = optional(c.wrap_around_distance, 1e3);
  out["peak_force_N"] = c.peak_force;
  return out;
}

ordered_json window(const WindowMaximum& w) {
  return {{"value", w.value}, {"t1", optional(w.t1)}, {"t2", optional(w.t2)}};
}

ordered_json road_block(const Summary& s) {
  if (!s.after.head_on_road) return nullptr;
  const RoadImpact& r = *s.after.head_on_road;
  return {{"time_ms", 1e3 * r.time},
          {"peak_force_N", r.peak_force},
          {"peak_g", r.peak_g},
          {"HIC15", window(r.HIC15)},
          {"peak_g_before", r.peak_g_before},
          {"HIC15_before", window(r.HIC15_before)}};
}

ordered_json throw_block(const Summary& s) {
  if (!s.after.thrown) return nullptr;
  const Throw& t = *s.after.thrown;
  return {{"distance_m", t.distance},     {"sideways_m", t.sideways},
          {"highest_m", t.highest},       {"end_time_ms", 1e3 * t.end_time},
          {"end_speed_mps", t.end_speed}, {"rest_time_ms", optional(t.rest_time, 1e3)}};
}

ordered_json quality_block(const Summary& s) {
  ordered_json out = ordered_json::object();
  if (s.mb) out["mb_balance_percent"] = s.mb->balance_percent;
  if (s.fe) {
    out["fe_peak_energy_J"] = s.fe->peak_energy;
    out["fe_balance_percent"] = s.fe->balance_percent;
    out["hourglass_percent"] = s.fe->hourglass_percent;
    out["added_mass_kg"] = s.fe->added_mass;
    out["added_mass_percent"] = optional(s.fe->added_mass_percent);
  }
  if (s.coupling) {
    out["interface_drift_J"] = s.coupling->drift;
    out["interface_exchanged_J"] = s.coupling->exchanged;
    out["interface_drift_percent"] = s.coupling->drift_percent;
    out["total_balance_percent"] = s.coupling->balance_percent;
    out["largest_gap_mm"] = s.coupling->gap_mm;
    out["largest_owed_force_N"] = s.coupling->owed_force;
    out["largest_owed_moment_Nm"] = s.coupling->owed_moment;
    out["resends"] = s.coupling->resends;
    out["iterations_per_window"] = s.coupling->iterations;
  }
  return out;
}

ordered_json energy_block(const Summary& s) {
  if (!s.mb) return nullptr;
  ordered_json out = {{"held_at_the_start_J", s.mb->start}};
  for (const auto& [name, energy] : energy_rows(s.mb->end)) out[name + "_J"] = energy;
  return out;
}

ordered_json tissue_block(const Summary& s) {
  ordered_json out = ordered_json::object();
  for (const RegionPeak& p : s.tissue) {
    out[p.region] = {{"MPS_max", p.mps_max},
                     {"MPS95", p.mps_95_so_far},
                     {"MPS95_state_max", p.mps_95},
                     {"MPS95_state_time_ms", 1e3 * p.mps_95_time},
                     {"CSDM_0.15", p.csdm_15},
                     {"CSDM_0.25", p.csdm_25},
                     {"von_mises_95_Pa", p.von_mises_95},
                     {"pressure_max_Pa", p.pressure_max},
                     {"pressure_min_Pa", p.pressure_min},
                     {"inside_out_percent", 100 * p.inside_out}};
  }
  return out;
}

ordered_json band_block(const Summary& s) {
  ordered_json out = ordered_json::array();
  for (const BandVerdict& v : s.bands) {
    ordered_json entry = {
        {"quantity", v.band.quantity}, {"low", v.band.low}, {"high", v.band.high}};
    entry["value"] = optional(v.value);
    entry["inside"] = v.value ? ordered_json(v.is_inside) : ordered_json(nullptr);
    entry["status"] = v.band.status;
    entry["source"] = v.band.source;
    out.push_back(entry);
  }
  return out;
}

}  // namespace

ordered_json to_json(const Summary& s) {
  ordered_json out;
  out["schema"] = 1;
  out["run"] = run_block(s);
  out["record"] = {{"complete", s.is_complete},
                   {"outcome", s.outcome},
                   {"messages", s.messages},
                   {"doubled", s.doubled},
                   {"lost", s.lost}};
  out["head_contact"] = head_contact_block(s);
  out["head_on_road"] = road_block(s);
  out["throw"] = throw_block(s);
  out["injury"] = to_json(s.card);
  out["injury"]["filter"] = "CFC 1000 linear, CFC 60 angular (ISO 6487), per component";
  out["tissue"] = tissue_block(s);
  out["multibody_energy"] = energy_block(s);
  out["quality"] = quality_block(s);
  out["bands"] = band_block(s);
  out["ratings"] = to_json(s.ratings);
  ordered_json published = ordered_json::array();
  for (const PublishedScore& p : s.published) {
    published.push_back({{"signal", p.signal}, {"model", p.model}, {"C", p.score}});
  }
  out["published_scores"] = {{"source", s.published_source}, {"scores", published}};
  out["warnings"] = s.warnings;
  out["statements"] = s.statements;
  out["timing"] = {{"wall_s", s.timing.wall},
                   {"mb_s", s.timing.mb},
                   {"fe_s", s.timing.fe},
                   {"windows_s", s.timing.windows},
                   {"exchange_s", s.timing.exchange}};
  return out;
}

}  // namespace crosswalk::recording
