// The scaled pedestrian against an independent evaluation of the same formulas, and its invariants.
#include "common/body_description.h"

#include <fstream>
#include <sstream>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/common/subject_fixture.h"
#include "tests/source_folder.h"

namespace crosswalk {
namespace {

struct Row {
  std::string name;
  std::vector<double> values;
};

std::vector<Row> read_rows(const std::string& file) {
  std::ifstream stream(source_folder() / "tests/common" / file);
  std::vector<Row> rows;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    Row row;
    std::getline(cells, row.name, ',');
    for (std::string cell; std::getline(cells, cell, ',');) row.values.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

int index_of(const BodyDescription& body, const std::string& name) {
  const int i = body.find_segment(name);
  return i >= 0 ? i : body.find_segment(name.substr(0, name.size() - 2));
}

TEST(BodyDescription, HasTheTreeOf52BodiesAnd64Ellipsoids) {
  const BodyDescription body = load_subject("male_50");
  EXPECT_EQ(body.segments.size(), 52u);
  EXPECT_EQ(body.ellipsoids.size(), 64u);
  int freedoms = 0, rows = 0;
  for (std::size_t i = 0; i < body.segments.size(); ++i) {
    const Segment& segment = body.segments[i];
    EXPECT_LT(segment.parent, static_cast<int>(i)) << segment.name;
    switch (segment.joint) {
      case JointType::Free:
        freedoms += 6;
        break;
      case JointType::Ball:
        freedoms += 3, rows += 3;
        break;
      case JointType::UniversalXY:
        freedoms += 2, rows += 4;
        break;
      default:
        freedoms += 1, rows += 5;
    }
  }
  EXPECT_EQ(freedoms, 123);
  EXPECT_EQ(rows, 189);
  EXPECT_EQ(without_head_and_neck(body).segments.size(), 49u);
}

TEST(BodyDescription, ReferencePersonMatchesTheIndependentTable) {
  const BodyDescription body = load_subject("male_50");
  const std::vector<Row> rows = read_rows("am50_bodies.csv");
  ASSERT_EQ(rows.size(), 30u);
  for (const Row& row : rows) {
    const int i = index_of(body, row.name);
    ASSERT_GE(i, 0) << row.name;
    const Segment& s = body.segments[i];
    EXPECT_NEAR(s.mass, row.values[0], 1.5e-4) << row.name;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(s.com[k], 1e-3 * row.values[1 + k], 1e-4) << row.name;
      // 0.1 % and the last printed digit
      EXPECT_NEAR(s.inertia(k, k), 1e-4 * row.values[4 + k], 1e-7 * row.values[4 + k] + 0.6e-6)
          << row.name;
      EXPECT_NEAR(s.joint_centre[k], 1e-3 * row.values[7 + k], 1e-4) << row.name;
    }
  }
}

TEST(BodyDescription, ReferenceEllipsoidsMatchTheIndependentTable) {
  const BodyDescription body = load_subject("male_50");
  const std::vector<Row> rows = read_rows("am50_ellipsoids.csv");
  ASSERT_EQ(rows.size(), 37u);
  for (const Row& row : rows) {
    const int i = body.find_ellipsoid(row.name);
    ASSERT_GE(i, 0) << row.name;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(body.ellipsoids[i].centre[k], 1e-3 * row.values[k], 1.1e-4) << row.name;
      EXPECT_NEAR(body.ellipsoids[i].semi_axes[k], 1e-3 * row.values[3 + k], 1.1e-4) << row.name;
    }
  }
}

class EverySubject : public testing::TestWithParam<const char*> {};

TEST_P(EverySubject, KeepsMassExactlyAndInertiaPossible) {
  const BodyDescription body = load_subject(GetParam());
  EXPECT_NEAR(body.total_mass(), body.measures.mass, 1e-12 * body.measures.mass);
  for (const Segment& s : body.segments) {
    EXPECT_GT(s.mass, 0) << s.name;
    const Vec3 moments = s.inertia.diagonal();
    EXPECT_GT(moments.minCoeff(), 0) << s.name;
    EXPECT_LE(2 * moments.maxCoeff(), moments.sum() * (1 + 1e-12)) << s.name;
  }
}

TEST_P(EverySubject, IsSymmetricLeftAndRight) {
  const BodyDescription body = load_subject(GetParam());
  for (const Segment& left : body.segments) {
    if (!left.name.ends_with("_l")) continue;
    const int i = body.find_segment(left.name.substr(0, left.name.size() - 2) + "_r");
    ASSERT_GE(i, 0);
    const Segment& right = body.segments[i];
    EXPECT_EQ(left.mass, right.mass);
    EXPECT_EQ(left.com.y(), -right.com.y());
    EXPECT_EQ(left.restraint.angle[1].min, -right.restraint.angle[1].max);
    EXPECT_EQ(left.restraint.angle[0].min, right.restraint.angle[0].min);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EverySubject,
                         testing::Values("male_50", "v2370", "v2371", "v2374"));

TEST(BodyDescription, WholeBodyOfTheSubjectsMatchesTheIndependentTable) {
  struct Case {
    const char* subject;
    double mass, com_height_mm, roll, pitch, yaw, head_Ixx;
  };
  for (const Case& c : {Case{"male_50", 75.70, 997.2, 12.630, 12.090, 0.860, 208.4},
                        Case{"v2370", 72.60, 1053.7, 12.432, 11.903, 0.814, 146.3},
                        Case{"v2371", 81.60, 1078.1, 14.959, 14.309, 0.976, 233.5}}) {
    const BodyDescription body = load_subject(c.subject);
    Inertia whole;
    for (const Segment& s : body.segments) whole = whole + Inertia{s.mass, s.com, s.inertia};
    EXPECT_NEAR(whole.mass, c.mass, 1e-9);
    EXPECT_NEAR(1e3 * whole.com.z(), c.com_height_mm, 0.1) << c.subject;
    EXPECT_NEAR(whole.about_com(0, 0), c.roll, 2e-3 * c.roll) << c.subject;
    EXPECT_NEAR(whole.about_com(1, 1), c.pitch, 2e-3 * c.pitch) << c.subject;
    EXPECT_NEAR(whole.about_com(2, 2), c.yaw, 2e-3 * c.yaw) << c.subject;
    EXPECT_NEAR(1e4 * body.segments[body.find_segment("head")].inertia(0, 0), c.head_Ixx, 0.3);
  }
}

TEST(BodyDescription, AmputatedForearmsLeave44BodiesAndTheMass) {
  const BodyDescription body = load_subject("v2374");
  EXPECT_EQ(body.segments.size(), 44u);
  EXPECT_EQ(body.find_segment("hand_l"), -1);
  EXPECT_GE(body.find_segment("forearm_prox_r"), 0);
}

TEST(BodyDescription, MeasuredBackDiffersFromAskedNoMoreThanPublishedModels) {
  // Heights and lengths only: worst differences of the published scaled models [yu2020, Table 2],
  // the misprinted armpit height of V2374 left out: 47.3 mm (knee height, V2371).
  constexpr double kPublishedWorst = 47.3e-3;
  for (const char* subject : {"male_50", "v2370", "v2371"}) {
    const BodyDescription body = load_subject(subject);
    const Anthropometry got = measured_on(body);
    EXPECT_NEAR(got.standing_height, body.measures.standing_height, 1e-9);
    for (const Measure& measure : anthropometry_measures()) {
      if (measure.kind != MeasureKind::Length) continue;
      EXPECT_NEAR(got.*measure.value, body.measures.*measure.value, kPublishedWorst)
          << subject << " " << measure.name;
    }
  }
}

TEST(BodyDescription, FormulaFaultsAreReportedAtTheirPlace) {
  ConfigDocument document = subject_document(
      "male_50",
      "[subject.ellipsoid]\nhat = { body = \"head\", region = \"head\", centre = \"0, 0, "
      "z_crown\", semi_axes = \"0.1, 0.1, 0.1\" }\n");
  read_body_description(document.root().table("subject", "subject"));
  try {
    document.finish();
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("subject.ellipsoid.hat.centre"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("unknown name `z_crown`"), std::string::npos);
  }
}

}  // namespace
}  // namespace crosswalk
