// Scenarios of scenarios/tests as configurations for tests, with overrides; a sink that keeps
// records.
#pragma once

#include <string>

#include "common/exchange.h"
#include "mb_node/mb_config.h"
#include "tests/source_folder.h"

namespace crosswalk::mb {

/// `more` is TOML laid over the scenario, for example "[vehicle]\nspeed_km_h = 0.0\n".
inline MbConfig load_config(const std::string& test, RunMode mode, const std::string& more = {}) {
  ConfigDocument document = ConfigDocument::from_text(
      "base = \"" + test + ".toml\"\n" + more, "test.toml", source_folder() / "scenarios/tests");
  Scenario scenario = read_scenario(document);
  scenario.mode = mode;
  if (mode == RunMode::Multibody) scenario.interfaces.clear();
  ignore_tables_of_others(document, "mb_node");
  MbConfig config = read_mb_config(document, scenario);
  document.finish();
  return config;
}

struct KeptRecords final : RecordSink {
  std::vector<HeadSample> heads;
  std::vector<std::int64_t> body_times, force_times;
  std::vector<std::vector<Pose>> poses;
  std::vector<std::vector<Vec3>> forces;
  std::vector<std::string> events;
  void head(const HeadSample& sample) override { heads.push_back(sample); }
  void body_states(std::int64_t t_ns, const std::vector<Pose>& X_WB) override {
    body_times.push_back(t_ns);
    poses.push_back(X_WB);
  }
  void contact_forces(std::int64_t t_ns, const std::vector<Vec3>& f) override {
    force_times.push_back(t_ns);
    forces.push_back(f);
  }
  void tissue(const TissueSample&) override {}
  void event(std::int64_t, EventLevel, const std::string& text) override { events.push_back(text); }
};

inline MbGrant grant(std::int64_t window, std::int64_t window_ns = 20'000) {
  MbGrant g;
  g.id.window = window;
  g.id.window_ns = window_ns;
  return g;
}

}  // namespace crosswalk::mb
