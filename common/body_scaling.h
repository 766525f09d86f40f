// From 35 measures to heights of joints, group masses, and mass properties of sections.
//
// The measured heights are over-determined and contradict each other by up to 40 mm, so the joint
// heights are the weighted least-squares solution of 16 equations (each divided by its sigma). SI.
#pragma once

#include <span>
#include <string_view>
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

/// A measured height against what all other equations say of it: its residual when left out of the
/// least squares, over the standard deviation of that residual (sigma_i / sqrt(1 - leverage_i)).
struct HeightContradiction {
  std::string_view measure;
  double excess = 0;  ///< m, measured less predicted by the others
  double sigmas = 0;  ///< the same, in standard deviations
};
/// Beyond this a set of measures cannot be one person's: the equations' sigmas cover reading errors
/// and people's proportions [E]. The published subjects stay within 2.
inline constexpr double kContradiction = 4;
/// One entry for each height that other equations speak of, too; overrides take no part.
std::vector<HeightContradiction> height_contradictions(const Anthropometry& a);

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
