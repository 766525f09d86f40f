#include "recorder/scoring/iso18571.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

using Span = std::span<const double>;

constexpr std::size_t kMinSamples = 9;  // the slope's moving mean [iso18571]
constexpr double kTie = 1e-12;

void require_parameters(const Iso18571Parameters& p) {
  for (const double value : {p.K_Z, p.K_P, p.K_M, p.K_S, p.a_0, p.b_0, p.eps_P, p.eps_M, p.eps_S,
                             p.w_Z, p.w_P, p.w_M, p.w_S, p.w_dtw}) {
    if (!std::isfinite(value) || value < 0) {
      throw SignalError(SignalFault::BadParameter,
                        "ISO/TS 18571 parameters: a value is negative or not finite");
    }
  }
  if (p.b_0 < p.a_0 || p.eps_P <= 0 || p.eps_P >= 1 || p.eps_M <= 0 || p.eps_S <= 0 ||
      p.w_dtw <= 0 || p.w_Z + p.w_P + p.w_M + p.w_S <= 0) {
    throw SignalError(
        SignalFault::BadParameter,
        "ISO/TS 18571 parameters: b_0 below a_0, or a width, error limit or the sum of "
        "weights is not positive");
  }
}

double corridor(Span x, Span y, const Iso18571Parameters& p) {
  double norm = 0;
  for (const double value : x) norm = std::max(norm, std::abs(value));
  const double inner = p.a_0 * norm;
  const double outer = p.b_0 * norm;
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double d = std::abs(y[i] - x[i]);
    if (d < inner || d == 0) {
      sum += 1;
    } else if (d <= outer && outer > inner) {
      sum += std::pow((outer - d) / (outer - inner), p.K_Z);
    }
  }
  return sum / static_cast<double>(x.size());
}

/// Pearson's correlation; where it is undefined (a constant part), 1 for equal pieces and 0 else.
double correlation(Span x, Span y) {
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - mean_x;
    const double dy = y[i] - mean_y;
    xx += dx * dx;
    yy += dy * dy;
    xy += dx * dy;
  }
  if (xx > 0 && yy > 0) return xy / (std::sqrt(xx) * std::sqrt(yy));
  return std::equal(x.begin(), x.end(), y.begin()) ? 1.0 : 0.0;
}

/// Finds the alignment; pieces have length N - n_eps.
void phase(Span x, Span y, const Iso18571Parameters& p, Iso18571Result& r) {
  const std::size_t N = x.size();
  const double limit = p.eps_P * static_cast<double>(N);
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s <= static_cast<std::size_t>(limit); ++s) {
    for (const bool is_sim_late : {true, false}) {
      const Span a = is_sim_late ? x.first(N - s) : x.subspan(s);
      const Span b = is_sim_late ? y.subspan(s) : y.first(N - s);
      const double rho = correlation(a, b);
      if (rho > best + kTie) {
        best = rho;
        r.n_eps = static_cast<int>(s);
        r.ref_start = is_sim_late ? 0 : r.n_eps;
        r.sim_start = is_sim_late ? r.n_eps : 0;
      }
      if (s == 0) break;
    }
  }
  r.rho_E = best;
  const double shift = r.n_eps;
  if (r.n_eps == 0) {
    r.EP = 1;
  } else if (shift >= limit) {
    r.EP = 0;
  } else {
    r.EP = std::pow((limit - shift) / limit, p.K_P);
  }
}

struct PathEnd {
  double cost = std::numeric_limits<double>::infinity();
  double difference = 0;  // sum |y_i - x_j| along the best path
  double reference = 0;   // sum |x_j| along it
};

/// Dynamic time warping within the band |i - j| < r; two rows carry cost and error sums along.
PathEnd warp(Span x, Span y, double band) {
  const auto n = static_cast<int>(x.size());
  const int r = std::min(n, std::max(1, static_cast<int>(std::ceil(band * n))));
  std::vector<PathEnd> above(x.size()), row(x.size());
  for (int i = 0; i < n; ++i) {
    std::fill(row.begin(), row.end(), PathEnd{});
    const int from = std::max(0, i - r + 1);
    const int to = std::min(n - 1, i + r - 1);
    for (int j = from; j <= to; ++j) {
      PathEnd best;
      if (i == 0 && j == 0) best.cost = 0;
      if (i > 0 && above[j].cost < best.cost) best = above[j];
      if (j > from && row[j - 1].cost < best.cost) best = row[j - 1];
      if (i > 0 && j > 0 && above[j - 1].cost < best.cost) best = above[j - 1];
      const double d = y[i] - x[j];
      row[j] = {best.cost + d * d, best.difference + std::abs(d), best.reference + std::abs(x[j])};
    }
    std::swap(row, above);
  }
  return above[x.size() - 1];
}

double error_score(double numerator, double denominator, double limit, double exponent,
                   std::optional<double>& error) {
  if (denominator == 0) return numerator == 0 ? 1.0 : 0.0;
  error = numerator / denominator;
  if (*error == 0) return 1;
  if (*error >= limit) return 0;
  return std::pow((limit - *error) / limit, exponent);
}

/// Central differences of unit step, then a nine-point moving mean that shrinks towards the ends.
std::vector<double> smooth_slope(Span x) {
  const std::vector<double> d = derivative(x, 1.0);
  const auto n = static_cast<int>(d.size());
  std::vector<double> out(d.size());
  for (int i = 0; i < n; ++i) {
    const int half = std::min({4, i, n - 1 - i});
    double sum = 0;
    for (int k = i - half; k <= i + half; ++k) sum += d[k];
    out[i] = sum / (2 * half + 1);
  }
  return out;
}

double slope_score(Span x, Span y, const Iso18571Parameters& p, std::optional<double>& error) {
  const std::vector<double> dx = smooth_slope(x);
  const std::vector<double> dy = smooth_slope(y);
  double numerator = 0, denominator = 0;
  for (std::size_t i = 0; i < dx.size(); ++i) {
    numerator += std::abs(dy[i] - dx[i]);
    denominator += std::abs(dx[i]);
  }
  return error_score(numerator, denominator, p.eps_S, p.K_S, error);
}

std::string grade(double R) {
  if (R > 0.94) return "excellent";
  if (R > 0.80) return "good";
  if (R > 0.58) return "fair";
  return "poor";
}

}  // namespace

void align_grids(Series& reference, Series& simulation) {
  require_valid(reference, "reference");
  require_valid(simulation, "simulation");
  if (reference.t == simulation.t && is_uniform(reference.t)) return;
  const double from = std::max(reference.t.front(), simulation.t.front());
  const double to = std::min(reference.t.back(), simulation.t.back());
  if (to <= from) {
    throw SignalError(SignalFault::NoOverlap,
                      fmt::format("common time of the signals: {} s .. {} s is empty", from, to));
  }
  const double dt = std::min(median_step(reference.t), median_step(simulation.t));
  const std::size_t n = sample_count(from, to, dt);
  Series x, y;
  x.y = resample(reference.t, reference.y, from, dt, n);
  y.y = resample(simulation.t, simulation.y, from, dt, n);
  for (std::size_t i = 0; i < n; ++i) x.t.push_back(from + static_cast<double>(i) * dt);
  y.t = x.t;
  reference = std::move(x);
  simulation = std::move(y);
}

Iso18571Result iso18571(const Series& reference, const Series& simulation,
                        const Iso18571Parameters& parameters) {
  require_valid(reference, "reference", kMinSamples);
  require_valid(simulation, "simulation", kMinSamples);
  require_parameters(parameters);
  if (reference.size() != simulation.size()) {
    throw SignalError(SignalFault::Shape, fmt::format("reference has {} samples, simulation {}",
                                                      reference.size(), simulation.size()));
  }
  const Span x = reference.y;
  const Span y = simulation.y;
  const Iso18571Parameters& p = parameters;
  Iso18571Result r;
  r.Z = corridor(x, y, p);
  phase(x, y, p, r);
  const std::size_t length = x.size() - static_cast<std::size_t>(r.n_eps);
  const Span xs = x.subspan(static_cast<std::size_t>(r.ref_start), length);
  const Span ys = y.subspan(static_cast<std::size_t>(r.sim_start), length);
  const PathEnd path = warp(xs, ys, p.w_dtw);
  r.EM = error_score(path.difference, path.reference, p.eps_M, p.K_M, r.e_mag);
  r.ES = slope_score(xs, ys, p, r.e_slope);
  r.R = p.w_Z * r.Z + p.w_P * r.EP + p.w_M * r.EM + p.w_S * r.ES;
  r.grade = grade(r.R);
  return r;
}

}  // namespace crosswalk::recording
