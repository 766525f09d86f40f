#include "mb_node/joint_law.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "common/units.h"
#include "tests/common/subject_fixture.h"

namespace crosswalk::mb {
namespace {

Mat3 rotation(const Vec3& axis, double angle) {
  return exp_rotation(axis * angle).toRotationMatrix();
}

TEST(JointMotion, CardanAnglesComeBackFromTheRotation) {
  const Vec3 angle(0.4, -0.7, 1.1);
  const Mat3 R_WP = rotation(Vec3(1, 2, 3).normalized(), 0.8);
  const Mat3 R_WC = R_WP * rotation(Vec3::UnitY(), angle[0]) * rotation(Vec3::UnitX(), angle[1]) *
                    rotation(Vec3::UnitZ(), angle[2]);
  const JointMotion motion =
      joint_motion(JointType::Ball, {Coordinates::Cardan}, R_WP, R_WC, Vec3::Zero());
  EXPECT_LT((motion.angle - angle).norm(), 1e-13);
}

TEST(JointMotion, RatesAreTheDerivativesOfTheAngles) {
  const Vec3 w(2, -3, 1.5);
  const double dt = 1e-6;
  struct Case {
    JointType type;
    AngleFrame frame;
    Mat3 R_PC;
    Vec3 w;
  };
  const Mat3 R_WP = rotation(Vec3(1, -2, 0.5).normalized(), 1.3);
  const Mat3 general = rotation(Vec3(0.3, 0.9, -0.2).normalized(), 1.0);
  const Mat3 about = rotation(Vec3(1, -1, 0).normalized(), 1.5);
  const Mat3 hinge_y = rotation(Vec3::UnitY(), -0.9);
  const Mat3 universal = rotation(Vec3::UnitX(), 0.5) * rotation(Vec3::UnitY(), -0.8);
  const Vec3 universal_w = R_WP * (0.7 * Vec3::UnitX() + 1.9 * universal.col(1));
  for (const Case& c : {Case{JointType::Ball, {Coordinates::Cardan}, general, w},
                        Case{JointType::Ball, {Coordinates::SwingTwist}, general, w},
                        Case{JointType::Ball, {Coordinates::SwingTwist, about}, general, w},
                        Case{JointType::Ball, {Coordinates::SwingTwist}, Mat3::Identity(), w},
                        Case{JointType::HingeY, {}, hinge_y, R_WP * Vec3(0, 3, 0)},
                        Case{JointType::UniversalXY, {}, universal, universal_w}}) {
    const Mat3 R_WC = R_WP * c.R_PC;
    const auto at = [&](double t) {
      return joint_motion(c.type, c.frame, R_WP, exp_rotation(c.w * t).toRotationMatrix() * R_WC,
                          c.w);
    };
    const Vec3 slope = (at(dt).angle - at(-dt).angle) / (2 * dt);
    EXPECT_LT((at(0).rate - slope).norm(), 1e-6) << static_cast<int>(c.type);
  }
}

TEST(JointMotion, GeneralisedMomentsAndTorqueHaveTheSamePower) {
  const Mat3 R_WP = rotation(Vec3(1, 1, 0).normalized(), 0.4);
  const Mat3 R_WC = R_WP * rotation(Vec3(0.1, 0.7, 0.2).normalized(), 0.9);
  const Vec3 w(1, 2, -3), M(10, -20, 5);
  for (const Coordinates c : {Coordinates::Cardan, Coordinates::SwingTwist}) {
    const JointMotion motion = joint_motion(JointType::Ball, {c}, R_WP, R_WC, w);
    EXPECT_NEAR((motion.dual * M).dot(w), M.dot(motion.rate), 1e-12);
  }
}

TEST(Stop, CycleLosesTheStatedPartOfTheEnergy) {
  // Linear stop: loss 1 - 2 * 0.7 / 2.5 = 44 %; quadratic: 1 - 3 * 0.7 / 2.5 = 16 %.
  struct Case {
    StopLaw law;
    double loss;
  };
  for (const Case& c : {Case{{600, 0}, 1 - 2 * 0.7 / 2.5}, Case{{0, 3000}, 1 - 3 * 0.7 / 2.5}}) {
    StopHistory history;
    const int n = 20000;
    const double deepest = 0.3;
    double up = 0, down = 0;
    for (int i = 0; i < n; ++i) up += stop_moment(c.law, deepest * (i + 0.5) / n, history);
    for (int i = n; i-- > 0;) down += stop_moment(c.law, deepest * (i + 0.5) / n, history);
    EXPECT_NEAR(1 - down / up, c.loss, 1e-3);
    EXPECT_NEAR(stop_energy(c.law, history.deepest, history), down * deepest / n,
                1e-3 * down * deepest / n);
  }
}

TEST(Stop, EnergyOfAFirstTouchIsWhatUnloadingGivesBack) {
  const StopHistory untouched;  // the moment has not been asked for yet
  EXPECT_NEAR(stop_energy({600, 0}, 0.01, untouched), 600 * 0.01 * 0.7 * 0.01 / 2.5, 1e-12);
}

TEST(Ligament, IsElasticUntilItTearsAndThenUnloadsSteeply) {
  const BodyDescription body = load_subject("male_50");
  const LigamentLaw& law =
      body.segments[body.find_segment("tibia_1_r")].restraint.angle[1].ligament;
  LigamentHistory history;
  EXPECT_NEAR(ligament_moment(law, -12 * kDegree, history), -128, 1e-9);
  EXPECT_NEAR(ligament_moment(law, -5 * kDegree, history), -45, 1e-9);  // back on the curve
  EXPECT_FALSE(history.is_torn);
  EXPECT_NEAR(ligament_moment(law, 20 * kDegree, history), 80, 1e-9);
  EXPECT_TRUE(history.is_torn);
  EXPECT_NEAR(ligament_moment(law, 15 * kDegree, history), 80 - 5 * 9, 1e-9);
  EXPECT_NEAR(ligament_moment(law, 5 * kDegree, history), 0, 1e-9);
  LigamentHistory whole;
  const LigamentLaw intact = without_failure(law);
  EXPECT_NEAR(ligament_moment(intact, 22 * kDegree, whole), 128 + 10 * 11.5, 1e-9);
  EXPECT_FALSE(whole.is_torn);
}

TEST(Bone, BreaksOnceAtItsMoment) {
  const BodyDescription body = load_subject("male_50");
  const BoneLaw& law = body.segments[body.find_segment("tibia_3_l")].restraint.bone;
  EXPECT_EQ(law.bone, "tibia_l");
  BoneHistory history;
  const double limit = 310.0 / 2300.0;
  EXPECT_NEAR(
      bone_moment(law, {0.6 * limit, 0.79 * limit, 0}, Vec3::Zero(), true, history).total().norm(),
      310 * std::hypot(0.6, 0.79), 0.1);
  EXPECT_FALSE(history.is_broken);
  bone_moment(law, {1.01 * limit, 0, 0}, Vec3::Zero(), false, history);
  EXPECT_FALSE(history.is_broken) << "another fracture of this bone came first";
  const BoneMoment after = bone_moment(law, {1.01 * limit, 0, 0}, Vec3::Zero(), true, history);
  EXPECT_TRUE(history.is_broken);
  EXPECT_NEAR(after.total()[0], -0.02 * 1.01 * 310, 0.05);
}

TEST(Bone, BrokenFoldsPastARightAngleWithoutAJumpOfTheMoment) {
  // Lateral fold of a tumbling leg: Cardan angles end at 90 deg, where a moment over their rates
  // grows without bound.
  const BodyDescription body = load_subject("male_50");
  const JointRestraint& restraint = body.segments[body.find_segment("tibia_3_l")].restraint;
  BoneHistory history{true};
  const Vec3 w(3, 2, -1);
  Vec3 before = Vec3::Zero();
  for (double fold = 80; fold <= 110; fold += 0.5) {
    const JointMotion motion = joint_motion(JointType::Ball, restraint.frame, Mat3::Identity(),
                                            rotation(Vec3::UnitX(), fold * kDegree), w);
    const Vec3 torque =
        motion.dual *
        bone_moment(restraint.bone, motion.angle, motion.rate, false, history).total();
    EXPECT_LT(torque.norm(), 400) << fold;
    if (fold > 80) {
      EXPECT_LT((torque - before).norm(), 10) << fold;
    }
    before = torque;
  }
}

/// Moment on a resting left or right upper arm turned from hanging by `angle` about `axis`.
Vec3 shoulder_moment(const Segment& arm, const Vec3& axis, double angle, const Vec3& w) {
  const JointMotion motion = joint_motion(JointType::Ball, arm.restraint.frame, Mat3::Identity(),
                                          rotation(axis, angle), w);
  const JointMotion hanging = joint_motion(JointType::Ball, arm.restraint.frame, Mat3::Identity(),
                                           Mat3::Identity(), Vec3::Zero());
  Vec3 moments;
  for (int k = 0; k < 3; ++k) {
    CoordinateHistory history;
    CoordinateInput input;
    input.initial = hanging.angle[k];
    moments[k] =
        restraint_moment(arm.restraint.angle[k], input, motion.angle[k], motion.rate[k], history)
            .total();
  }
  return motion.dual * moments;
}

TEST(Shoulder, SwingsOverheadWithoutAJumpOfTheMoment) {
  // Counted from a hanging arm, swing and twist end where the arm points straight up.
  const BodyDescription body = load_subject("male_50");
  const Segment& arm = body.segments[body.find_segment("upper_arm_l")];
  const Vec3 w(3, 2, -1);
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(1, -1, 0).normalized()}) {
    Vec3 before = shoulder_moment(arm, axis, 150 * kDegree, w);
    for (double angle = 150.5; angle <= 195; angle += 0.5) {
      const Vec3 now = shoulder_moment(arm, axis, angle * kDegree, w);
      EXPECT_LT((now - before).norm(), 6) << axis.transpose() << ": " << angle;
      before = now;
    }
  }
}

TEST(Shoulder, PushesBackPastTheEndsOfItsReachOnEitherSide) {
  // N m against the motion, stops only: the spring about the hanging arm gives 3 N m/rad.
  const BodyDescription body = load_subject("male_50");
  struct Case {
    Vec3 axis;
    double free, held;  // degrees
  };
  for (const int side : {1, -1}) {
    const Segment& arm = body.segments[body.find_segment(side > 0 ? "upper_arm_l" : "upper_arm_r")];
    for (const Case& c : {Case{{0, 1, 0}, 44, 75}, Case{{0, -1, 0}, 155, 200},
                          Case{{1.0 * side, 0, 0}, 145, 215}, Case{{-1.0 * side, 0, 0}, 18, 45}}) {
      const auto against = [&](double angle) {
        return -shoulder_moment(arm, c.axis, angle * kDegree, Vec3::Zero()).dot(c.axis);
      };
      EXPECT_LT(against(c.free), 12) << side << ": " << c.axis.transpose();
      EXPECT_GT(against(c.held), 25) << side << ": " << c.axis.transpose();
    }
  }
}

TEST(PassiveMoments, MatchThePublishedCurves) {
  // N m, evaluated independently from the coefficients of [riener1999].
  const double deg = kDegree;
  const double hip_angles[] = {-20, 0, 20, 45, 60, 90, 110};
  const double hip[] = {24.9, 9.7, 4.5, -1.4, -7.0, -29.8, -61.6};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(passive_hip(hip_angles[i] * deg, 20 * deg), hip[i], 0.06);
  const double knee_angles[] = {0, 10, 20, 45, 90, 130, 140};
  const double knee[] = {10.4, 1.5, -1.4, -3.7, -6.2, -16.5, -24.1};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(passive_knee(0, knee_angles[i] * deg, 0), knee[i], 0.06);
  const double ankle_angles[] = {-50, -30, -10, 0, 10, 20, 30};
  const double ankle[] = {7.6, 1.4, -1.2, -5.1, -14.1, -35.2, -84.2};
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(passive_ankle(10 * deg, ankle_angles[i] * deg), ankle[i], 0.06);
  }
}

TEST(Neck, BendsWithinThePublishedFlexionCorridor) {
  // Sum of the three joints' angles at a moment; corridor of [mertz1989] scaled by 190/258 to the
  // 50th percentile: at 88 N m 64-73 deg, at 190 N m 68-77 deg; at 27 N m at most 53 deg.
  const BodyDescription body = load_subject("male_50");
  const auto angle_at = [&](double moment) {
    double sum = 0;
    for (const char* name : {"neck_low", "neck_up", "head"}) {
      const CoordinateLaw& law = body.segments[body.find_segment(name)].restraint.angle[0];
      double low = 0, high = 3;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        CoordinateHistory fresh;
        (-restraint_moment(law, {}, middle, 0, fresh).total() < moment ? low : high) = middle;
      }
      sum += low / kDegree;
    }
    return sum;
  };
  // The stops alone leave 45 deg free; 27 N m bends a degree and a half past 53 deg.
  EXPECT_NEAR(angle_at(27), 54.6, 0.3);
  EXPECT_GT(angle_at(88), 64);
  EXPECT_LT(angle_at(88), 73);
  EXPECT_GT(angle_at(190), 68);
  EXPECT_LT(angle_at(190), 77);
}

}  // namespace
}  // namespace crosswalk::mb
