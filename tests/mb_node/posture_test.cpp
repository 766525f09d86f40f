#include "mb_node/posture.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "common/error.h"
#include "common/units.h"
#include "mb_node/world_builder.h"
#include "tests/common/subject_fixture.h"
#include "tests/mb_node/mb_fixture.h"

namespace crosswalk::mb {
namespace {

struct Stance {
  MbConfig config;
  Posture posture;
  Vec3 joint(const std::string& name) const {
    const int i = config.body.find_segment(name);
    return posture.X_WB[i] *
           Vec3(config.body.segments[i].joint_centre - config.body.segments[i].com);
  }
  double lowest(const std::string& side) const {
    double z = 1;
    for (const char* part : {"talus", "hindfoot", "forefoot", "toes"}) {
      z = std::min(z,
                   lowest_point(config.body, posture.X_WB, config.body.find_segment(part + side)));
    }
    return z;
  }
};

Stance stand(const std::string& test, const std::string& more = {}) {
  Stance s{load_config(test, RunMode::Multibody, more), {}};
  s.posture = solve_posture(s.config.body, s.config.posture);
  return s;
}

TEST(Markers, BringTheBodyWhereTheyWereSeen) {
  // Points of the measured stance, given to a person who starts erect: the joints come back.
  const Stance seen = stand("v2370");
  Stance s{load_config("v2370", RunMode::Multibody,
                       "[posture]\nleft_hip_flexion_deg = 0.0\nright_hip_flexion_deg = 0.0\n"
                       "left_knee_flexion_deg = 0.0\nright_knee_flexion_deg = 0.0\n"),
           {}};
  const Vec3 aside(0, 0.04, -0.02);
  for (const char* name : {"pelvis", "torso_up", "head", "femur_1_l", "femur_1_r", "tibia_1_l",
                           "tibia_1_r", "talus_l", "talus_r"}) {
    const int i = s.config.body.find_segment(name);
    const Segment& segment = s.config.body.segments[i];
    for (const Vec3& offset : {Vec3(Vec3::Zero()), aside}) {
      s.config.posture.markers.push_back(
          {name, name, offset,
           seen.posture.X_WB[i] * Vec3(segment.joint_centre + offset - segment.com), 0.001});
    }
  }
  s.posture = solve_posture(s.config.body, s.config.posture);
  int markers = 0;
  for (const PostureResidual& r : s.posture.residuals) {
    if (!r.what.starts_with("marker")) continue;
    ++markers;
    EXPECT_LT(r.obtained, 0.003) << r.what;  // the height is that of the feet, in the end
  }
  EXPECT_EQ(markers, 18);
  for (const char* name : {"tibia_1_l", "tibia_1_r", "talus_l", "talus_r"}) {
    const Vec3 found = s.joint(name) - s.joint("pelvis");
    EXPECT_LT((found - seen.joint(name) + seen.joint("pelvis")).norm(), 0.004) << name;
  }
}

TEST(Markers, NoPostureMeetsAreRefusedByNameAndDistance) {
  Stance s{load_config("v2370", RunMode::Multibody), {}};
  s.config.posture.markers = {{"hip", "pelvis", Vec3::Zero(), Vec3(0, 0, 0.95), 0.001},
                              {"crown", "head", Vec3::Zero(), Vec3(0, 0, 2.6), 0.01}};
  try {
    solve_posture(s.config.body, s.config.posture);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("crown"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("mm away"), std::string::npos) << error.what();
  }
}

TEST(Markers, UnderTheGroundAreRefusedWithTheAmount) {
  const Stance seen = stand("v2370");
  Stance s{load_config("v2370", RunMode::Multibody), {}};
  for (const char* name : {"pelvis", "femur_1_l", "femur_1_r", "talus_l", "talus_r"}) {
    s.config.posture.markers.push_back(
        {name, name, Vec3::Zero(), seen.joint(name) - Vec3(0, 0, 0.2), 0.001});
  }
  try {
    solve_posture(s.config.body, s.config.posture);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("feet 20"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("mm below it"), std::string::npos) << error.what();
  }
}

TEST(Markers, AreReadFromTheScenario) {
  const Stance s = stand("v2370",
                         "[[posture.marker]]\nname = \"left knee\"\nbody = \"tibia_1_l\"\n"
                         "offset_mm = [0.0, 50.0, 0.0]\nposition_mm = [130.0, 140.0, 612.0]\n"
                         "sigma_mm = 5.0\n");
  ASSERT_EQ(s.config.posture.markers.size(), 1u);
  EXPECT_NEAR(s.config.posture.markers[0].position.y(), 0.14, 1e-12);
  EXPECT_NEAR(s.config.posture.markers[0].offset.y(), 0.05, 1e-12);
  EXPECT_EQ(s.posture.residuals.end()[-2].what, "marker left knee: distance (m)");
}

TEST(Stance, WithAKneeInTheGroundIsRefusedByNameAndAmount) {
  try {
    stand("v2370",
          "[posture]\nleft_hip_flexion_deg = 0.0\nleft_knee_flexion_deg = 130.0\n"
          "right_hip_flexion_deg = 100.0\nright_knee_flexion_deg = 20.0\n");
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("_l above the ground"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("mm below it"), std::string::npos) << error.what();
  }
}

TEST(Gait, EveryPhaseOfWalkingAndRunningStandsOnTheGround) {
  for (const char* gait : {"walking", "running"}) {
    for (int phase = 0; phase <= 100; phase += 5) {
      const Stance s =
          stand("walking_40", std::string("[posture]\nbase = \"../postures/") + gait +
                                  ".toml\"\ngait_phase = " + std::to_string(phase) + ".0\n");
      EXPECT_NEAR(std::min(s.lowest("_l"), s.lowest("_r")), -1.5e-3, 1e-6) << gait << phase;
    }
  }
}

class MeasuredStance : public testing::TestWithParam<const char*> {};

TEST_P(MeasuredStance, BothFeetTouchTheGroundAndNeitherGoesIn) {
  const Stance s = stand(GetParam());
  EXPECT_NEAR(s.lowest("_l"), -1.5e-3, 1e-6);
  EXPECT_NEAR(s.lowest("_r"), -1.5e-3, 1e-6);
}

TEST_P(MeasuredStance, ReproducesTheSegmentAngles) {
  const Stance s = stand(GetParam());
  const PostureSettings& p = s.config.posture;
  for (const auto& [side, leg] : {std::pair{"_l", p.left_leg}, std::pair{"_r", p.right_leg}}) {
    const Vec3 thigh =
        s.joint(std::string("femur_1") + side) - s.joint(std::string("tibia_1") + side);
    const Vec3 shank =
        s.joint(std::string("tibia_1") + side) - s.joint(std::string("talus") + side);
    EXPECT_NEAR(std::atan2(-thigh.x(), thigh.z()), leg.hip_flexion, 1e-9);
    EXPECT_NEAR(std::atan2(shank.x(), shank.z()), leg.knee_flexion - leg.hip_flexion, 1e-9);
    EXPECT_NEAR(std::asin(-thigh.normalized().y()), leg.thigh_tilt, 1e-9);
    EXPECT_NEAR(std::asin(-shank.normalized().y()), leg.shank_tilt, 1e-9);
  }
}

TEST_P(MeasuredStance, KeepsJointsTogether) {
  const Stance s = stand(GetParam());
  for (std::size_t i = 0; i < s.config.body.segments.size(); ++i) {
    const Segment& child = s.config.body.segments[i];
    if (child.parent < 0) continue;
    const Segment& parent = s.config.body.segments[child.parent];
    const Vec3 a = s.posture.X_WB[i] * Vec3(child.joint_centre - child.com);
    const Vec3 b = s.posture.X_WB[child.parent] * Vec3(child.joint_centre - parent.com);
    EXPECT_LT((a - b).norm(), 1e-12) << child.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, MeasuredStance, testing::Values("v2370", "v2371", "v2374"));

TEST(Posture, StridesMatchAnIndependentComputation) {
  // Ankle to ankle in walking direction, mm, from the same angles and leg lengths.
  for (const auto& [test, stride] :
       {std::pair{"v2370", 193.0}, std::pair{"v2371", 274.0}, std::pair{"v2374", 267.0}}) {
    const Stance s = stand(test);
    EXPECT_NEAR(1e3 * (s.joint("talus_l").x() - s.joint("talus_r").x()), stride, 2.5) << test;
  }
}

TEST(Posture, BoundWristsMeetBeforeTheAbdomen) {
  for (const char* test : {"v2370", "v2371"}) {
    const Stance s = stand(test);
    const Vec3 left = s.joint("hand_l"), right = s.joint("hand_r");
    EXPECT_LT((left - right).norm(), 0.03) << test;
    EXPECT_GT(left.x(), 0.15);
  }
}

TEST(Posture, HeadingTurnsTheWholeStance) {
  const Stance a = stand("v2370"), b = stand("v2370", "[posture]\nheading_deg = 90.0\n");
  const Mat3 R = exp_rotation({0, 0, kPi / 2}).toRotationMatrix();
  const Vec3 hip = a.joint("talus_l") - a.posture.X_WB[0].p;
  EXPECT_LT((R * hip - (b.joint("talus_l") - b.posture.X_WB[0].p)).norm(), 1e-9);
}

TEST(StartPosition, CarStandsItsGapAwayFromTheBody) {
  const MbModel model = build_model(load_config("v2370", RunMode::Multibody));
  const MbState state = initial_state(model);
  double nearest = 1;
  // March the car forward in steps of 10 um until something touches.
  for (double s = 0; s < 5e-3; s += 1e-5) {
    const Pose X_WF = vehicle_pose(model.config.vehicle, {state.vehicle.y + s, 0, 0});
    for (const SurfacePart& part : model.parts) {
      const Pose& X = model.X_WB0[part.segment];
      for (const FrontChain& chain : model.chains) {
        if (overlap_with_front({X * part.p_B, X.R(), part.semi_axes}, model.config.vehicle.front,
                               chain, X_WF)) {
          nearest = std::min(nearest, s);
        }
      }
    }
    if (nearest < 1) break;
  }
  EXPECT_NEAR(nearest, 2e-3, 1.1e-5);
}

}  // namespace
}  // namespace crosswalk::mb
