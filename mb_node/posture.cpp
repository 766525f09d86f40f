#include "mb_node/posture.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "common/error.h"
#include "common/units.h"

namespace crosswalk::mb {
namespace {

constexpr double kSoleDepth = 1.5e-3;      // m into the ground: carries part of the weight [E]
constexpr double kFeetUnderGround = 0.03;  // m: more is no error of the markers [E]
constexpr double kBuried = 1e-3;           // m deeper than the soles: the stance is refused [E]
constexpr double kPlantarflexionMax = 35 * kDegree;   // [E]
constexpr double kForearmInclination = 45 * kDegree;  // hands crossed before the abdomen [E]

Mat3 about(int axis, double angle) {
  return exp_rotation(Vec3::Unit(axis) * angle).toRotationMatrix();
}

const std::vector<std::string> kFoot = {"talus", "hindfoot", "forefoot", "toes"};

class Solver {
 public:
  Solver(const BodyDescription& body, const PostureSettings& settings)
      : body_(body), settings_(settings), rotations_(body.segments.size(), Mat3::Identity()) {}

  Posture solve() {
    rotations_[0] = about(2, settings_.heading) * about(0, settings_.trunk_lean) *
                    about(1, settings_.trunk_flexion);
    leg("_l", settings_.left_leg);
    leg("_r", settings_.right_leg);
    arm("_l", settings_.left_arm, 1);
    arm("_r", settings_.right_arm, -1);
    if (settings_.arms == Arms::Bound) {
      bind("_l", settings_.left_arm, 1);
      bind("_r", settings_.right_arm, -1);
    }
    stand();
    if (!settings_.markers.empty()) follow_markers();
    return {rotations_, place(), residuals_};
  }

 private:
  Mat3* rotation(const std::string& name) {
    const int i = body_.find_segment(name);
    return i >= 0 ? &rotations_[i] : nullptr;
  }
  std::vector<Pose> place() const { return place_segments(body_, rotations_, pelvis_); }

  void leg(const std::string& side, const LegAngles& a) {
    Mat3* hip = rotation("femur_1" + side);
    Mat3* knee = rotation("tibia_1" + side);
    if (hip == nullptr || knee == nullptr) return;
    // Thigh and shank against the vertical; the pelvis may lean.
    const Mat3 heading = about(2, settings_.heading);
    const Mat3 R_thigh = heading * about(1, -a.hip_flexion) * about(0, a.thigh_tilt);
    const Mat3 R_shank =
        heading * about(1, a.knee_flexion - a.hip_flexion) * about(0, a.shank_tilt);
    *hip = rotations_[0].transpose() * R_thigh;
    *knee = R_thigh.transpose() * R_shank;
    level_foot(side, R_shank, 0);
  }

  /// Sole level (Ry(talus) Rx(subtalar) undoes the shank's tilt), then `plantarflexion` more.
  void level_foot(const std::string& side, const Mat3& R_shank, double plantarflexion) {
    const Vec3 up = R_shank.transpose() * Vec3::UnitZ();
    *rotation("talus" + side) = about(1, std::atan2(up.x(), up.z()) + plantarflexion);
    *rotation("hindfoot" + side) = about(0, -std::asin(up.y()));
  }

  void arm(const std::string& side, const ArmAngles& a, int sign) {
    if (settings_.arms == Arms::Hanging) return;
    if (Mat3* shoulder = rotation("upper_arm" + side)) {
      *shoulder = about(1, -a.shoulder_flexion) * about(0, sign * a.shoulder_abduction) *
                  about(2, -sign * a.shoulder_rotation);
    }
    if (Mat3* elbow = rotation("forearm_prox" + side)) *elbow = about(1, -a.elbow_flexion);
  }

  /// The end that is bound: the wrist, or the end of the stump.
  Vec3 bound_point(const std::vector<Pose>& X_WB, const std::string& side) const {
    const int hand = body_.find_segment("hand" + side);
    const int last = body_.find_segment(hand >= 0 ? "forearm_dist" + side : "forearm_prox" + side);
    const int elbow = body_.find_segment("forearm_prox" + side);
    const Segment& segment = body_.segments[last];
    Vec3 end = hand >= 0 ? body_.segments[hand].joint_centre
                         : Vec3(2 * segment.com - body_.segments[elbow].joint_centre);
    return X_WB[last] * Vec3(end - segment.com);
  }

  void bind(const std::string& side, ArmAngles a, int sign) {
    const double stature = body_.measures.standing_height;
    const int pelvis = 0, forearm = body_.find_segment("forearm_prox" + side);
    const bool has_hand = body_.find_segment("hand" + side) >= 0;
    const Vec3 hips = body_.segments[body_.find_segment("femur_1_l")].joint_centre;
    // Unknowns: rotation, elbow, abduction. Each residual over its tolerance [E].
    const auto residual = [&](const Eigen::Vector3d& u) {
      ArmAngles trial = a;
      trial.shoulder_rotation = u[0];
      trial.elbow_flexion = u[1];
      trial.shoulder_abduction = u[2];
      arm(side, trial, sign);
      const std::vector<Pose> X_WB = place();
      const Pose X_PW = X_WB[pelvis].inverse();
      const Vec3 end = X_PW * bound_point(X_WB, side) + body_.segments[pelvis].com - hips;
      const Vec3 along = (X_PW.q * X_WB[forearm].q) * -Vec3::UnitZ();
      Eigen::VectorXd r(8);
      r[0] = (end.y() + hips.y()) / 5e-3;
      r[1] = has_hand ? (end.x() - settings_.wrist_forward) / 50e-3 : 0;
      r[2] = has_hand ? (end.z() - settings_.wrist_height * stature) / 50e-3 : 0;
      r[3] = has_hand ? (std::asin(std::clamp(along.z(), -1.0, 1.0)) - kForearmInclination) /
                            (10 * kDegree)
                      : 0;
      r[4] = (u[2] - a.shoulder_abduction) / (10 * kDegree);
      r[5] = std::max(0.0, std::abs(u[0]) - 85 * kDegree) / (1 * kDegree);
      r[6] = std::max(0.0, -u[1]) / (1 * kDegree);
      r[7] = std::max(0.0, u[1] - 145 * kDegree) / (1 * kDegree);
      return r;
    };
    const Eigen::Vector3d u =
        levenberg_marquardt(residual, {80 * kDegree, 80 * kDegree, a.shoulder_abduction});
    residual(u);  // leaves the arm in the solution
    const std::vector<Pose> X_WB = place();
    const Vec3 end = X_WB[pelvis].inverse() * bound_point(X_WB, side) + body_.segments[pelvis].com;
    residuals_.push_back({"bound end" + side + ": sideways (m)", 0, end.y()});
    residuals_.push_back({"bound end" + side + ": in front of the hips (m)",
                          settings_.wrist_forward, end.x() - hips.x()});
    residuals_.push_back({"bound end" + side + ": above the hips (m)",
                          settings_.wrist_height * stature, end.z() - hips.z()});
  }

  static Eigen::Vector3d levenberg_marquardt(
      const std::function<Eigen::VectorXd(const Eigen::Vector3d&)>& residual, Eigen::Vector3d u) {
    double damping = 1e-3;
    Eigen::VectorXd r = residual(u);
    for (int i = 0; i < 200; ++i) {
      constexpr double kStep = 1e-6;
      Eigen::MatrixXd J(r.size(), 3);
      for (int k = 0; k < 3; ++k) {
        J.col(k) = (residual(u + kStep * Eigen::Vector3d::Unit(k)) -
                    residual(u - kStep * Eigen::Vector3d::Unit(k))) /
                   (2 * kStep);
      }
      const Eigen::Matrix3d normal = J.transpose() * J;
      const Eigen::Vector3d step =
          -(normal + damping * Eigen::Matrix3d(normal.diagonal().asDiagonal()) +
            1e-9 * Eigen::Matrix3d::Identity())
               .ldlt()
               .solve(J.transpose() * r);
      const Eigen::VectorXd trial = residual(u + step);
      if (trial.squaredNorm() < r.squaredNorm()) {
        u += step;
        r = trial;
        damping = std::max(1e-9, damping / 4);
        if (step.norm() < 1e-9) break;
      } else {
        damping *= 4;
        if (damping > 1e9) break;
      }
    }
    return u;
  }

  double lowest_of_foot(const std::string& side) const {
    const std::vector<Pose> X_WB = place();
    double lowest = std::numeric_limits<double>::infinity();
    for (const std::string& part : kFoot) {
      lowest = std::min(lowest, lowest_point(body_, X_WB, body_.find_segment(part + side)));
    }
    return lowest;
  }

  void stand() {
    pelvis_ = body_.segments[0].com;
    const double left = lowest_of_foot("_l"), right = lowest_of_foot("_r");
    pelvis_.z() -= std::min(left, right) + kSoleDepth;
    const std::string floating = left > right ? "_l" : "_r";
    const int shank = body_.find_segment("tibia_5" + floating);
    const Mat3 R_shank = place()[shank].R();
    double low = 0, high = kPlantarflexionMax;
    level_foot(floating, R_shank, high);
    if (lowest_of_foot(floating) <= -kSoleDepth) {
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        level_foot(floating, R_shank, middle);
        (lowest_of_foot(floating) > -kSoleDepth ? low : high) = middle;
      }
      level_foot(floating, R_shank, high);
    } else {  // a swinging leg: the foot stays level in the air
      high = 0;
      level_foot(floating, R_shank, 0);
    }
    refuse_buried();
    residuals_.push_back({"plantarflexion of the trailing foot" + floating + " (rad)", 0, high});
    residuals_.push_back({"lowest point of the left foot (m)", -kSoleDepth, lowest_of_foot("_l")});
    residuals_.push_back({"lowest point of the right foot (m)", -kSoleDepth, lowest_of_foot("_r")});
  }

  /// Joints and place as the markers say; the height stays that of the feet on the ground.
  void follow_markers() {
    const MarkerFit fit = fit_markers(body_, settings_.markers, rotations_, pelvis_);
    rotations_ = fit.joint_rotation;
    pelvis_ = fit.pelvis;
    const double raised = -kSoleDepth - std::min(lowest_of_foot("_l"), lowest_of_foot("_r"));
    if (raised > kFeetUnderGround) {
      throw UserError({{},
                       "posture.marker",
                       "feet on the ground",
                       fmt::format("feet {:.1f} mm below it", 1e3 * (raised + kSoleDepth)),
                       "check position_mm: heights count from the ground"});
    }
    pelvis_.z() += raised;
    refuse_buried();
    for (std::size_t i = 0; i < settings_.markers.size(); ++i) {
      residuals_.push_back({"marker " + settings_.markers[i].name + ": distance (m)", 0,
                            (fit.miss[i] + Vec3(0, 0, raised)).norm()});
    }
    residuals_.push_back({"raised until the feet touch, after the markers (m)", 0, raised});
  }

  /// Knees, hands or trunk deeper in the ground than the soles.
  void refuse_buried() const {
    const std::vector<Pose> X_WB = place();
    for (int i = 0; i < static_cast<int>(body_.segments.size()); ++i) {
      const double lowest = lowest_point(body_, X_WB, i);
      if (lowest >= -kSoleDepth - kBuried) continue;
      throw UserError({{},
                       "posture",
                       fmt::format("a stance with {} above the ground", body_.segments[i].name),
                       fmt::format("{:.1f} mm below it", -1e3 * lowest),
                       "bend hips and knees less"});
    }
  }

  const BodyDescription& body_;
  const PostureSettings& settings_;
  std::vector<Mat3> rotations_;
  Vec3 pelvis_ = Vec3::Zero();
  std::vector<PostureResidual> residuals_;
};

LegAngles read_leg(ConfigTable& table, const std::string& side) {
  constexpr Range kHip{-40 * kDegree, 120 * kDegree}, kKnee{0, 140 * kDegree};
  constexpr Range kTilt{-25 * kDegree, 25 * kDegree};
  LegAngles leg;
  leg.hip_flexion = table.quantity_or(side + "_hip_flexion", Dimension::Angle, kHip, 0,
                                      "thigh forward of the vertical, side view");
  leg.knee_flexion =
      table.quantity_or(side + "_knee_flexion", Dimension::Angle, kKnee, 0, "knee flexion");
  leg.thigh_tilt = table.quantity_or(side + "_thigh_tilt", Dimension::Angle, kTilt, 0,
                                     "frontal tilt of the thigh about +x");
  leg.shank_tilt = table.quantity_or(side + "_shank_tilt", Dimension::Angle, kTilt, 0,
                                     "frontal tilt of the shank about +x");
  return leg;
}

ArmAngles read_arm(ConfigTable& table, const std::string& side) {
  constexpr Range kFlexion{-60 * kDegree, 180 * kDegree}, kAbduction{-20 * kDegree, 150 * kDegree};
  constexpr Range kRotation{-90 * kDegree, 90 * kDegree}, kElbow{0, 150 * kDegree};
  ArmAngles arm;
  arm.shoulder_flexion = table.quantity_or(side + "_shoulder_flexion", Dimension::Angle, kFlexion,
                                           0, "upper arm forward of the trunk");
  arm.shoulder_abduction = table.quantity_or(side + "_shoulder_abduction", Dimension::Angle,
                                             kAbduction, 0, "upper arm away from the trunk");
  arm.shoulder_rotation =
      table.quantity_or(side + "_shoulder_rotation", Dimension::Angle, kRotation, 0,
                        "internal rotation of the upper arm; found by the solver when bound");
  arm.elbow_flexion = table.quantity_or(side + "_elbow_flexion", Dimension::Angle, kElbow, 0,
                                        "elbow flexion; found by the solver when bound");
  return arm;
}

/// Legs and arms of a walker: the right leg at `phase` percent of its stride, the left half a
/// stride on.
void read_gait(ConfigTable& posture, PostureSettings& s) {
  if (!posture.has("gait")) {
    if (posture.has("gait_phase")) {
      posture.problem("gait_phase", "a [posture.gait] table with the angles of the stride", "none",
                      "write `base = \"../postures/walking.toml\"`");
    }
    posture.quantity_or(
        "gait_phase", Dimension::None, {0, 100}, 0,
        "percent of the right leg's stride, heel contact at 0; needs [posture.gait]");
    return;
  }
  ConfigTable gait = posture.table("gait", "joint angles over one stride");
  const auto curve = [&](const char* name, const char* doc) {
    return gait.curve(name, Dimension::None, Dimension::Angle, Curve::Outside::Hold, doc);
  };
  const Curve hip = curve("hip_flexion", "against percent of the stride");
  const Curve knee = curve("knee_flexion", "against percent of the stride");
  const Curve shoulder = curve("shoulder_flexion", "against percent of the same side's stride");
  const double phase = posture.quantity(
      "gait_phase", Dimension::None, {0, 100},
      "percent of the right leg's stride, heel contact at 0; needs [posture.gait]");
  const double other = std::fmod(phase + 50, 100);
  s.right_leg.hip_flexion = hip.value(phase);
  s.right_leg.knee_flexion = knee.value(phase);
  s.left_leg.hip_flexion = hip.value(other);
  s.left_leg.knee_flexion = knee.value(other);
  s.right_arm.shoulder_flexion = shoulder.value(phase);
  s.left_arm.shoulder_flexion = shoulder.value(other);
  for (ArmAngles* arm : {&s.right_arm, &s.left_arm}) {
    arm->shoulder_abduction =
        std::max(arm->shoulder_abduction, 10 * kDegree);              // clear of the hips [E]
    arm->elbow_flexion = std::max(arm->elbow_flexion, 20 * kDegree);  // [E]
  }
  s.arms = Arms::Angles;
}

}  // namespace

PostureSettings read_posture(ConfigTable posture) {
  constexpr Range kLean{-45 * kDegree, 45 * kDegree};
  PostureSettings s;
  s.left_leg = read_leg(posture, "left");
  s.right_leg = read_leg(posture, "right");
  s.left_arm = read_arm(posture, "left");
  s.right_arm = read_arm(posture, "right");
  const std::string arms =
      posture.choice_or("arms", {"hanging", "angles", "bound"}, "hanging",
                        "hanging: straight down; angles: as given; bound: wrists "
                        "together in front of the abdomen");
  s.arms = arms == "bound" ? Arms::Bound : arms == "angles" ? Arms::Angles : Arms::Hanging;
  s.wrist_forward = posture.quantity_or("wrist_forward", Dimension::Length, {0, 0.6}, 0.22,
                                        "bound wrists in front of the hips");
  s.wrist_height = posture.quantity_or("wrist_height_per_stature", Dimension::None, {-0.2, 0.4},
                                       0.08, "bound wrists above the hips, over stature");
  s.trunk_flexion = posture.quantity_or("trunk_flexion", Dimension::Angle, kLean, 0,
                                        "pelvis and trunk forward of the vertical");
  s.trunk_lean = posture.quantity_or("trunk_lean", Dimension::Angle, kLean, 0,
                                     "pelvis and trunk sideways, about +x");
  s.heading = posture.quantity_or("heading", Dimension::Angle, {-kPi, kPi}, 0,
                                  "facing direction about +z; 0: right side to the car");
  s.walking_speed = posture.quantity_or("walking_speed", Dimension::Speed, {0, 5}, 0,
                                        "initial velocity along the heading");
  constexpr Range kSpin{-20, 20};
  s.spin.x() =
      posture.quantity_or("spin_x", Dimension::AngularSpeed, kSpin, 0,
                          "initial turning of the whole body as one piece about the pelvis's "
                          "centre of mass, about +x (forward at heading 0)");
  s.spin.y() = posture.quantity_or("spin_y", Dimension::AngularSpeed, kSpin, 0,
                                   "the same about +y (to the left): positive falls forward");
  s.spin.z() = posture.quantity_or("spin_z", Dimension::AngularSpeed, kSpin, 0,
                                   "the same about +z (upwards): positive turns to the left");
  s.support = posture.choice_or("support", {"harness", "none"}, "harness",
                                "harness: the weight is carried until the car touches") == "none"
                  ? Support::None
                  : Support::Harness;
  read_gait(posture, s);
  s.markers = read_markers(posture);
  return s;
}

std::vector<Pose> place_segments(const BodyDescription& body, const std::vector<Mat3>& rotations,
                                 const Vec3& pelvis) {
  std::vector<Pose> X_WB(body.segments.size());
  for (std::size_t i = 0; i < body.segments.size(); ++i) {
    const Segment& segment = body.segments[i];
    if (segment.parent < 0) {
      X_WB[i] = {Quat(rotations[i]), pelvis};
      continue;
    }
    const Pose& X_WP = X_WB[segment.parent];
    const Vec3 joint = X_WP * Vec3(segment.joint_centre - body.segments[segment.parent].com);
    X_WB[i].q = (X_WP.q * Quat(rotations[i])).normalized();
    X_WB[i].p = joint + X_WB[i].q * Vec3(segment.com - segment.joint_centre);
  }
  return X_WB;
}

double lowest_point(const BodyDescription& body, const std::vector<Pose>& X_WB, int segment) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const SurfaceEllipsoid& e : body.ellipsoids) {
    if (e.segment != segment) continue;
    const Vec3 up = X_WB[segment].q.conjugate() * Vec3::UnitZ();
    const Vec3 centre = X_WB[segment] * Vec3(e.centre - body.segments[segment].com);
    lowest = std::min(lowest, centre.z() - e.semi_axes.cwiseProduct(up).norm());
  }
  return lowest;
}

Posture solve_posture(const BodyDescription& body, const PostureSettings& settings) {
  return Solver(body, settings).solve();
}

}  // namespace crosswalk::mb
