// From 35 measures to heights of joints, group masses, and mass properties of sections.
//
// The measured heights are over-determined and contradict each other by up to 40 mm, so the joint
// heights are the weighted least-squares solution of 16 equations (each divided by its sigma). SI.
#pragma once

#include <span>
#include <vector>

#include "common/anthropometry.h"
#include "common/body_description.h"
#include "common/formula.h"
#include "common/spatial.h"

namespace crosswalk {

struct HeightOverrides {
  double SJC = 0, C7T1 = 0;      ///< m, 0: none; enter as rows of 1 mm
  double stance_half_width = 0;  ///< m, 0: 0.245 of the hip breadth
};

struct JointHeights {
  double ankle = 0, knee = 0, hip = 0, L5S1 = 0, waist = 0, C7T1 = 0, SJC = 0, OC = 0;
  std::vector<HeightResidual> residuals;
};

JointHeights solve_heights(const Anthropometry& a, const HeightOverrides& overrides = {});

/// Every name that formulas of a subject file may use.
Variables body_variables(const Anthropometry& a, const JointHeights& heights,
                         const HeightOverrides& overrides);

/// Mass properties of unit density: volume, centre, second moments about the centre (diagonal).
struct VolumeProperties {
  double volume = 0;
  Vec3 centre = Vec3::Zero();
  Vec3 moments = Vec3::Zero();
};

/// A vertical limb of circular sections from `top` downwards, cut at s = begin .. end.
VolumeProperties limb_volume(const Vec3& top, double length, const Curve& radius, double begin,
                             double end);
/// A trunk of elliptical sections (semi-axes a along x, b along y, centre x) between two heights.
VolumeProperties trunk_volume(const Curve& a, const Curve& b, const Curve& x, double z_begin,
                              double z_end);

}  // namespace crosswalk
