// A rigid skull turned about an axis through a fixed point: loading and brain response.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fe_node/validate/deck_case.h"
#include "fe_node/validate/head_draft.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {

struct Rotation {
  int axis = 1;                         ///< 0 coronal, 1 sagittal, 2 axial
  Vec3 pivot = Vec3::Zero();            ///< draft coordinates, m
  std::function<double(double)> speed;  ///< rad/s over time
  double end = 0.06;                    ///< s
};

/// Angular speed that rises as half a sine of acceleration to `peak` in `rise`, then holds.
std::function<double(double)> ramp_and_hold(double peak, double rise);
/// Half a sine of angular acceleration up to `peak` in `rise`, then the same down to rest.
std::function<double(double)> up_and_down(double peak, double rise);

struct BrainResponse {
  std::vector<double> time;                     ///< s
  std::vector<std::vector<Vec3>> displacement;  ///< per point, relative to the skull, skull axes
  std::vector<double> mps_95;                   ///< present 95th percentile, Green-Lagrange
  double mps_95_peak = 0;  ///< 95th percentile of each element's largest Green-Lagrange strain
  double mps_50_peak = 0;
  double csdm_15 = 0, csdm_25 = 0;
  double hourglass_share = 0;  ///< of the internal energy, at the end
  double balance = 0;
};

/// `points` in draft coordinates.
BrainResponse turn_skull(const generate::HeadNeck& whole, const Rotation& rotation,
                         const std::vector<Vec3>& points, const CaseContext& context,
                         const std::string& sub_folder);

/// DAMAGE of a rotation about one axis [gabler2019], by the exact solution of its oscillator for
/// speeds that change linearly over short steps.
double damage_of(const Rotation& rotation);

}  // namespace crosswalk::fe::validate
