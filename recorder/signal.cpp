#include "recorder/signal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace crosswalk::recording {

namespace {

/// Design frequency over CFC [ISO 6487: 1.25 / 0.6; SAE J211-1: 2.0775].
double frequency_factor(FilterForm form) {
  return form == FilterForm::Iso6487 ? 1.25 / 0.6 : 2.0775;
}

constexpr double kNyquistGuard = 0.45;    // of the sampling rate
constexpr double kRateOverCfc = 10.0;     // minimum sampling rate over CFC [SAE J211-1]
constexpr double kPaddingTime = 0.01;     // s
constexpr std::size_t kPaddingMin = 100;  // samples
constexpr std::size_t kStartMean = 10;    // samples
constexpr double kCountSlack = 1e-6;      // of a step
constexpr double kMostSamples = 2e6;

std::vector<double> padded(std::span<const double> x, std::size_t add) {
  const std::size_t n = x.size();
  std::vector<double> out;
  out.reserve(n + 2 * add);
  for (std::size_t k = add; k >= 1; --k) out.push_back(2.0 * x[0] - x[k]);
  out.insert(out.end(), x.begin(), x.end());
  for (std::size_t k = 1; k <= add; ++k) out.push_back(2.0 * x[n - 1] - x[n - 1 - k]);
  return out;
}

void one_pass(std::vector<double>& x, const CfcCoefficients& c) {
  const std::size_t start = std::min(kStartMean, x.size());
  double mean = 0;
  for (std::size_t i = 0; i < start; ++i) mean += x[i];
  mean /= static_cast<double>(start);
  std::vector<double> y(x.size(), mean);
  for (std::size_t i = 2; i < x.size(); ++i) {
    y[i] = c.a0 * x[i] + c.a1 * x[i - 1] + c.a2 * x[i - 2] + c.b1 * y[i - 1] + c.b2 * y[i - 2];
  }
  x = std::move(y);
}

}  // namespace

CfcCoefficients cfc_coefficients(double cfc, double dt, FilterForm form) {
  const double frequency = cfc * frequency_factor(form);
  if (!(cfc > 0) || !(dt > 0) || frequency >= kNyquistGuard / dt) {
    throw SignalError(SignalFault::BadParameter,
                      fmt::format("CFC {} needs more than {:.0f} samples per second, found {:.0f}",
                                  cfc, frequency / kNyquistGuard, 1.0 / dt));
  }
  const double wa = std::tan(std::numbers::pi * frequency * dt);
  const double q = 1.0 + std::numbers::sqrt2 * wa + wa * wa;
  CfcCoefficients c;
  c.a0 = wa * wa / q;
  c.a1 = 2.0 * c.a0;
  c.a2 = c.a0;
  c.b1 = -2.0 * (wa * wa - 1.0) / q;
  c.b2 = (-1.0 + std::numbers::sqrt2 * wa - wa * wa) / q;
  return c;
}

bool is_sampled_for_cfc(double cfc, double dt) {
  return 1.0 / dt >= kRateOverCfc * cfc * (1 - 1e-9);
}

std::vector<double> cfc_filter(std::span<const double> x, double dt, double cfc, FilterForm form) {
  const CfcCoefficients c = cfc_coefficients(cfc, dt, form);
  if (x.size() < 2) {
    throw SignalError(SignalFault::TooShort, "a filter needs at least 2 samples");
  }
  const auto wanted = static_cast<std::size_t>(std::llround(kPaddingTime / dt));
  const std::size_t add = std::min(std::max(wanted, kPaddingMin), x.size() - 1);
  std::vector<double> y = padded(x, add);
  one_pass(y, c);
  std::reverse(y.begin(), y.end());
  one_pass(y, c);
  std::reverse(y.begin(), y.end());
  const auto first = y.begin() + static_cast<std::ptrdiff_t>(add);
  return {first, first + static_cast<std::ptrdiff_t>(x.size())};
}

double median_step(std::span<const double> t) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  if (steps.empty())
    throw SignalError(SignalFault::TooShort, "no time step in fewer than 2 samples");
  std::sort(steps.begin(), steps.end());
  const std::size_t half = steps.size() / 2;
  return steps.size() % 2 == 1 ? steps[half] : 0.5 * (steps[half - 1] + steps[half]);
}

bool is_uniform(std::span<const double> t, double tolerance) {
  if (t.size() < 3) return true;
  const double mean = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (std::abs(t[i] - t[i - 1] - mean) > tolerance * mean) return false;
  }
  return true;
}

std::size_t sample_count(double from, double to, double dt) {
  const double steps = std::floor((to - from) / dt + kCountSlack);
  if (!(steps < kMostSamples)) {
    throw SignalError(SignalFault::BadParameter,
                      fmt::format("{} s .. {} s in steps of {} s are too many samples (more than "
                                  "{:.0f})",
                                  from, to, dt, kMostSamples));
  }
  return static_cast<std::size_t>(steps) + 1;
}

std::vector<double> resample(std::span<const double> t, std::span<const double> y, double t_min,
                             double dt, std::size_t n) {
  std::vector<double> out(n);
  std::size_t k = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = t_min + static_cast<double>(i) * dt;
    if (at <= t.front()) {
      out[i] = y.front();
      continue;
    }
    if (at >= t.back()) {
      out[i] = y.back();
      continue;
    }
    while (t[k + 1] < at) ++k;
    const double slope = (y[k + 1] - y[k]) / (t[k + 1] - t[k]);
    out[i] = y[k] + slope * (at - t[k]);
  }
  return out;
}

std::vector<double> derivative(std::span<const double> t, std::span<const double> y) {
  const std::size_t n = t.size();
  if (n < 2) throw SignalError(SignalFault::TooShort, "a derivative needs at least 2 samples");
  std::vector<double> d(n);
  d[0] = (y[1] - y[0]) / (t[1] - t[0]);
  d[n - 1] = (y[n - 1] - y[n - 2]) / (t[n - 1] - t[n - 2]);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = t[i] - t[i - 1];
    const double after = t[i + 1] - t[i];
    d[i] = ((y[i + 1] - y[i]) * before / after + (y[i] - y[i - 1]) * after / before) /
           (before + after);
  }
  return d;
}

std::vector<double> derivative(std::span<const double> y, double dt) {
  std::vector<double> t(y.size());
  for (std::size_t i = 0; i < t.size(); ++i) t[i] = static_cast<double>(i) * dt;
  return derivative(t, y);
}

std::vector<double> cumulative_integral(std::span<const double> t, std::span<const double> y) {
  std::vector<double> s(t.size(), 0.0);
  for (std::size_t i = 1; i < t.size(); ++i) {
    s[i] = s[i - 1] + 0.5 * (y[i] + y[i - 1]) * (t[i] - t[i - 1]);
  }
  return s;
}

std::vector<double> resultant(std::span<const double> x, std::span<const double> y,
                              std::span<const double> z) {
  if (x.size() != y.size() || x.size() != z.size()) {
    throw SignalError(SignalFault::Shape, "components of a resultant differ in length");
  }
  std::vector<double> r(x.size());
  for (std::size_t i = 0; i < r.size(); ++i)
    r[i] = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
  return r;
}

}  // namespace crosswalk::recording
