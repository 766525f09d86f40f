// The pair of masses with known answer, as rows of a table: body M, point m, spring k between them;
// interface frequency w = sqrt(k (1/M + 1/m)). One list of rows and one measure for runs by direct
// calls and for runs of processes.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/units.h"
#include "coupler/scheme.h"
#include "tests/coupler/toy_nodes.h"

namespace crosswalk::coupling {

struct Pair {
  double mass_ratio = 1;  ///< m / M
  double wH = 0.1;
  double damping_ratio = 0;
  Scheme scheme = Scheme::Mic;
};

inline constexpr std::int64_t kPairWindow = 20000;  // ns
inline constexpr double kPairMass = 1;              // kg, M
/// A run lasts so many periods of the interface oscillation and so many windows, at least. What
/// grows does so by at most 1.4 in a period: no number leaves what messages may carry.
inline constexpr double kPairPeriods = 10;
inline constexpr double kPairWindows = 300;

inline double frequency(const Pair& p) { return p.wH / (1e-9 * kPairWindow); }
inline double reduced_mass(const Pair& p) { return kPairMass * p.mass_ratio / (1 + p.mass_ratio); }
inline toy::MbBody body_of(const Pair&) { return {.mass = kPairMass, .step = 1e-5}; }
/// The point starts 1 um off its place, at rest: no momentum, so all energy is of the vibration.
inline toy::FePoint point_of(const Pair& p) {
  const double w = frequency(p), m = reduced_mass(p);
  return {.mass = p.mass_ratio * kPairMass,
          .stiffness = w * w * m,
          .damping = 2 * p.damping_ratio * m * w,
          .x = 1e-6,
          .step = std::min(0.5e-6, 0.02 / w)};
}
inline SchemeSettings settings_of(const Pair& p) {
  return {.scheme = p.scheme,
          .n_attached = 1,
          .mobility_every = 1000,
          .tolerance = 1e-7,
          .accepted_residual = 1e-2};
}
/// Of a whole run, a multiple of `of`.
inline int windows_of(const Pair& p, int of = 1) {
  return static_cast<int>(std::ceil(std::max(kPairWindows, kPairPeriods * 2 * kPi / p.wH) / of)) *
         of;
}

/// The point after a run by direct calls.
inline toy::WatchedFe direct_run(const Pair& p, int windows) {
  toy::Mb mb(body_of(p));
  toy::WatchedFe fe(point_of(p));
  toy::NoRecords sink;
  DirectMbLink mb_link(mb, sink);
  DirectFeLink fe_link(fe, sink);
  CouplingState state = start_state(mb.interface_bodies());
  for (int i = 0; i < windows; ++i)
    advance_window(settings_of(p), state, kPairWindow, mb_link, fe_link);
  return fe;
}

/// Amplification per period: the slope, by least squares over all windows, of the logarithm of the
/// vibration's amplitude. 1 is neutral.
inline double growth_per_period(const Pair& p, const std::vector<toy::Stretch>& stretches) {
  const double k = point_of(p).stiffness, n = static_cast<double>(stretches.size());
  double st = 0, sa = 0, stt = 0, sta = 0;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const auto [u, du] = stretches[i];
    const double t = static_cast<double>(i);
    const double a = 0.5 * std::log(0.5 * k * u * u + 0.5 * reduced_mass(p) * du * du);
    st += t, sa += a, stt += t * t, sta += t * a;
  }
  return std::exp((n * sta - st * sa) / (n * stt - st * st) * 2 * kPi / p.wH);
}

/// The least and the largest growth that a scheme may show on a pair.
struct GrowthLimits {
  double least = 0, largest = 0;
};
inline GrowthLimits growth_limits(const Pair& p) {
  if (p.scheme == Scheme::Staggered) {
    // The force lags: exp(pi wH m / (M + m)) while wH is small.
    const double predicted = std::exp(kPi * p.wH * p.mass_ratio / (1 + p.mass_ratio));
    return {0.98 * predicted, 1.02 * predicted};
  }
  if (p.damping_ratio > 0) return {0, 1};
  // An undamped pair must not lose much either: `implicit` does where a window holds half a period.
  if (p.scheme == Scheme::Implicit) return {0.97, 1.0001};
  return {0.99, p.wH <= 0.3 ? 1.0001 : 1.003};
}

/// Mass ratio in tenths, wH and damping in hundredths.
inline std::string name_of(const Pair& p) {
  return fmt::format("{}_ratio{}_wH{}_damping{}", scheme_name(p.scheme), 10 * p.mass_ratio,
                     100 * p.wH, 100 * p.damping_ratio);
}

inline std::vector<Pair> pair_rows() {
  std::vector<Pair> rows;
  for (const double ratio : {0.1, 1.0, 10.0}) {
    for (const double wH : {0.1, 0.3, 1.0, 3.0}) {
      for (const double damping : {0.0, 0.02}) rows.push_back({ratio, wH, damping, Scheme::Mic});
      rows.push_back({ratio, wH, 0, Scheme::Implicit});
    }
    for (const double wH : {0.05, 0.1}) rows.push_back({ratio, wH, 0, Scheme::Staggered});
  }
  return rows;
}

}  // namespace crosswalk::coupling
