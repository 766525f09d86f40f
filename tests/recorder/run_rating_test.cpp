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

TEST(RunRating, AMissingSampleInsideIsAFault) {
  Channel a = wave("head_cog_x", "mm", 1);
  a.samples[250] = std::nan("");
  const auto ratings =
      rate_against_run({{"head_cog_x", "X", 1}}, {a}, {wave("head_cog_x", "mm", 1)}, "other");
  EXPECT_FALSE(ratings[0].cora);
  EXPECT_THAT(ratings[0].fault, ::testing::HasSubstr("sample 250"));
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

/// The files of a case, and its parameters in a file of their own.
RateRequest request_of(const std::string& method, const nlohmann::json& item,
                       const nlohmann::json& parameters) {
  RateRequest request;
  request.method = method;
  const nlohmann::json files =
      item.contains("files") ? item["files"] : nlohmann::json{{"pair", item["file"]}};
  for (const char* key : {"pair", "ref", "sim"}) {
    if (files.contains(key))
      request.files.push_back(vector_folder(method) / files[key].get<std::string>());
  }
  request.parameters = fs::temp_directory_path() / "cw_rate_parameters.json";
  std::ofstream(request.parameters) << parameters.dump();
  return request;
}

/// What the command prints, or the error object, as the vectors state it.
void expect_printed(const RateRequest& request, const nlohmann::json& wanted) {
  const Printed p = printed([&] { return rate(request, OutputForm::Json); });
  const std::string where = request.files.front().string();
  if (wanted.contains("error")) {
    EXPECT_EQ(p.code, ExitCode::UserError) << where;
    EXPECT_EQ(p.json["error"], wanted["error"]) << where;
    EXPECT_TRUE(p.json.contains("message")) << where;
    return;
  }
  EXPECT_EQ(p.code, ExitCode::Done) << where;
  for (const auto& [key, value] : wanted["expected"].items()) {
    ASSERT_TRUE(p.json.contains(key)) << where << ": " << key;
    if (value.is_number()) {
      EXPECT_TRUE(is_close(p.json[key].get<double>(), value.get<double>(), 1e-6))
          << where << ": " << key;
    } else {
      EXPECT_EQ(p.json[key], value) << where << ": " << key;
    }
  }
}

TEST(RateCommand, FoldersInPlaceOfFilesAreAnError) {
  const fs::path folder = fs::temp_directory_path();
  RateRequest request{"cora", {vector_folder("cora") / "identical.csv"}, {}, {}, folder, {}};
  EXPECT_EQ(printed([&] { return rate(request, OutputForm::Json); }).json["error"],
            "bad_parameter");
  const auto broken = [] {
    fs::create_directories("/proc/no_such_folder");
    return ExitCode::Done;
  };
  const Printed p = printed(broken);
  EXPECT_EQ(p.code, ExitCode::UserError);
  EXPECT_EQ(p.json["error"], "input");
}

TEST(RateCommand, ParametersThatCannotBeReadAreBad) {
  RateRequest request{"cora", {vector_folder("cora") / "identical.csv"}, {}, {}, {}, {}};
  request.parameters = fs::temp_directory_path() / "cw_rate_broken.json";
  for (const char* text : {"{bad", "[1]", "{\"a_0\": 1e400}", "{\"a_0\": \"x\"}", "{\"foo\": 1}"}) {
    std::ofstream(request.parameters) << text;
    const Printed p = printed([&] { return rate(request, OutputForm::Json); });
    EXPECT_EQ(p.code, ExitCode::UserError) << text;
    EXPECT_EQ(p.json["error"], "bad_parameter") << text;
  }
  fs::remove(request.parameters);
}

TEST(RateCommand, PrintsTheFieldsOfTheCoraVectors) {
  const nlohmann::json cases = expected("cora")["cases"];
  for (const nlohmann::json& item : cases) {
    for (const nlohmann::json& evaluation : item["evaluations"])
      expect_printed(request_of("cora", item, evaluation["parameters"]), evaluation);
  }
}

TEST(RateCommand, PrintsTheFieldsOfTheIsoVectors) {
  const nlohmann::json cases = expected("iso18571")["cases"];
  for (const nlohmann::json& item : cases)
    expect_printed(request_of("iso18571", item, item.value("parameters", nlohmann::json::object())),
                   item);
}

TEST(InjuryCommand, PrintsWindowsAsObjects) {
  const nlohmann::json vectors = expected("hic");
  for (const nlohmann::json& item : vectors["cases"]) {
    if (!item.contains("expected")) continue;
    InjuryRequest request;
    request.source = vector_folder("hic") / item["file"].get<std::string>();
    request.is_filtered = true;
    const Printed p = printed([&] { return injury(request, OutputForm::Json); });
    EXPECT_EQ(p.code, ExitCode::Done);
    const nlohmann::json& wanted = item["expected"]["HIC15"];
    EXPECT_TRUE(is_close(p.json["HIC15"]["value"].get<double>(), wanted["value"].get<double>(),
                         vectors["tolerance"]["relative"]))
        << request.source;
    EXPECT_TRUE(p.json["HIC15"].contains("t1"));
  }
}

TEST(RateCommand, BadInputIsAnObjectWithItsCodeAndExitTwo) {
  RateRequest request;
  request.method = "cora";
  request.files = {"/nowhere.csv"};
  const Printed p = printed([&] { return rate(request, OutputForm::Json); });
  EXPECT_EQ(p.code, ExitCode::UserError);
  EXPECT_TRUE(p.json.contains("error"));
  EXPECT_TRUE(p.json.contains("message"));
}

}  // namespace
}  // namespace crosswalk::recording
