// An immutable piecewise-linear curve y(x), the field's load curve.
//
// Outside the table the stated extrapolation holds. All values SI; the curve itself has no unit.
#pragma once

#include <span>
#include <vector>

namespace crosswalk {

class Curve {
 public:
  enum class Outside { Hold, LastSlope, Zero };

  Curve() = default;
  /// x strictly increasing, at least one point, all finite; throws std::invalid_argument else.
  Curve(std::vector<double> x, std::vector<double> y, Outside outside = Outside::Hold);

  bool empty() const { return x_.empty(); }
  double value(double x) const;
  double slope(double x) const;
  /// Integral of y from the first table point to x (negative to its left).
  double integral(double x) const;
  Curve scaled(double x_factor, double y_factor) const;
  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }
  Outside outside() const { return outside_; }

 private:
  int segment(double x) const;
  std::vector<double> x_, y_, integral_;
  Outside outside_ = Outside::Hold;
};

}  // namespace crosswalk
