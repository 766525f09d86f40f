// The stance at the start: joint rotations, pelvis height with both feet on the ground, bound
// wrists.
//
// Legs follow measured segment angles (thigh and shank in side and front view). The pelvis is
// lowered until the first foot touches; the other foot is plantarflexed until it touches too. Bound
// arms are the weighted least-squares solution for shoulder and elbow angles that bring the wrists
// together in front of the abdomen. Markers, where given, turn all joints from there to where they
// were seen (marker_fit.h). W: the pedestrian faces +x at heading 0.
#pragma once

#include <string>
#include <vector>

#include "common/body_description.h"
#include "common/config.h"
#include "common/spatial.h"
#include "mb_node/marker_fit.h"

namespace crosswalk::mb {

enum class Arms { Hanging, Angles, Bound };
enum class Support {
  Harness,  ///< weight carried, feet unloaded, until the car touches
  None      ///< free from t = 0
};

struct LegAngles {
  double hip_flexion = 0, knee_flexion = 0;  ///< rad
  double thigh_tilt = 0, shank_tilt = 0;     ///< rad about +x, frontal plane
};
struct ArmAngles {
  double shoulder_flexion = 0, shoulder_abduction = 0, shoulder_rotation = 0, elbow_flexion = 0;
};

struct PostureSettings {
  LegAngles left_leg, right_leg;
  ArmAngles left_arm, right_arm;
  Arms arms = Arms::Hanging;
  double wrist_forward = 0;                  ///< m in front of the hips, bound arms
  double wrist_height = 0;                   ///< m above the hips as a fraction of stature
  double trunk_flexion = 0, trunk_lean = 0;  ///< rad; lean about +x
  double heading = 0;                        ///< rad about +z; 0: right side to the car
  double walking_speed = 0;                  ///< m/s along the heading
  Vec3 spin = Vec3::Zero();                  ///< rad/s, W: of the whole body about the pelvis
  Support support = Support::Harness;
  std::vector<Marker> markers;  ///< seen points that the angles are fitted to
};

/// One thing the solver was asked for: target and what came out, in SI.
struct PostureResidual {
  std::string what;
  double asked = 0, obtained = 0;
};

struct Posture {
  std::vector<Mat3> joint_rotation;  ///< R_PC of each segment (pelvis: R_W)
  std::vector<Pose> X_WB;            ///< of each segment, origin at its centre of mass
  std::vector<PostureResidual> residuals;
};

PostureSettings read_posture(ConfigTable posture);
Posture solve_posture(const BodyDescription& body, const PostureSettings& settings);

/// Poses of all segments from joint rotations; `pelvis` places the pelvis's centre of mass.
std::vector<Pose> place_segments(const BodyDescription& body, const std::vector<Mat3>& rotations,
                                 const Vec3& pelvis);
/// Height of the lowest point of the segment's ellipsoids.
double lowest_point(const BodyDescription& body, const std::vector<Pose>& X_WB, int segment);

}  // namespace crosswalk::mb
