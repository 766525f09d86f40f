// Piecewise-linear curve evaluated without branches, all lanes at once: value, slope and integral.
// Left of its first point and right of its last it goes on with the first and last slope.
#pragma once

#include <span>
#include <vector>

#include "fe_node/material/lanes.h"

namespace crosswalk::fe {

class LaneCurve {
 public:
  LaneCurve() = default;
  /// x strictly rising. A single point is a constant. `last_slope_floor` bounds the slope that
  /// continues the curve. Throws std::invalid_argument.
  LaneCurve(std::span<const double> x, std::span<const double> y, double last_slope_floor = -1e300);

  template <class N>
  void evaluate(const N& x, N& value, N& slope) const {
    value = y_[0] + slope_[0] * (x - x_[0]);
    slope = constant<N>(slope_[0]);
    for (std::size_t k = 1; k < x_.size(); ++k) {
      const N break_point = constant<N>(x_[k]);
      value = where_less(x, break_point, value, N(y_[k] + slope_[k] * (x - break_point)));
      slope = where_less(x, break_point, slope, constant<N>(slope_[k]));
    }
  }
  /// From the first point to x.
  template <class N>
  N integral(const N& x) const {
    N d = x - x_[0];
    N sum = d * (y_[0] + 0.5 * slope_[0] * d);
    for (std::size_t k = 1; k < x_.size(); ++k) {
      d = x - x_[k];
      sum = where_less(x, constant<N>(x_[k]), sum,
                       N(integral_[k] + d * (y_[k] + 0.5 * slope_[k] * d)));
    }
    return sum;
  }
  bool empty() const { return x_.empty(); }
  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }
  double first_slope() const { return slope_.front(); }

 private:
  std::vector<double> x_, y_, slope_, integral_;
};

}  // namespace crosswalk::fe
