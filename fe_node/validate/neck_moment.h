// Slow turning of one body of the neck: moment against angle.
#pragma once

#include <filesystem>
#include <vector>

#include "fe_node/validate/neck_draft.h"

namespace crosswalk::fe::validate {

struct Turning {
  int part = 0;           ///< turned about one global axis, free otherwise: a pure moment
  std::vector<int> held;  ///< parts that do not move
  int axis = 1;           ///< 0 x, 1 y, 2 z
  double sense = 1;
  double rate = 4;         ///< rad/s
  double last_moment = 1;  ///< N m, where it ends
  double last_angle = 2;   ///< rad, or there
};

struct MomentSample {
  double turned = 0, moment = 0;  ///< rad, N m
  std::vector<double> levels;     ///< rad, in the sense of turning
  std::array<double, kBearers> energy{};
};

/// Moment = work done on the body per angle turned, less what damping and motion take.
std::vector<MomentSample> turn_slowly(const generate::ModelDraft& draft, const Turning& turning,
                                      const std::filesystem::path& folder,
                                      const Computing& computing);

/// The state at a moment, between the samples about it; empty levels when it was not reached.
MomentSample at_moment(const std::vector<MomentSample>& samples, double moment);

}  // namespace crosswalk::fe::validate
