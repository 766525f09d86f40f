// x = G(x) by fixed-point iteration with Anderson acceleration, on SUNDIALS KINSOL.
#pragma once

#include <functional>

#include <Eigen/Dense>

namespace crosswalk::coupling {

struct FixedPointSettings {
  double tolerance = 1e-4;
  int max_iterations = 20;  ///< evaluations of G
  int anderson_depth = 5;
};

struct FixedPoint {
  Eigen::VectorXd x;    ///< argument of the last evaluation
  double residual = 0;  ///< max |G(x) - x| / scale of the last evaluation
  int evaluations = 0;
};

/// `scale` holds the size of one unit of each unknown, all > 0. What G throws comes out here.
FixedPoint solve_fixed_point(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& G,
                             const Eigen::VectorXd& start, const Eigen::VectorXd& scale,
                             const FixedPointSettings& settings);

/// Size of the wrenches in x (forces and moments in turn of three): per body max(1 N, |force|) and
/// max(0.05 N m, |moment|).
Eigen::VectorXd wrench_scale(const Eigen::VectorXd& x);

}  // namespace crosswalk::coupling
