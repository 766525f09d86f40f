#include "mb_node/contact_law.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/error.h"

namespace crosswalk::mb {
namespace {

constexpr double kBeyond = 0.5;  // m: the last slopes are continued this far past the tables
constexpr double kJump = 1e-9;   // m: width of a force drop at constant penetration

struct Points {
  std::vector<double> x, y;
};

Points continued(const Curve& curve) {
  Points p{{curve.x().begin(), curve.x().end()}, {curve.y().begin(), curve.y().end()}};
  p.x.push_back(p.x.back() + kBeyond);
  p.y.push_back(curve.value(p.x.back()));
  return p;
}

double inverse(const Points& rising, double force) {
  for (std::size_t i = 1; i < rising.x.size(); ++i) {
    if (force > rising.y[i] && i + 1 < rising.x.size()) continue;
    const double s = (force - rising.y[i - 1]) / (rising.y[i] - rising.y[i - 1]);
    return rising.x[i - 1] + s * (rising.x[i] - rising.x[i - 1]);
  }
  return 0;
}

/// Points of the second side's curve where either side has a corner.
Points with_corners_of(const Points& first, const Points& second) {
  Points out;
  for (std::size_t i = 0; i + 1 < second.x.size(); ++i) {
    std::vector<double> inner = {0.0};
    const double low = second.y[i], high = second.y[i + 1];
    for (const double force : first.y) {
      if (high == low) break;
      const double s = (force - low) / (high - low);
      if (s > 0 && s < 1) inner.push_back(s);
    }
    std::sort(inner.begin(), inner.end());
    for (const double s : inner) {
      out.x.push_back(second.x[i] + s * (second.x[i + 1] - second.x[i]));
      out.y.push_back(low + s * (high - low));
    }
  }
  out.x.push_back(second.x.back());
  out.y.push_back(second.y.back());
  return out;
}

}  // namespace

ContactLaw::ContactLaw(const Characteristic& side)
    : loading_(side.loading), first_{side.permanent_fraction, side.unloading_exponent, {}} {
  const Points p = continued(side.loading);
  first_.depth = Curve(p.x, p.x, Curve::Outside::LastSlope);
  second_.depth = Curve({0.0, 1.0}, {0.0, 0.0});
}

ContactLaw::ContactLaw(const Characteristic& first, const Characteristic& second)
    : first_{first.permanent_fraction, first.unloading_exponent, {}},
      second_{second.permanent_fraction, second.unloading_exponent, {}} {
  const Points a = continued(first.loading);
  CW_ASSERT(std::is_sorted(a.y.begin(), a.y.end()) && a.y.front() == 0);
  const Points b = with_corners_of(a, continued(second.loading));
  std::vector<double> d, force, d_first, d_second;
  const auto add = [&](double total, double f, double share_second) {
    d.push_back(total);
    force.push_back(f);
    d_second.push_back(share_second);
    d_first.push_back(total - share_second);
  };
  double before = 0, force_before = 0, second_before = 0;
  for (std::size_t i = 0; i < b.x.size(); ++i) {
    const double total = b.x[i] + inverse(a, b.y[i]);
    if (d.empty()) {
      add(total, b.y[i], b.x[i]);
    } else if (total > d.back() + kJump) {
      if (before < d.back()) {  // coming back from a snap-through: drop onto this branch
        const double s = (d.back() - before) / (total - before);
        add(d.back() + kJump, force_before + s * (b.y[i] - force_before),
            second_before + s * (b.x[i] - second_before));
      }
      add(total, b.y[i], b.x[i]);
    }
    before = total;
    force_before = b.y[i];
    second_before = b.x[i];
  }
  loading_ = Curve(d, force, Curve::Outside::LastSlope);
  first_.depth = Curve(d, d_first, Curve::Outside::LastSlope);
  second_.depth = Curve(d, d_second, Curve::Outside::LastSlope);
}

double ContactLaw::permanent(double deepest) const {
  return first_.permanent_fraction * first_.depth.value(deepest) +
         second_.permanent_fraction * second_.depth.value(deepest);
}

double ContactLaw::force(double d, double deepest) const {
  if (d <= 0) return 0;
  if (d >= deepest) return std::max(0.0, loading_.value(d));
  return std::max(0.0, loading_.value(deepest)) * force_share(d, deepest);
}

double ContactLaw::force_share(double d, double deepest) const {
  const double rest = d - permanent(deepest);
  if (rest <= 0) return 0;
  const double B = (1 - first_.permanent_fraction) * first_.depth.value(deepest);
  const double C = (1 - second_.permanent_fraction) * second_.depth.value(deepest);
  if (C == 0) return std::pow(rest / B, first_.exponent);
  // B f^(1/e1) + C f^(1/e2) = rest, rising in f: bracketed secant (Illinois).
  const auto excess = [&](double f) {
    return B * std::pow(f, 1 / first_.exponent) + C * std::pow(f, 1 / second_.exponent) - rest;
  };
  double low = 0, high = 1, g_low = -rest, g_high = excess(1);
  double f = 1;
  int kept = 0;  // which end stayed: its value is halved when it stays twice
  for (int i = 0; i < 60 && high - low > 1e-14; ++i) {
    f = high - g_high * (high - low) / (g_high - g_low);
    const double g = excess(f);
    if (std::abs(g) < 1e-15) break;
    if (g > 0) {
      high = f;
      g_high = g;
      if (kept == -1) g_low *= 0.5;
      kept = -1;
    } else {
      low = f;
      g_low = g;
      if (kept == 1) g_high *= 0.5;
      kept = 1;
    }
  }
  return f;
}

double ContactLaw::recoverable_energy(double deepest) const {
  const auto part = [&](const Side& side) {
    return (1 - side.permanent_fraction) * side.depth.value(deepest) / (1 + side.exponent);
  };
  return std::max(0.0, loading_.value(deepest)) * (part(first_) + part(second_));
}

double ContactLaw::stored_energy(double d, double deepest) const {
  if (d <= 0) return 0;
  if (d >= deepest) return recoverable_energy(d);
  // Integral of F_m f over the path's d(f) from f = 0.
  const double f = force_share(d, deepest);
  if (f <= 0) return 0;
  const auto part = [&](const Side& side) {
    return (1 - side.permanent_fraction) * side.depth.value(deepest) *
           std::pow(f, 1 + 1 / side.exponent) / (1 + side.exponent);
  };
  return std::max(0.0, loading_.value(deepest)) * (part(first_) + part(second_));
}

double ContactLaw::penetration_holding(double energy, double deepest, double limit) const {
  const auto stored = [&](double d) { return stored_energy(d, std::max(d, deepest)); };
  if (limit <= 0 || stored(limit) <= energy) return std::max(0.0, limit);
  double low = std::min(limit, permanent(deepest)), high = limit;
  if (deepest < limit && stored(deepest) <= energy) low = deepest;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (stored(middle) <= energy ? low : high) = middle;
  }
  return low;
}

}  // namespace crosswalk::mb
