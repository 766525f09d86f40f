// CORA and ISO/TS 18571 against the reference vectors.
#include <gtest/gtest.h>

#include "recorder/csv_table.h"
#include "recorder/scoring/score_json.h"
#include "tests/recorder/vectors.h"

namespace crosswalk::recording {
namespace {

struct Pair {
  Series reference, simulation;
  std::vector<double> sigma;
};

Pair read_pair(const nlohmann::json& files, const std::filesystem::path& folder) {
  if (files.contains("pair")) {
    const CsvTable table = read_csv(folder / files["pair"].get<std::string>());
    Pair pair{
        {table.column("t"), table.column("ref")}, {table.column("t"), table.column("sim")}, {}};
    if (table.has("sigma")) pair.sigma = table.column("sigma");
    return pair;
  }
  return {read_series(folder / files["ref"].get<std::string>()),
          read_series(folder / files["sim"].get<std::string>()),
          {}};
}

/// The error code a call ends in, or an empty string.
template <typename Call>
std::string fault_of(const Call& call) {
  try {
    call();
  } catch (const SignalError& error) {
    return std::string(error.code());
  }
  return {};
}

void expect_same(const nlohmann::json& wanted, const nlohmann::json& found, double tolerance,
                 double time_tolerance, const std::string& where) {
  for (const auto& [key, value] : wanted.items()) {
    ASSERT_TRUE(found.contains(key)) << where << ": " << key;
    const bool is_time = key == "delta" || key == "dt" || key == "t_min" || key == "t_max";
    if (value.is_number_integer()) {
      EXPECT_EQ(found[key].get<long>(), value.get<long>()) << where << ": " << key;
    } else if (value.is_number()) {
      const double scale = is_time ? 1.0 : std::max(1.0, std::abs(value.get<double>()));
      EXPECT_NEAR(found[key].get<double>(), value.get<double>(),
                  (is_time ? time_tolerance : tolerance) * scale)
          << where << ": " << key;
    } else {
      EXPECT_EQ(found[key], value) << where << ": " << key;
    }
  }
}

TEST(CoraVectors, EveryEvaluationMatches) {
  const nlohmann::json vectors = expected("cora");
  const double tolerance = vectors["tolerance"]["score"];
  const double time_tolerance = vectors["tolerance"]["delta_s"];
  for (const auto& item : vectors["cases"]) {
    const Pair pair = read_pair(item["files"], vector_folder("cora"));
    for (const auto& evaluation : item["evaluations"]) {
      const std::string where =
          item["name"].get<std::string>() + "/" + evaluation["label"].get<std::string>();
      CoraResult result;
      const std::string fault = fault_of([&] {
        result = cora(pair.reference, pair.simulation, cora_parameters(evaluation["parameters"]),
                      pair.sigma);
      });
      EXPECT_EQ(fault, evaluation.value("error", "")) << where;
      if (!evaluation.contains("expected") || !fault.empty()) continue;
      expect_same(evaluation["expected"], to_json(result), tolerance, time_tolerance, where);
    }
  }
}

TEST(CoraVectors, DefaultsAreThePublishedBlock) {
  const nlohmann::json defaults = expected("cora")["defaults"];
  const nlohmann::json ours = to_json(CoraParameters{});
  for (const auto& [key, value] : defaults.items()) EXPECT_EQ(ours.at(key), value) << key;
}

TEST(Iso18571Vectors, EveryCaseMatches) {
  const nlohmann::json vectors = expected("iso18571");
  const double tolerance = vectors["tolerance"]["score"];
  for (const auto& item : vectors["cases"]) {
    const std::string name = item["name"];
    const Pair pair = read_pair({{"pair", item["file"]}}, vector_folder("iso18571"));
    const nlohmann::json overrides =
        item.contains("parameters") ? item["parameters"] : nlohmann::json::object();
    Iso18571Result result;
    const std::string fault = fault_of([&] {
      result = iso18571(pair.reference, pair.simulation, iso18571_parameters(overrides));
    });
    EXPECT_EQ(fault, item.value("error", "")) << name;
    if (!item.contains("expected") || !fault.empty()) continue;
    expect_same(item["expected"], to_json(result), tolerance, tolerance, name);
  }
}

TEST(Iso18571Vectors, DefaultsAreThePublishedBlock) {
  const nlohmann::json defaults = expected("iso18571")["defaults"];
  const nlohmann::json ours = to_json(Iso18571Parameters{});
  for (const auto& [key, value] : defaults.items()) EXPECT_EQ(ours.at(key), value) << key;
}

/// ISO publishes the signals; the scores are printed in Annex C of the 2024 edition.
TEST(Iso18571Annex, PublishedScoresWithinAThousandth) {
  const char* folder = std::getenv("CROSSWALK_ISO18571_ANNEX");
  if (folder == nullptr) GTEST_SKIP() << "CROSSWALK_ISO18571_ANNEX names no folder";
  std::ifstream in(vector_folder("iso18571") / "annex_scores.json");
  const nlohmann::json annex = nlohmann::json::parse(in);
  int compared = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string key = entry.path().stem().string();
    if (!annex["scores"].contains(key)) continue;
    std::ifstream file(entry.path());
    std::string text, line;
    for (int row = 0; std::getline(file, line); ++row) {
      if (row != 1) text += line + "\n";  // the second line holds units
    }
    const CsvTable table = parse_csv(text, key);
    const Series test{table.column("Time"), table.column("Test")};
    const Series simulation{table.column("Time"), table.column("CAE")};
    expect_same(annex["scores"][key], to_json(iso18571(test, simulation, {})), annex["tolerance"],
                annex["tolerance"], key);
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace crosswalk::recording
