#include "recorder/scoring/cora.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

constexpr double kTie = 1e-12;  // a later shift must beat the best correlation by more

void require_parameters(const CoraParameters& p) {
  const auto reject = [](const std::string& why) {
    throw SignalError(SignalFault::BadParameter, "CORA parameters: " + why);
  };
  for (const double value :
       {p.A_THRES, p.B_THRES, p.A_EVAL, p.B_DELTA_END, p.K,   p.G_1, p.G_2, p.a_0, p.b_0, p.a_sigma,
        p.b_sigma, p.D_MIN,   p.D_MAX,  p.overlap_min, p.K_V, p.K_G, p.K_P, p.G_V, p.G_G, p.G_P}) {
    if (!std::isfinite(value) || value < 0) reject("a value is negative or not finite");
  }
  if (p.b_0 < p.a_0) reject(fmt::format("b_0 = {} is below a_0 = {}", p.b_0, p.a_0));
  if (p.b_sigma < p.a_sigma) {
    reject(fmt::format("b_sigma = {} is below a_sigma = {}", p.b_sigma, p.a_sigma));
  }
  if (p.D_MAX < p.D_MIN) reject(fmt::format("D_MAX = {} is below D_MIN = {}", p.D_MAX, p.D_MIN));
  if (p.overlap_min <= 0 || p.overlap_min > 1)
    reject(fmt::format("INT_MIN = {} is not in (0, 1]", p.overlap_min));
  if (p.G_1 + p.G_2 <= 0) reject("G_1 + G_2 is zero");
  if (p.G_V + p.G_G + p.G_P <= 0) reject("G_V + G_G + G_P is zero");
  if (p.dt && !(std::isfinite(*p.dt) && *p.dt > 0)) reject("dt is not positive");
  if (p.Y_norm && !(std::isfinite(*p.Y_norm) && *p.Y_norm > 0)) reject("Y_norm is not positive");
  for (const auto& edge : {p.t_min, p.t_max}) {
    if (edge && !std::isfinite(*edge)) reject("an interval edge is not finite");
  }
  if (p.t_min && p.t_max && *p.t_max <= *p.t_min) reject("t_max is not above t_min");
}

struct Interval {
  double from = 0, to = 0;
};

/// Automatic interval in our reading of the manual, on the reference's own samples.
Interval automatic_interval(const Series& x, Interval common, const CoraParameters& p) {
  std::size_t first = 0;
  while (x.t[first] < common.from) ++first;
  std::size_t last = x.size() - 1;
  while (x.t[last] > common.to) --last;
  double peak = 0;
  for (std::size_t i = first; i <= last; ++i) peak = std::max(peak, std::abs(x.y[i]));
  if (peak <= 0 || first >= last) return common;
  std::size_t start = first;
  while (start < last && std::abs(x.y[start]) < p.A_THRES * peak) ++start;
  std::size_t end = last;
  while (end > first && std::abs(x.y[end]) < p.B_THRES * peak) --end;
  if (std::abs(x.y[last]) >= p.B_THRES * peak) {
    std::size_t settled = last;
    while (settled > first && std::abs(x.y[settled] - x.y[last]) < p.B_DELTA_END * peak) --settled;
    end = std::min(end, settled);
  }
  const double widening = p.A_EVAL * (x.t[end] - x.t[start]);
  return {std::max(common.from, x.t[start] - widening), std::min(common.to, x.t[end] + widening)};
}

Interval rated_interval(const Series& x, const Series& y, const CoraParameters& p) {
  const Interval common{std::max(x.t.front(), y.t.front()), std::min(x.t.back(), y.t.back())};
  const auto require_positive = [](Interval i, const char* what) {
    if (i.to <= i.from) {
      throw SignalError(SignalFault::NoOverlap,
                        fmt::format("{}: {} s .. {} s is empty", what, i.from, i.to));
    }
  };
  require_positive(common, "common time of the signals");
  Interval rated = common;
  if (p.interval == CoraInterval::Automatic) rated = automatic_interval(x, common, p);
  if (p.interval != CoraInterval::Full) {  // an edge that is given stands before an automatic one
    if (p.t_min) rated.from = std::max(common.from, *p.t_min);
    if (p.t_max) rated.to = std::min(common.to, *p.t_max);
  }
  require_positive(rated, "rated interval");
  return rated;
}

double corridor_rating(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<double>& sigma, double Y_norm, const CoraParameters& p) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double s = sigma.empty() ? 0.0 : sigma[i];
    const double inner = p.a_0 * Y_norm + p.a_sigma * s;
    const double outer = p.b_0 * Y_norm + p.b_sigma * s;
    const double d = std::abs(y[i] - x[i]);
    if (d <= inner) {
      sum += 1.0;
    } else if (d < outer) {
      sum += std::pow((outer - d) / (outer - inner), p.K);
    }
  }
  return sum / static_cast<double>(x.size());
}

struct Correlation {
  double K = 0, Fx = 0, Fy = 0;
};

/// The reference shifted by m against the simulation; only the overlap counts, no mean is removed.
Correlation correlate(const std::vector<double>& x, const std::vector<double>& y, int m) {
  const std::size_t shift_x = m > 0 ? static_cast<std::size_t>(m) : 0;
  const std::size_t shift_y = m < 0 ? static_cast<std::size_t>(-m) : 0;
  const std::size_t count = x.size() - shift_x - shift_y;
  const double* px = x.data() + shift_x;
  const double* py = y.data() + shift_y;
  double Fxy = 0;
  Correlation c;
  for (std::size_t i = 0; i < count; ++i) {
    c.Fx += px[i] * px[i];
    c.Fy += py[i] * py[i];
    Fxy += px[i] * py[i];
  }
  if (c.Fx == 0 && c.Fy == 0) {
    c.K = 1;
  } else if (c.Fx > 0 && c.Fy > 0) {
    c.K = std::clamp(Fxy / (std::sqrt(c.Fx) * std::sqrt(c.Fy)), -1.0, 1.0);
  }
  return c;
}

void cross_correlation_rating(const std::vector<double>& x, const std::vector<double>& y,
                              const CoraParameters& p, CoraResult& r) {
  const auto n = static_cast<double>(x.size());
  const auto M = static_cast<int>(std::min(std::floor((1.0 - p.overlap_min) * n + 1e-9), n - 1));
  Correlation best = correlate(x, y, 0);
  r.m = 0;
  for (int shift = 1; shift <= M; ++shift) {
    for (const int m : {shift, -shift}) {
      const Correlation c = correlate(x, y, m);
      if (c.K > best.K + kTie) {
        best = c;
        r.m = m;
      }
    }
  }
  r.K_max = best.K;
  r.delta = r.m * r.dt;
  r.V = std::pow((best.K + 1.0) / 2.0, p.K_V);
  const double larger = std::max(best.Fx, best.Fy);
  r.G = larger > 0 ? std::pow(std::min(best.Fx, best.Fy) / larger, p.K_G) : 1.0;
  const double T = static_cast<double>(r.n - 1) * r.dt;
  const double late = std::abs(r.delta);
  if (late <= p.D_MIN * T) {
    r.P = 1;
  } else if (late >= p.D_MAX * T) {
    r.P = 0;
  } else {
    r.P = std::pow((p.D_MAX * T - late) / ((p.D_MAX - p.D_MIN) * T), p.K_P);
  }
  r.C2 = (p.G_V * r.V + p.G_G * r.G + p.G_P * r.P) / (p.G_V + p.G_G + p.G_P);
}

}  // namespace

CoraResult cora(const Series& reference, const Series& simulation, const CoraParameters& parameters,
                std::span<const double> sigma) {
  const CoraParameters& p = parameters;
  require_valid(reference, "reference");
  require_valid(simulation, "simulation");
  if (!sigma.empty()) require_valid(reference.t, sigma, "sigma");
  require_parameters(p);
  if (sigma.empty() && (p.a_sigma > 0 || p.b_sigma > 0)) {
    throw SignalError(SignalFault::BadParameter,
                      "a_sigma or b_sigma is set but the reference has no sigma column");
  }
  const Interval interval = rated_interval(reference, simulation, p);
  CoraResult r;
  r.dt = p.dt ? *p.dt : std::min(median_step(reference.t), median_step(simulation.t));
  r.n = sample_count(interval.from, interval.to, r.dt);
  if (r.n < 2) {
    throw SignalError(SignalFault::TooShort, "the rated interval holds fewer than 2 samples");
  }
  r.t_min = interval.from;
  r.t_max = interval.from + static_cast<double>(r.n - 1) * r.dt;
  const std::vector<double> x = resample(reference.t, reference.y, r.t_min, r.dt, r.n);
  const std::vector<double> y = resample(simulation.t, simulation.y, r.t_min, r.dt, r.n);
  std::vector<double> s;
  if (!sigma.empty()) s = resample(reference.t, sigma, r.t_min, r.dt, r.n);
  for (const double value : x) r.Y_norm = std::max(r.Y_norm, std::abs(value));
  if (p.Y_norm) r.Y_norm = *p.Y_norm;
  r.C1 = corridor_rating(x, y, s, r.Y_norm, p);
  cross_correlation_rating(x, y, p, r);
  r.C = (p.G_1 * r.C1 + p.G_2 * r.C2) / (p.G_1 + p.G_2);
  return r;
}

std::string cora_grade(double score) {
  if (score >= 0.86) return "excellent";
  if (score >= 0.65) return "good";
  if (score >= 0.44) return "fair";
  if (score >= 0.26) return "marginal";
  return "unacceptable";
}

}  // namespace crosswalk::recording
