// The verdict: numbers of the synthetic run, limits that warn, bands, ratings, and the files
// written.
#include "recorder/summary.h"

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "recorder/export_csv.h"
#include "tests/recorder/synthetic_run.h"
#include "tests/source_folder.h"

namespace crosswalk::recording {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

RunRecord synthetic_record(bool has_fe = true, int fe_passes = 1) {
  SyntheticRun run;
  run.has_fe = has_fe;
  run.fe_passes = fe_passes;
  RecordBuilder builder;
  for (const RawMessage& m : run.messages()) builder.add(m.data, 1);
  return builder.record();
}

Summary summary_of(const RunRecord& record, const std::optional<ReferenceData>& reference = {}) {
  return summarize(record, extract(record), reference);
}

TEST(Summary, TellsContactQualityAndEvents) {
  const Summary s = summary_of(synthetic_record());
  EXPECT_TRUE(s.is_complete);
  ASSERT_TRUE(s.head_contact);
  EXPECT_NEAR(s.head_contact->relative_speed, std::hypot(11.0, 0.5), 0.05);
  ASSERT_TRUE(s.fe);
  EXPECT_LT(s.fe->balance_percent, 1e-6);
  EXPECT_NEAR(s.fe->hourglass_percent, 2.0, 1e-6);
  ASSERT_TRUE(s.coupling);
  EXPECT_EQ(s.coupling->drift, 0);
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_THAT(s.warnings[0], HasSubstr("a joint has failed"));
  ASSERT_EQ(s.tissue.size(), 2U);
  EXPECT_EQ(s.tissue[1].region, "brain stem");
  EXPECT_NEAR(s.tissue[0].mps_95_so_far, 0.19, 0.01);
}

TEST(Summary, ComputingTimeIsThatOfEveryPassOfAWindow) {
  EXPECT_NEAR(summary_of(synthetic_record(true, 1)).timing.fe, 3e-3 * SyntheticRun::kWindows, 1e-9);
  EXPECT_NEAR(summary_of(synthetic_record(true, 3)).timing.fe, 9e-3 * SyntheticRun::kWindows, 1e-9);
}

TEST(Summary, WarnsWhereALimitIsBroken) {
  RunRecord record = synthetic_record();
  record.audit.rbegin()->second.drift = 0.05 * record.audit.rbegin()->second.exchanged;
  record.fe.rbegin()->second.hourglass = record.fe.rbegin()->second.internal;
  record.tissue.begin()->second.regions[0].inside_out = 0.03;
  const Summary s = summary_of(record);
  std::string all;
  for (const std::string& warning : s.warnings) all += warning + "\n";
  EXPECT_THAT(all, HasSubstr("interface audit drift is 5.00 %"));
  EXPECT_THAT(all, HasSubstr("hourglass energy is 100.00 %"));
  EXPECT_THAT(all, HasSubstr("finite-element energy balance error"));
  EXPECT_THAT(all, HasSubstr("share of cerebrum with corners inside out is 3.00 %"));
}

TEST(Summary, SaysThatARecordIsIncomplete) {
  RunRecord record = synthetic_record();
  record.is_finished = false;
  EXPECT_FALSE(summary_of(record).is_complete);
  record.abort_reason = "fe_node was killed at window 7";
  EXPECT_THAT(to_text(summary_of(record)), HasSubstr("aborted: fe_node was killed at window 7"));
}

TEST(Summary, BandsAreJudgedAndCurvesRated) {
  ReferenceData reference;
  reference.test = "synthetic";
  reference.bands = {{"head_contact_time_ms", 9, 11, "estimated", "here"},
                     {"HIC15", 1e5, 1e6, "estimated", "here"},
                     {"no_such_quantity", 1, 2, "estimated", "here"}};
  const RunRecord record = synthetic_record();
  const RunChannels run = extract(record);
  const Channel* own = run.find("head_speed_relative");
  ASSERT_NE(own, nullptr);
  reference.curves = {{"head_speed_relative", "mps", own->series(), {}, "the run itself"}};
  const Summary s = summarize(record, run, reference);
  ASSERT_EQ(s.bands.size(), 3U);
  EXPECT_TRUE(s.bands[0].is_inside);
  EXPECT_FALSE(s.bands[1].is_inside);
  EXPECT_FALSE(s.bands[2].value);
  ASSERT_EQ(s.ratings.size(), 1U);
  EXPECT_NEAR(s.ratings[0].cora->C, 1, 1e-9);
  EXPECT_NEAR(s.ratings[0].iso->R, 1, 1e-9);
}

/// Until the head should have been struck nothing is said of it; after that its miss counts.
TEST(Summary, ARunThatEndsBeforeTheHeadIsStruckIsNotJudged) {
  RunRecord record = synthetic_record();
  for (auto& [window, w] : record.fe) w.head_contact_force = 0;
  ReferenceData reference;
  reference.bands = {{"head_contact_time_ms", 105, 135, "estimated", "here"},
                     {"HIC15", 1e5, 1e6, "estimated", "here"}};
  const Summary early = summary_of(record, reference);
  ASSERT_TRUE(early.is_complete);
  EXPECT_FALSE(early.head_contact);
  EXPECT_FALSE(early.bands[1].value);
  reference.bands[0].high = 10;
  EXPECT_TRUE(summary_of(record, reference).bands[1].value);
}

TEST(Summary, WithoutCurvesNoScoreIsPrinted) {
  ReferenceData reference;
  reference.folder = "scenarios/reference/v2370";
  const std::string text = to_text(summary_of(synthetic_record(), reference));
  EXPECT_THAT(text, HasSubstr("No measured curve of this test"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("Ratings against")));
}

TEST(Summary, TextFitsATerminal) {
  const std::string text = to_text(summary_of(synthetic_record()));
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) EXPECT_LE(line.size(), 120U) << line;
}

TEST(ChannelsCsv, EveryDoubleAndUnitComesBack) {
  const fs::path path = fs::temp_directory_path() / "cw_channels_round_trip.csv";
  const RunChannels run = extract(synthetic_record());
  write_channels_csv(path, run.channels, {{"scenario", "V2370"}});
  const std::vector<Channel> back = read_channels_csv(path);
  fs::remove(path);
  ASSERT_EQ(back.size(), run.channels.size());
  for (std::size_t c = 0; c < back.size(); ++c) {
    EXPECT_EQ(back[c].name, run.channels[c].name);
    EXPECT_EQ(back[c].unit, run.channels[c].unit);
    EXPECT_EQ(back[c].description, run.channels[c].description);
    EXPECT_NEAR(back[c].dt, run.channels[c].dt, 1e-15);
    ASSERT_EQ(back[c].samples.size(), run.channels[c].samples.size());
    for (std::size_t i = 0; i < back[c].samples.size(); ++i) {
      const double wanted = run.channels[c].samples[i];
      if (std::isfinite(wanted)) {
        EXPECT_EQ(back[c].samples[i], wanted);
      } else {
        EXPECT_TRUE(std::isnan(back[c].samples[i]));
      }
    }
  }
}

TEST(ReferenceCurve, UnitsSignAndFrameAreTakenFromItsComments) {
  const fs::path path = fs::temp_directory_path() / "head_cog_y.csv";
  std::ofstream(path) << "# unit: m\n# sign: -1\n# relative_to: buck\n# source: digitised\n"
                      << "time_ms,value\n0,0\n1.5,-0.25\n2.1,-0.5\n";
  const ReferenceCurve curve = read_reference_curve(path);
  EXPECT_EQ(curve.channel, "head_cog_relative_y");
  EXPECT_DOUBLE_EQ(curve.series.t[1], 0.0015);
  EXPECT_DOUBLE_EQ(curve.series.y[1], 250);
  std::ofstream(path) << "# unit: furlong\ntime_ms,value\n0,0\n1,1\n";
  EXPECT_THROW(read_reference_curve(path), UserError);
  fs::remove(path);
}

/// A mistake in somebody's curve must not cost the run its results.
TEST(ReferenceData, ABrokenCurveIsLeftOutWithAWarning) {
  const fs::path folder = fs::temp_directory_path() / "cw_reference_broken";
  fs::create_directories(folder / "curves");
  std::ofstream(folder / "curves/head_cog_y.csv") << "# unit: mm\ntime_ms,value\n1,0\n0,1\n";
  std::ofstream(folder / "curves/head_cog_z.csv") << "# unit: mm\ntime_ms,value\n0,0\n5,1\n";
  const ReferenceData data = read_reference(folder);
  fs::remove_all(folder);
  ASSERT_EQ(data.curves.size(), 1U);
  EXPECT_EQ(data.curves[0].channel, "head_cog_z");
  ASSERT_EQ(data.faults.size(), 1U);
  const Summary s = summary_of(synthetic_record(), data);
  EXPECT_THAT(s.warnings, testing::Contains(HasSubstr("time does not increase")));
  EXPECT_FALSE(s.ratings.empty());
}

TEST(ReferenceData, ACurveOfAnyChannelIsRatedAndOneOfNoChannelIsTold) {
  const RunRecord record = synthetic_record();
  const RunChannels run = extract(record);
  const Series own = run.find("buck_velocity_y")->series();
  ReferenceData data;
  data.curves = {{"buck_velocity_y", "mps", own, {}, "the run itself"},
                 {"hed_cog_y", "mm", own, {}, "a slip of the pen"}};
  const Summary s = summarize(record, run, data);
  ASSERT_EQ(s.ratings.size(), 1U);
  EXPECT_EQ(s.ratings[0].signal.label, "buck velocity y");
  EXPECT_EQ(s.ratings[0].signal.weight, 0);  // no part of the mean of the five head signals
  EXPECT_NEAR(s.ratings[0].cora->C, 1, 1e-9);
  EXPECT_THAT(s.warnings, testing::Contains(HasSubstr("no channel 'hed_cog_y'")));
}

TEST(ReferenceData, ARunShorterThanItsCurvesIsRatedWithAWarning) {
  const RunRecord record = synthetic_record();
  const RunChannels run = extract(record);
  ReferenceData data;
  data.curves = {{"head_cog_y", "mm", run.find("head_cog_y")->present(), {}, "the run itself"}};
  EXPECT_THAT(summarize(record, run, data).warnings,
              testing::Not(testing::Contains(HasSubstr("common time only"))));
  data.curves[0].series.t.push_back(0.2);
  data.curves[0].series.y.push_back(0);
  EXPECT_THAT(summarize(record, run, data).warnings,
              testing::Contains(HasSubstr("the curves of the test at 200 ms")));
}

TEST(ReferenceData, TheThreePublishedTestsAreKeptAsPrinted) {
  const fs::path root = source_folder() / "scenarios" / "reference";
  double sum = 0;
  for (const char* test : {"v2370", "v2371", "v2374"}) {
    const ReferenceData data = read_reference(root / test);
    EXPECT_GE(data.bands.size(), 5U);
    EXPECT_EQ(data.scores.size(), 10U);
    EXPECT_FALSE(data.facts.empty());
    EXPECT_TRUE(data.curves.empty());
    for (const PublishedScore& score : data.scores) {
      if (score.model == "CPCBM coupled" && score.signal == "head_acceleration_resultant")
        sum += score.score;
    }
  }
  EXPECT_NEAR(sum / 3, 0.767, 5e-4);  // [yu2020, Table 3], the mean the abstract rounds to 0.77
}

}  // namespace
}  // namespace crosswalk::recording
