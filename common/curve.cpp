#include "common/curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crosswalk {

Curve::Curve(std::vector<double> x, std::vector<double> y, Outside outside)
    : x_(std::move(x)), y_(std::move(y)), outside_(outside) {
  if (x_.empty() || x_.size() != y_.size())
    throw std::invalid_argument("a curve needs as many ordinates as abscissae, and at least one");
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (!std::isfinite(x_[i]) || !std::isfinite(y_[i]))
      throw std::invalid_argument("a curve point is not a finite number");
    if (i > 0 && !(x_[i] > x_[i - 1]))
      throw std::invalid_argument("the abscissae of a curve must rise strictly");
  }
  integral_.resize(x_.size(), 0.0);
  for (std::size_t i = 1; i < x_.size(); ++i)
    integral_[i] = integral_[i - 1] + 0.5 * (y_[i] + y_[i - 1]) * (x_[i] - x_[i - 1]);
}

int Curve::segment(double x) const {
  const auto upper = std::upper_bound(x_.begin(), x_.end(), x);
  const int last = static_cast<int>(x_.size()) - 2;
  return std::clamp(static_cast<int>(upper - x_.begin()) - 1, 0, std::max(last, 0));
}

double Curve::slope(double x) const {
  if (x_.size() < 2) return 0;
  const bool is_outside = x < x_.front() || x > x_.back();
  if (is_outside && outside_ != Outside::LastSlope) return 0;
  const int i = segment(x);
  return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]);
}

double Curve::value(double x) const {
  if (outside_ == Outside::Zero && (x < x_.front() || x > x_.back())) return 0;
  if (x_.size() == 1) return y_.front();
  if (outside_ == Outside::Hold) x = std::clamp(x, x_.front(), x_.back());
  const int i = segment(x);
  return y_[i] + (y_[i + 1] - y_[i]) * (x - x_[i]) / (x_[i + 1] - x_[i]);
}

double Curve::integral(double x) const {
  if (outside_ == Outside::Zero) x = std::clamp(x, x_.front(), x_.back());
  const int i = segment(x);
  if (x < x_.front()) return -0.5 * (value(x) + y_.front()) * (x_.front() - x);
  if (x > x_.back()) return integral_.back() + 0.5 * (value(x) + y_.back()) * (x - x_.back());
  return integral_[i] + 0.5 * (y_[i] + value(x)) * (x - x_[i]);
}

Curve Curve::scaled(double x_factor, double y_factor) const {
  std::vector<double> x = x_, y = y_;
  for (double& a : x) a *= x_factor;
  for (double& b : y) b *= y_factor;
  return Curve(std::move(x), std::move(y), outside_);
}

}  // namespace crosswalk
