#include "recorder/scoring/head_injury.h"

#include <algorithm>
#include <cmath>

#include "common/units.h"
#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

constexpr double kClipTime = 0.003;    // s
constexpr double kTimeSlack = 1e-9;    // relative, window ends against rounding of sample times
constexpr double kUniqueSlack = 1e-9;  // relative

std::vector<double> in_g(const Series& resultant) {
  std::vector<double> a = resultant.y;
  for (double& value : a) value /= kStandardGravity;
  return a;
}

void require_3ms(const Series& resultant) {
  require_valid(resultant, "resultant acceleration");
  if (resultant.t.back() - resultant.t.front() < kClipTime * (1 - kTimeSlack)) {
    throw SignalError(SignalFault::TooShort, "3 ms clip: the record is shorter than 3 ms");
  }
}

}  // namespace

WindowMaximum window_criterion(std::span<const double> t, std::span<const double> signal,
                               double window) {
  require_valid(t, signal, "window criterion");
  const std::vector<double> s = cumulative_integral(t, signal);
  // (dv/dt)^2.5 dt has the same maximiser as dv^5 / dt^3: no power in the double loop.
  double best = 0;
  std::size_t best_i = 0, best_j = 0;
  int ties = 0;
  const double longest = window * (1 + kTimeSlack);
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    for (std::size_t j = i + 1; j < t.size() && t[j] - t[i] <= longest; ++j) {
      const double dv = s[j] - s[i];
      if (dv <= 0) continue;
      const double dt = t[j] - t[i];
      const double dv2 = dv * dv;
      const double score = dv2 * dv2 * dv / (dt * dt * dt);
      if (score < best * (1 - 2 * kUniqueSlack)) continue;  // score is the criterion squared
      ties = score > best * (1 + 2 * kUniqueSlack) ? 1 : ties + 1;
      if (score > best) {
        best = score;
        best_i = i;
        best_j = j;
      }
    }
  }
  WindowMaximum result;
  if (best <= 0) return result;
  const double dt = t[best_j] - t[best_i];
  result.value = dt * std::pow((s[best_j] - s[best_i]) / dt, 2.5);
  result.t1 = t[best_i];
  result.t2 = t[best_j];
  result.is_unique = ties == 1;
  return result;
}

WindowMaximum hic(const Series& resultant, double window) {
  require_valid(resultant, "resultant acceleration");
  return window_criterion(resultant.t, in_g(resultant), window);
}

WindowMaximum clip_3ms_single(const Series& resultant) {
  require_3ms(resultant);
  const std::vector<double> a = in_g(resultant);
  const std::vector<double>& t = resultant.t;
  WindowMaximum best;
  best.value = -1;
  std::size_t j = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    while (j < t.size() && t[j] < t[i] + kClipTime * (1 - kTimeSlack)) ++j;
    if (j == t.size()) break;
    const double level = *std::min_element(a.begin() + static_cast<std::ptrdiff_t>(i),
                                           a.begin() + static_cast<std::ptrdiff_t>(j) + 1);
    if (level > best.value) {
      best.is_unique = best.value < level * (1 - kUniqueSlack);
      best.value = level;
      best.t1 = t[i];
      best.t2 = t[j];
    } else if (level >= best.value * (1 - kUniqueSlack)) {
      best.is_unique = false;
    }
  }
  return best;
}

double clip_3ms_cumulative(const Series& resultant) {
  require_3ms(resultant);
  const std::vector<double> a = in_g(resultant);
  // A segment counts for every level up to the lower of its two ends: sort segments by that level.
  std::vector<std::pair<double, double>> segments;  // level, duration
  for (std::size_t i = 1; i < a.size(); ++i) {
    segments.emplace_back(std::min(a[i - 1], a[i]), resultant.t[i] - resultant.t[i - 1]);
  }
  std::stable_sort(segments.begin(), segments.end(),
                   [](const auto& l, const auto& r) { return l.first > r.first; });
  double time = 0;
  for (const auto& [level, duration] : segments) {
    time += duration;
    if (time >= kClipTime * (1 - kTimeSlack)) return level;
  }
  return segments.back().first;
}

double severity_index(const Series& resultant) {
  require_valid(resultant, "resultant acceleration");
  std::vector<double> a = in_g(resultant);
  for (double& value : a) value = std::pow(std::max(value, 0.0), 2.5);
  return cumulative_integral(resultant.t, a).back();
}

double gambit(std::span<const double> linear, std::span<const double> angular, GambitForm form) {
  if (linear.size() != angular.size()) {
    throw SignalError(SignalFault::Shape, "GAMBIT: linear and angular signals differ in length");
  }
  const double exponent = form == GambitForm::Power2 ? 2.0 : 2.5;
  const double a_c = 250.0 * kStandardGravity;
  const double alpha_c = form == GambitForm::Power2 ? 10000.0 : 25000.0;
  double peak = 0;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    peak = std::max(peak,
                    std::pow(linear[i] / a_c, exponent) + std::pow(angular[i] / alpha_c, exponent));
  }
  return std::pow(peak, 1.0 / exponent);
}

std::vector<double> VectorSeries::magnitude() const { return resultant(x, y, z); }

HeadImpactPower head_impact_power(const VectorSeries& linear, const VectorSeries& angular) {
  // Coefficients are mass 4.5 kg and the principal inertias in kg m2 of the 50th male head
  // [newman2000].
  constexpr double kMass = 4.50, kIxx = 0.016, kIyy = 0.024, kIzz = 0.022;
  const std::vector<double>& t = linear.t;
  if (angular.t.size() != t.size()) {
    throw SignalError(SignalFault::Shape, "HIP: linear and angular signals differ in length");
  }
  HeadImpactPower power;
  power.rotational.assign(t.size(), 0.0);
  std::vector<double> total(t.size(), 0.0);
  const auto add = [&t](std::vector<double>& sum, const std::vector<double>& a, double factor) {
    const std::vector<double> v = cumulative_integral(t, a);
    for (std::size_t i = 0; i < t.size(); ++i) sum[i] += factor * a[i] * v[i];
  };
  add(power.rotational, angular.x, kIxx);
  add(power.rotational, angular.y, kIyy);
  add(power.rotational, angular.z, kIzz);
  for (const auto* a : {&linear.x, &linear.y, &linear.z}) add(total, *a, kMass);
  for (std::size_t i = 0; i < t.size(); ++i) {
    power.peak = std::max(power.peak, total[i] + power.rotational[i]);
  }
  return power;
}

double kleiven_combination(double peak_angular_velocity, double hic36) {
  return 0.004718 * peak_angular_velocity + 0.000224 * hic36;
}

}  // namespace crosswalk::recording
