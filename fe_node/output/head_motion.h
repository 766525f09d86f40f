// The motion of a rigid-looking group of nodes, such as the skull: least-squares rigid fit, told at
// a point of that body (the head's centre of mass).
#pragma once

#include <vector>

#include "common/exchange.h"
#include "fe_node/model.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

class HeadMotion {
 public:
  HeadMotion() = default;
  /// `X_DH`: the reported point and axes in the deck's frame.
  HeadMotion(const Model& model, std::vector<int> nodes, const Pose& X_DH);

  /// Acceleration is the mean over `interval` since the twist `before`.
  HeadSample sample(const State& state, std::int64_t t_ns, const Twist& before,
                    double interval) const;
  Twist twist(const State& state) const;
  const Pose& frame() const { return X_DH_; }

 private:
  struct Fit {
    Pose X_WH;
    Twist V_WH;
  };
  Fit fit(const State& state) const;

  std::vector<int> nodes_;
  std::vector<Vec3> reference_;
  std::vector<double> weight_;
  Pose X_DH_;
};

/// Mass, centre and inertia of the elements and rigid parts of these parts and of point masses on
/// their nodes; deck frame, undeformed.
Inertia inertia_of_parts(const Model& model, const std::vector<int>& parts);

}  // namespace crosswalk::fe
