// Whole runs rated: against curves, against each other, weighted sets, and what the command prints.
#include "recorder/run_rating.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "recorder/commands/commands.h"
#include "tests/recorder/vectors.h"

namespace crosswalk::recording {
namespace {

namespace fs = std::filesystem;

Channel wave(const std::string& name, const std::string& unit, double scale) {
  Channel c{name, unit, "", 0, 1e-4, {}};
  for (int i = 0; i < 500; ++i) c.samples.push_back(scale * std::sin(0.02 * i));
  return c;
}

TEST(RunRating, MissingSamplesAtTheEdgesAreLeftOut) {
  Channel a = wave("head_cog_x", "mm", 1);
  a.samples.front() = a.samples.back() = std::nan("");
  const auto ratings =
      rate_against_run({{"head_cog_x", "X", 1}}, {a}, {wave("head_cog_x", "mm", 1)}, "other");
  ASSERT_TRUE(ratings[0].cora) << ratings[0].fault;
  EXPECT_NEAR(ratings[0].cora->C, 1, 1e-12);
  EXPECT_NEAR(ratings[0].iso->R, 1, 1e-12);
}

TEST(RunRating, WeightsAreNormalisedOverWhatIsRated) {
  const std::vector<Channel> run = {wave("a", "mm", 1), wave("b", "mm", 0.5), wave("d", "N", 1)};
  const std::vector<Channel> reference = {wave("a", "mm", 1), wave("b", "mm", 1),
                                          wave("d", "mm", 1)};
  const auto ratings = rate_against_run(
      {{"a", "a", 3}, {"b", "b", 1}, {"c", "c", 5}, {"d", "d", 7}}, run, reference, "other");
  ASSERT_EQ(ratings.size(), 4U);
  EXPECT_FALSE(ratings[2].fault.empty());                                  // missing
  EXPECT_THAT(ratings[3].fault, ::testing::HasSubstr("reference in mm"));  // other unit
  EXPECT_NEAR(*weighted_mean(ratings, RatingMethod::Cora),
              (3 * ratings[0].cora->C + ratings[1].cora->C) / 4, 1e-12);
  EXPECT_FALSE(weighted_mean({}, RatingMethod::Cora));
}

TEST(RunRating, CurvesRelativeToTheBuckCountAsDisplacements) {
  const Channel relative = wave("head_cog_relative_y", "mm", 1);
  const ReferenceCurve curve{"head_cog_relative_y", "mm", relative.series(), {}, "me"};
  const auto ratings = rate_against_curves(rating_set({}), {relative}, {curve});
  ASSERT_EQ(ratings.size(), 1U);
  EXPECT_EQ(ratings[0].signal.label, "displacement Y");
}

/// The published table's acceleration row: population deviation, 0.767 ± 0.044 [yu2020, Table 3].
TEST(RunRating, MeanAndPopulationDeviation) {
  const MeanDeviation m = mean_deviation({0.759, 0.825, 0.717});
  EXPECT_NEAR(m.mean, 0.767, 5e-4);
  EXPECT_NEAR(m.deviation, 0.044, 5e-4);
}

TEST(RunRating, SetsComeFromAFile) {
  const fs::path path = fs::temp_directory_path() / "cw_rating_set.toml";
  std::ofstream(path) << "[[signal]]\nchannel = \"head_cog_y\"\nweight = 2.0\n"
                      << "[[signal]]\nchannel = \"head_cog_z\"\nlabel = \"Z\"\n";
  const auto set = rating_set(path);
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0].weight, 2);
  EXPECT_EQ(set[1].label, "Z");
  std::ofstream(path) << "[[signal]]\nchanel = \"head_cog_y\"\n";
  EXPECT_THROW(rating_set(path), UserError);
  fs::remove(path);
}

struct Printed {
  ExitCode code;
  nlohmann::json json;
};

template <class Command>
Printed printed(const Command& command) {
  testing::internal::CaptureStdout();
  const ExitCode code = reported(OutputForm::Json, command);
  return {code, nlohmann::json::parse(testing::internal::GetCapturedStdout())};
}

TEST(RateCommand, PrintsTheFieldsOfTheVectorsInFullPrecision) {
  const nlohmann::json vectors = expected("cora");
  const nlohmann::json& first = vectors["cases"][0];
  RateRequest request;
  request.method = "cora";
  request.files = {vector_folder("cora") / first["files"]["pair"].get<std::string>()};
  const Printed p = printed([&] { return rate(request, OutputForm::Json); });
  EXPECT_EQ(p.code, ExitCode::Done);
  for (const auto& [key, value] : first["evaluations"][0]["expected"].items()) {
    EXPECT_TRUE(is_close(p.json[key].get<double>(), value.get<double>(), 1e-9)) << key;
  }
}

TEST(InjuryCommand, PrintsWindowsAsObjects) {
  InjuryRequest request;
  request.source = vector_folder("hic") / "pedestrian.csv";
  request.is_filtered = true;
  const Printed p = printed([&] { return injury(request, OutputForm::Json); });
  EXPECT_EQ(p.code, ExitCode::Done);
  EXPECT_NEAR(p.json["HIC15"]["value"].get<double>(), 689.0518434038969, 1e-9);
  EXPECT_TRUE(p.json["HIC15"].contains("t1"));
}

TEST(RateCommand, BadInputIsAnObjectWithItsCodeAndExitTwo) {
  RateRequest request;
  request.method = "cora";
  request.files = {vector_folder("cora") / "nan_in_sim.csv"};
  const Printed p = printed([&] { return rate(request, OutputForm::Json); });
  EXPECT_EQ(p.code, ExitCode::UserError);
  EXPECT_EQ(p.json["error"], "not_finite");
  EXPECT_TRUE(p.json.contains("message"));
  request.files = {"/nowhere.csv"};
  EXPECT_EQ(printed([&] { return rate(request, OutputForm::Json); }).code, ExitCode::UserError);
}

}  // namespace
}  // namespace crosswalk::recording
