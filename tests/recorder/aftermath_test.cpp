// Throw distance, rest and the head's second impact, of a record with known motion.
#include "recorder/aftermath.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "common/units.h"
#include "recorder/export_motion.h"

namespace crosswalk::recording {
namespace {

constexpr double kCarBlow = 1000, kRoadBlow = 2000;     // m/s2
constexpr double kCarTime = 0.010, kCarSpan = 0.003;    // s
constexpr double kRoadTime = 0.060, kRoadSpan = 0.002;  // s
constexpr double kSlide = 5, kStop = 0.150;             // m/s until then, s
constexpr std::int64_t kEnd = 300'000'000;              // ns

/// Two bodies of 3 and 1 kg: the first slides 0.75 m along y, the second stays; the head is pushed
/// twice.
RunRecord thrown_record() {
  RunRecord record;
  record.description[Role::Mb] =
      R"({"bodies": ["pelvis", "head", "buck"], "masses_kg": [3.0, 1.0], "head_body": 1,
          "contact_pairs": ["car_total", "head_car", "ground", "ground_head"]})";
  double speed = 0, y = 0;
  for (std::int64_t t_ns = 0; t_ns <= kEnd; t_ns += 50'000) {
    const double t = 1e-9 * static_cast<double>(t_ns);
    const bool by_car = t >= kCarTime && t < kCarTime + kCarSpan;
    const bool by_road = t >= kRoadTime && t < kRoadTime + kRoadSpan;
    HeadSample head;
    head.t_ns = t_ns;
    head.X_WH.p = Vec3(0, y, 1.6);
    head.V_WH.v = Vec3(0, speed, 0);
    record.head[t_ns] = head;
    speed += (by_car ? kCarBlow : by_road ? -kRoadBlow : 0) * 50e-6;
    y += speed * 50e-6;
    record.contact[t_ns] = {Vec3(0, 20, 0), Vec3(0, by_car ? 4000 : 0, 0), Vec3(0, 0, 700),
                            Vec3(0, 0, by_road ? 8000 : 0)};
    if (t_ns % 1'000'000 != 0) continue;
    Pose slider, still;
    slider.p = Vec3(0.1, kSlide * std::min(t, kStop), 0.9);
    still.p = Vec3(0, 0, 1.7);
    record.bodies[t_ns] = {slider, still, Pose{}};
  }
  return record;
}

double hic_of_constant(double acceleration, double span) {
  return span * std::pow(acceleration / kStandardGravity, 2.5);
}

TEST(Aftermath, TheRoadHasAnInjuryCriterionOfItsOwn) {
  const RunRecord record = thrown_record();
  const Aftermath after = aftermath_of(record, extract(record));
  ASSERT_TRUE(after.head_on_road);
  EXPECT_NEAR(after.head_on_road->time, kRoadTime, 1e-9);
  EXPECT_NEAR(after.head_on_road->peak_force, 8000, 1e-9);
  const double road = hic_of_constant(kRoadBlow, kRoadSpan);
  const double car = hic_of_constant(kCarBlow, kCarSpan);
  EXPECT_NEAR(after.head_on_road->HIC15.value, road, 0.08 * road);
  EXPECT_NEAR(after.head_on_road->HIC15_before.value, car, 0.08 * car);
  EXPECT_GT(after.head_on_road->peak_g, 1.5 * after.head_on_road->peak_g_before);
}

TEST(Aftermath, TheCentreOfMassTellsThrowAndRest) {
  const RunRecord record = thrown_record();
  const Aftermath after = aftermath_of(record, extract(record));
  ASSERT_TRUE(after.thrown);
  EXPECT_NEAR(after.thrown->distance, 0.75 * kSlide * kStop, 1e-9);
  EXPECT_NEAR(after.thrown->highest, 0.75 * 0.9 + 0.25 * 1.7, 1e-9);
  EXPECT_NEAR(after.thrown->end_speed, 0, 1e-9);
  ASSERT_TRUE(after.thrown->rest_time);
  EXPECT_NEAR(*after.thrown->rest_time, kStop, 0.0105);  // speeds are means over 10 ms
}

TEST(Aftermath, ABodyThatStillMovesIsNotAtRest) {
  RunRecord record = thrown_record();
  while (record.bodies.rbegin()->first > 100'000'000)
    record.bodies.erase(std::prev(record.bodies.end()));
  const Aftermath after = aftermath_of(record, extract(record));
  ASSERT_TRUE(after.thrown);
  EXPECT_NEAR(after.thrown->end_speed, 0.75 * kSlide, 1e-6);
  EXPECT_FALSE(after.thrown->rest_time);
}

TEST(Trajectories, OfEveryBodyAreExported) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / "cw_aftermath_bodies.csv";
  write_bodies_csv(file, thrown_record());
  std::ifstream in(file);
  std::string header, first, second;
  std::getline(in, header);
  std::getline(in, first);
  std::getline(in, second);
  in.close();
  std::filesystem::remove(file);
  EXPECT_TRUE(header.starts_with("t_ms,pelvis_x_mm,pelvis_y_mm,pelvis_z_mm,pelvis_qw")) << header;
  EXPECT_TRUE(header.ends_with("buck_qz")) << header;
  EXPECT_TRUE(second.starts_with("1.000,100.000,5.000,900.000,1.000000")) << second;
}

TEST(Aftermath, SaysNothingOfWhatTheRecordDoesNotHold) {
  RunRecord record = thrown_record();
  record.description[Role::Mb] = R"({"contact_pairs": ["car_total", "head_car", "ground"]})";
  const Aftermath after = aftermath_of(record, extract(record));
  EXPECT_FALSE(after.head_on_road);
  EXPECT_FALSE(after.thrown);
}

}  // namespace
}  // namespace crosswalk::recording
