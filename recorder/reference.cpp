#include "recorder/reference.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>

#include <fmt/format.h>

#include "common/config.h"
#include "common/units.h"
#include "recorder/csv_table.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

namespace {

struct UnitFactor {
  const char* unit;
  const char* channel_unit;
  double factor;
};

constexpr std::array kUnitFactors = {UnitFactor{"mm", "mm", 1},
                                     UnitFactor{"cm", "mm", 10},
                                     UnitFactor{"m", "mm", 1000},
                                     UnitFactor{"m/s", "mps", 1},
                                     UnitFactor{"mps", "mps", 1},
                                     UnitFactor{"km/h", "mps", 1 / 3.6},
                                     UnitFactor{"m/s2", "mps2", 1},
                                     UnitFactor{"mps2", "mps2", 1},
                                     UnitFactor{"g", "mps2", kStandardGravity},
                                     UnitFactor{"rad/s", "radps", 1},
                                     UnitFactor{"deg/s", "radps", kDegree},
                                     UnitFactor{"rad/s2", "radps2", 1},
                                     UnitFactor{"N", "N", 1},
                                     UnitFactor{"kN", "N", 1000},
                                     UnitFactor{"1", "1", 1}};

[[noreturn]] void wrong_comment(const fs::path& path, const std::string& key,
                                const std::string& expected, const std::string& found) {
  Problem problem;
  problem.place.file = path.string();
  problem.what = "# " + key;
  problem.expected = expected;
  problem.found = found.empty() ? "none" : found;
  throw UserError(problem);
}

std::string comment_or(const CsvTable& table, const std::string& key, const std::string& fallback) {
  const auto found = table.comments.find(key);
  return found == table.comments.end() ? fallback : found->second;
}

std::vector<Band> read_bands(const fs::path& path) {
  ConfigDocument document(path);
  std::vector<Band> bands;
  for (ConfigTable& t :
       document.root().tables("band", "A quantity of the summary and where it should lie.")) {
    Band band;
    band.quantity = t.text("quantity", "Key of summary.json, with its unit.");
    band.low = t.quantity("low", Dimension::None, {}, "Lower end.");
    band.high = t.quantity("high", Dimension::None, {}, "Upper end.");
    band.status =
        t.choice_or("status", {"published", "estimated"}, "estimated", "How firm the band is.");
    band.source = t.text("source", "Where the band comes from.");
    bands.push_back(std::move(band));
  }
  document.finish();
  return bands;
}

void read_scores(const fs::path& path, ReferenceData& data) {
  ConfigDocument document(path);
  ConfigTable root = document.root();
  data.scores_source = root.text("source", "Publication of the scores.");
  for (ConfigTable& t : root.tables("score", "Total score of a published model.")) {
    PublishedScore score;
    score.signal = t.text("signal", "Channel rated.");
    score.model = t.text("model", "Name of the model.");
    score.score = t.quantity("score", Dimension::None, {0, 1}, "Total CORA score.");
    data.scores.push_back(std::move(score));
  }
  document.finish();
}

std::vector<ReferenceFact> read_facts(const fs::path& path) {
  ConfigDocument document(path);
  std::vector<ReferenceFact> facts;
  for (ConfigTable& t : document.root().tables("fact", "Something published about the test.")) {
    facts.push_back(
        {t.text("name", "What."), t.text("value", "How much."), t.text("source", "Where.")});
  }
  document.finish();
  return facts;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

fs::path scenarios_folder() {
  if (const char* named = std::getenv("CROSSWALK_SCENARIOS"); named != nullptr) return named;
  std::error_code error;
  for (fs::path at = fs::read_symlink("/proc/self/exe", error).parent_path();
       at.has_relative_path(); at = at.parent_path()) {
    if (fs::is_directory(at / "scenarios" / "reference")) return at / "scenarios";
  }
  return {};
}

ReferenceCurve read_reference_curve(const fs::path& path) {
  const CsvTable table = read_csv(path);
  ReferenceCurve curve;
  curve.channel = path.stem().string();
  curve.series = {time_column(table), value_column(table)};
  require_valid(curve.series, path.string());
  if (table.has("sigma")) curve.sigma = table.column("sigma");
  curve.source = comment_or(table, "source", "digitised by the user");
  const std::string unit = comment_or(table, "unit", "");
  const auto factor = std::find_if(kUnitFactors.begin(), kUnitFactors.end(),
                                   [&](const UnitFactor& f) { return unit == f.unit; });
  if (factor == kUnitFactors.end()) {
    wrong_comment(path, "unit", "mm, cm, m, m/s, km/h, m/s2, g, rad/s, deg/s, rad/s2, N, kN or 1",
                  unit);
  }
  curve.unit = factor->channel_unit;
  const std::string sign = comment_or(table, "sign", "1");
  if (sign != "1" && sign != "+1" && sign != "-1") wrong_comment(path, "sign", "1 or -1", sign);
  const double scale = factor->factor * (sign == "-1" ? -1 : 1);
  for (double& y : curve.series.y) y *= scale;
  for (double& s : curve.sigma) s *= std::abs(scale);
  const std::string relative = comment_or(table, "relative_to", "ground");
  if (relative != "ground" && relative != "buck") {
    wrong_comment(path, "relative_to", "ground or buck", relative);
  }
  if (relative == "buck" && curve.channel.starts_with("head_cog_") &&
      !curve.channel.starts_with("head_cog_relative_")) {
    curve.channel.insert(std::string("head_cog_").size(), "relative_");
  }
  return curve;
}

ReferenceData read_reference(const fs::path& folder) {
  ReferenceData data;
  data.test = folder.filename().string();
  data.folder = folder;
  if (fs::exists(folder / "bands.toml")) data.bands = read_bands(folder / "bands.toml");
  if (fs::exists(folder / "scores.toml")) read_scores(folder / "scores.toml", data);
  if (fs::exists(folder / "facts.toml")) data.facts = read_facts(folder / "facts.toml");
  std::vector<fs::path> files;
  if (fs::is_directory(folder / "curves")) {
    for (const auto& entry : fs::directory_iterator(folder / "curves")) {
      if (entry.path().extension() == ".csv") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    try {
      data.curves.push_back(read_reference_curve(file));
    } catch (const SignalError& error) {
      data.faults.emplace_back(error.what());
    } catch (const UserError& error) {
      data.faults.emplace_back(error.what());
    }
  }
  return data;
}

std::optional<ReferenceData> reference_data(const std::string& scenario_name) {
  const fs::path scenarios = scenarios_folder();
  if (scenarios.empty() || scenario_name.empty()) return std::nullopt;
  const fs::path folder = scenarios / "reference" / lower(scenario_name);
  if (!fs::is_directory(folder)) return std::nullopt;
  return read_reference(folder);
}

std::vector<RatedSignal> rating_set(const fs::path& file) {
  if (file.empty()) {
    return {{"head_cog_x", "displacement X", 1},
            {"head_cog_y", "displacement Y", 1},
            {"head_cog_z", "displacement Z", 1},
            {"head_speed_relative", "speed relative to buck", 1},
            {"head_acceleration_resultant", "acceleration", 1}};
  }
  ConfigDocument document(file);
  std::vector<RatedSignal> set;
  for (ConfigTable& t : document.root().tables("signal", "One rated channel.")) {
    RatedSignal signal;
    signal.channel = t.text("channel", "Name of the channel without its unit.");
    signal.label = t.text_or("label", signal.channel, "How it is printed.");
    signal.weight =
        t.quantity_or("weight", Dimension::None, kNonNegative, 1.0, "Share in the mean.");
    set.push_back(std::move(signal));
  }
  document.finish();
  return set;
}

}  // namespace crosswalk::recording
