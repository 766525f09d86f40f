#include "mb_node/posture.h"

#include <cmath>

#include <gtest/gtest.h>

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
