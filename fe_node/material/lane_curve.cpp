#include "fe_node/material/lane_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crosswalk::fe {

LaneCurve::LaneCurve(std::span<const double> x, std::span<const double> y, double last_slope_floor)
    : x_(x.begin(), x.end()), y_(y.begin(), y.end()) {
  if (x_.empty() || x_.size() != y_.size())
    throw std::invalid_argument("a curve needs as many ordinates as abscissas, and at least one");
  for (std::size_t k = 0; k < x_.size(); ++k)
    if (!std::isfinite(x_[k]) || !std::isfinite(y_[k]) || (k > 0 && !(x_[k] > x_[k - 1])))
      throw std::invalid_argument("the abscissas of a curve must rise and all values be finite");
  integral_.push_back(0);
  for (std::size_t k = 0; k + 1 < x_.size(); ++k) {
    const double width = x_[k + 1] - x_[k];
    slope_.push_back((y_[k + 1] - y_[k]) / width);
    integral_.push_back(integral_[k] + 0.5 * width * (y_[k] + y_[k + 1]));
  }
  slope_.push_back(slope_.empty() ? 0 : std::max(slope_.back(), last_slope_floor));
}

}  // namespace crosswalk::fe
