// From a record to what the report shows: scene, verdict, comparison.
#include "recorder/run_report.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recorder/path_gap.h"
#include "recorder/run_compare.h"
#include "recorder/run_scene.h"
#include "recorder/run_tables.h"
#include "tests/recorder/synthetic_run.h"

namespace crosswalk::recording {
namespace {

namespace fs = std::filesystem;

using testing::Contains;
using testing::Field;
using testing::HasSubstr;

RunRecord record_of(bool has_fe) {
  SyntheticRun run;
  run.has_fe = has_fe;
  RecordBuilder builder;
  for (const RawMessage& m : run.messages()) builder.add(m.data, 1);
  return builder.record();
}

Analysis analysis_of(bool has_fe) { return analyze_record(record_of(has_fe)); }

RunRecord drawn_record() {
  RunRecord record;
  record.description[Role::Mb] = R"({
    "bodies": ["pelvis", "buck"], "head_body": -1,
    "ellipsoids": [
      {"name": "pelvis", "body": 0, "centre_m": [0, 0, 0.1], "semi_axes_m": [0.1, 0.2, 0.1]},
      {"name": "flat", "body": 0, "centre_m": [0, 0, 0], "semi_axes_m": [0.1, 0, 0.1]},
      {"name": "lost", "body": 7, "centre_m": [0, 0, 0], "semi_axes_m": [0.1, 0.1, 0.1]}],
    "vehicle": {"facets": [{"component": "hood", "begin_yz_m": [0, 0.7], "end_yz_m": [-1, 0.9],
                            "half_width_m": 0.8}]}})";
  record.description[Role::Fe] = R"({"head_surface": {
    "vertices_m": [[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]], "triangles": [[0, 1, 2], [0, 1, 9]]}})";
  Pose pelvis;
  pelvis.p = Vec3(0, 0, 0.95);
  Pose buck;
  buck.p = Vec3(0, -0.2, 0);
  record.bodies[2'000'000] = {pelvis, buck};
  record.bodies[3'000'000] = {pelvis, buck};
  record.bodies[4'000'000] = {pelvis};  // another number of bodies: left out
  HeadSample head;
  head.t_ns = 2'500'000;
  head.X_WH.p = Vec3(0, 0, 1.7);
  record.head[head.t_ns] = head;
  return record;
}

TEST(RunScene, TakesShapesAndPosesAndLeavesOutWhatIsUnsound) {
  const Scene scene = scene_of(drawn_record(), 0.002);
  ASSERT_EQ(scene.ellipsoids.size(), 1U);
  EXPECT_EQ(scene.ellipsoids[0].X_BE.p, Vec3(0, 0, 0.1));
  ASSERT_EQ(scene.facets.size(), 1U);
  EXPECT_EQ(scene.facets[0].end, Eigen::Vector2d(-1, 0.9));
  ASSERT_TRUE(scene.head);
  EXPECT_EQ(scene.head->triangles.size(), 1U);
  ASSERT_EQ(scene.frames.size(), 2U);
  EXPECT_NEAR(scene.frames[0].t, 0.0, 1e-12);
  EXPECT_NEAR(scene.frames[1].t, 0.001, 1e-12);
  EXPECT_EQ(scene.frames[0].X_WV.p, Vec3(0, -0.2, 0));
  EXPECT_EQ(scene.frames[0].X_WH->p, Vec3(0, 0, 1.7));
}

TEST(RunScene, DamagedDescriptionsGiveAnEmptyScene) {
  RunRecord record = drawn_record();
  record.description[Role::Mb] = "{\"bodies\": [";
  EXPECT_TRUE(scene_of(record, 0).ellipsoids.empty());
  EXPECT_TRUE(scene_of(RunRecord{}, 0).empty());
}

const VerdictRow& row_of(const ReportInput& input, const std::string& label) {
  for (const VerdictRow& row : input.verdict) {
    if (row.label == label) return row;
  }
  throw std::out_of_range(label);
}

TEST(RunReport, VerdictTellsContactAndQuality) {
  const RunRecord record = record_of(true);
  const ReportInput input = report_input(analyze_record(record), record, RunDirectory("nowhere"));
  EXPECT_EQ(row_of(input, "Head contact time").value, "10.0");
  EXPECT_EQ(row_of(input, "Interface energy drift").status, Verdict::Good);
  EXPECT_EQ(row_of(input, "Record").status, Verdict::Good);
  EXPECT_THAT(input.story, HasSubstr("40 km/h"));
  EXPECT_THAT(input.marks, Contains(Field(&TimeMark::label, "head contact")));
  ASSERT_TRUE(input.tissue);
  EXPECT_EQ(input.tissue->regions.size(), 2U);
}

TEST(RunReport, InjuryMetricsComeWithWindowsAndParameters) {
  const RunRecord record = record_of(true);
  Analysis analysis = analyze_record(record);
  SignalRating rating{{"head_cog_y", "Y", 1}, "test", CoraResult{}, {}, "ISO fault"};
  analysis.summary.ratings = {rating};
  const std::vector<ReportTable> tables = run_tables(analysis.summary);
  ASSERT_GE(tables.size(), 3U);
  EXPECT_THAT(tables[0].caption, HasSubstr("interval full, A_THRES 0.03,"));
  ASSERT_EQ(tables[0].rows.size(), 1U);
  EXPECT_EQ(tables[0].rows[0].size(), tables[0].columns.size());
  EXPECT_EQ(tables[1].rows[0].size(), tables[1].columns.size());
  EXPECT_THAT(tables[0].rows[0].back(), HasSubstr("ISO fault"));
  EXPECT_EQ(tables[2].title, "Head and neck injury metrics");
  EXPECT_EQ(tables[2].rows[0][0], "HIC15");
  EXPECT_THAT(tables[2].rows[0][3], HasSubstr(" to "));
  for (const auto& row : tables[2].rows) EXPECT_EQ(row.size(), 4U) << row[0];
  EXPECT_EQ(tables[2].rows.back()[0], "Nkm");
}

TEST(RunReport, SpeedIsHeldAgainstABandOfItsRatio) {
  const RunRecord record = record_of(true);
  Analysis analysis = analyze_record(record);
  analysis.summary.bands = {{{"head_contact_speed_ratio", 0.9, 1.4, "estimated", "me"}, 1.0, true}};
  const ReportInput input = report_input(analysis, record, RunDirectory("nowhere"));
  const VerdictRow& row = row_of(input, "Head speed against the car");
  EXPECT_EQ(row.band, "0.9 – 1.4 times the car's speed (estimated, me)");
  EXPECT_EQ(row.status, Verdict::Good);
}

TEST(RunReport, WithoutMeasuredCurvesNothingIsRated) {
  const RunRecord record = record_of(false);
  const ReportInput input = report_input(analyze_record(record), record, RunDirectory("nowhere"));
  EXPECT_EQ(row_of(input, "CORA and ISO/TS 18571").value, "not rated");
  EXPECT_FALSE(input.tissue);
}

TEST(RunCompare, EqualRunsScoreOneAndShareTheirBars) {
  const std::vector<ComparedRun> runs{{"a", analysis_of(false), {}}, {"b", analysis_of(true), {}}};
  const ReportInput input = comparison_input(runs);
  ASSERT_EQ(input.bars.size(), 3U);
  EXPECT_EQ(input.bars[0].groups.size(), 1U);
  EXPECT_EQ(input.bars[0].labels, (std::vector<std::string>{"multibody", "coupled"}));
  EXPECT_EQ(input.bars[2].groups.size(), 5U);  // a group per signal
  EXPECT_NEAR(input.bars[2].values[0][0], 1, 1e-12);
  EXPECT_THAT(comparison_text(runs), HasSubstr("HIC15"));
  const ReportTable& mutual = input.tables.back();
  ASSERT_EQ(mutual.rows.size(), 6U);
  EXPECT_EQ(mutual.columns.size(), 2U);  // one comparison has no deviation
  for (const auto& row : mutual.rows) EXPECT_EQ(row[1], "1.000") << row[0];
  EXPECT_EQ(input.curves.size(), 2U);
}

TEST(RunCompare, TwoCouplingsOfOneModelShowTheirErrorBar) {
  ComparedRun mic{"a", analysis_of(true), {}}, fine = mic;
  Summary& s = fine.analysis.summary;
  s.manifest.scheme = 1;
  s.manifest.window_ns = SyntheticRun::kWindowNs / 2;
  ASSERT_TRUE(s.card.linear);
  s.card.linear->peak_g *= 0.995;
  for (Channel& channel : fine.analysis.channels.channels)
    if (channel.name == "head_cog_z")
      channel.samples.back() += 0.04;  // mm, long after head contact
  const ReportInput input = comparison_input({mic, fine});
  const auto table =
      std::find_if(input.tables.begin(), input.tables.end(),
                   [](const ReportTable& t) { return t.title == "Error bar of the coupling"; });
  ASSERT_NE(table, input.tables.end());
  ASSERT_EQ(table->rows.size(), 1U);
  const std::vector<std::string>& row = table->rows[0];
  EXPECT_THAT(row[0], HasSubstr("implicit 10 us against mic 20 us"));
  EXPECT_EQ(row[1], "0.0000");
  EXPECT_EQ(row[2], "0.0400");
  EXPECT_EQ(row[4], "0.50");
  EXPECT_THAT(comparison_text({mic, mic}), testing::Not(HasSubstr("Error bar")));
}

/// Curves of a test in a folder of scenarios of one's own, equal to a run's but for a factor.
class OwnCurves {
 public:
  OwnCurves(const std::string& scenario, const RunChannels& run, double speed_factor) {
    std::string test = scenario;
    for (char& c : test) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const fs::path curves = folder_ / "reference" / test / "curves";
    fs::create_directories(curves);
    write(curves / "head_cog_y.csv", *run.find("head_cog_y"), 1, "mm");
    write(curves / "head_speed_relative.csv", *run.find("head_speed_relative"), speed_factor,
          "m/s");
    setenv("CROSSWALK_SCENARIOS", folder_.c_str(), 1);
  }
  ~OwnCurves() {
    unsetenv("CROSSWALK_SCENARIOS");
    fs::remove_all(folder_);
  }
  OwnCurves(const OwnCurves&) = delete;
  OwnCurves& operator=(const OwnCurves&) = delete;

 private:
  static void write(const fs::path& path, const Channel& channel, double factor, const char* unit) {
    std::ofstream out(path);
    out << "# unit: " << unit << "\ntime_s,value\n";
    out.precision(17);
    for (std::size_t i = 0; i < channel.samples.size(); ++i) {
      if (std::isfinite(channel.samples[i]))
        out << channel.time(i) << "," << factor * channel.samples[i] << "\n";
    }
  }
  fs::path folder_ = fs::temp_directory_path() / "cw_own_curves";
};

/// The layout of the published table: scores by signal, mean and deviation by model, weights.
TEST(RunCompare, OwnCurvesFillTheTableOfTheTests) {
  const std::vector<ComparedRun> runs{{"a", analysis_of(false), {}}, {"b", analysis_of(false), {}}};
  const RunChannels& channels = runs[0].analysis.channels;
  const OwnCurves curves(runs[0].analysis.summary.manifest.scenario, channels, 0.8);
  ComparisonSettings settings;
  settings.set = {{"head_cog_y", "Y", 3}, {"head_speed_relative", "speed", 1}};
  const ReportInput input = comparison_input(runs, settings);
  const ReportTable& table = input.tables.at(1);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.columns.back(), "multibody: mean ± deviation");
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"Y (weight 3)", "1.000", "1.000", "1.000 ± 0.000"}));
  const double speed = std::stod(table.rows[1][1]);
  EXPECT_LT(speed, 0.95);
  EXPECT_NEAR(std::stod(table.rows[2][1]), (3 + speed) / 4, 1e-3);
  EXPECT_EQ(input.bars.size(), 4U);
  ASSERT_EQ(input.curves.size(), 3U);
  EXPECT_EQ(input.curves[2].origin, CurveOrigin::Reference);
}

TEST(RunCompare, PathGapIsTheLargestDistanceBeforeTheHeadStrikes) {
  Analysis a = analysis_of(false), b = analysis_of(false);
  for (Channel& channel : b.channels.channels) {
    if (channel.name != "head_cog_x" && channel.name != "head_cog_z") continue;
    for (std::size_t i = 0; i < channel.samples.size(); ++i) {
      const double t = channel.time(i);
      // 3 and 4 mm at 5 ms, and a gulf after the contact at 10 ms.
      const double share = t < 0 ? 0 : t < 5e-3 ? t / 5e-3 : t < 10.5e-3 ? 0.9 : 100;
      channel.samples[i] += (channel.name == "head_cog_x" ? 3 : 4) * share;
    }
  }
  const std::optional<PathGap> gap = path_gap(a, b);
  ASSERT_TRUE(gap);
  EXPECT_NEAR(gap->largest_mm, 5, 0.11);  // one sample of 0.1 ms
  EXPECT_NEAR(gap->time, 5e-3, 1.01e-4);
  EXPECT_NEAR(gap->until, 10e-3, 1e-6);
}

}  // namespace
}  // namespace crosswalk::recording
