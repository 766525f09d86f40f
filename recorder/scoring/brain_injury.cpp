#include "recorder/scoring/brain_injury.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>

#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

double peak_absolute(const std::vector<double>& x) {
  double peak = 0;
  for (const double value : x) peak = std::max(peak, std::abs(value));
  return peak;
}

double peak_to_peak(const std::vector<double>& x) {
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  return *high - *low;
}

void require_valid(const VectorSeries& v, const std::string& name) {
  recording::require_valid(v.t, v.x, name + " x");
  recording::require_valid(v.t, v.y, name + " y");
  recording::require_valid(v.t, v.z, name + " z");
}

double bric_of(const std::array<double, 3>& peak, const std::array<double, 3>& critical) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += std::pow(peak[i] / critical[i], 2);
  return std::sqrt(sum);
}

}  // namespace

Bric bric(const VectorSeries& w) {
  require_valid(w, "angular velocity");
  // rad/s [takhounts2013]
  constexpr std::array<double, 3> kCsdm{66.20, 59.10, 44.25};
  constexpr std::array<double, 3> kMps{66.30, 53.80, 41.50};
  constexpr std::array<double, 3> kMean{66.25, 56.45, 42.87};
  const std::array<double, 3> peak{peak_absolute(w.x), peak_absolute(w.y), peak_absolute(w.z)};
  return {bric_of(peak, kCsdm), bric_of(peak, kMps), bric_of(peak, kMean)};
}

double ubric(const VectorSeries& w, const VectorSeries& alpha, UbricPeak peak) {
  require_valid(w, "angular velocity");
  require_valid(alpha, "angular acceleration");
  constexpr std::array<double, 3> kOmega{211.0, 171.0, 115.0};       // rad/s [gabler2018]
  constexpr std::array<double, 3> kAlpha{20000.0, 10300.0, 7760.0};  // rad/s2
  const std::array<const std::vector<double>*, 3> ws{&w.x, &w.y, &w.z};
  const std::array<const std::vector<double>*, 3> as{&alpha.x, &alpha.y, &alpha.z};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double size =
        peak == UbricPeak::PeakToPeak ? peak_to_peak(*ws[i]) : peak_absolute(*ws[i]);
    const double w_i = size / kOmega[i];
    const double a_i = peak_absolute(*as[i]) / kAlpha[i];
    const double term = w_i > 0 ? w_i + (a_i - w_i) * std::exp(-a_i / w_i) : a_i;
    sum += term * term;
  }
  return std::sqrt(sum);
}

double harm(double hic15, double damage_value) { return 0.0148 * hic15 + 15.6 * damage_value; }

PrincipalStrains principal_strains(const Mat3& F) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(F.transpose() * F, Eigen::EigenvaluesOnly);
  PrincipalStrains strains;
  for (std::size_t i = 0; i < 3; ++i) {
    const double square = solver.eigenvalues()[2 - static_cast<Eigen::Index>(i)];
    strains.green[i] = 0.5 * (square - 1.0);
    strains.log[i] = 0.5 * std::log(square);
    strains.engineering[i] = std::sqrt(square) - 1.0;
  }
  return strains;
}

double percentile(std::vector<double> values, double p) {
  if (values.empty()) throw SignalError(SignalFault::TooShort, "percentile of nothing");
  std::sort(values.begin(), values.end());
  const double h = p * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(std::floor(h));
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (h - static_cast<double>(low)) * (values[high] - values[low]);
}

TissueMetrics tissue_metrics(const ElementStrains& elements) {
  const std::size_t n = elements.volume.size();
  if (n == 0 || elements.strain.empty()) {
    throw SignalError(SignalFault::TooShort, "tissue metrics: no elements or no states");
  }
  std::vector<double> peak(n, -1.0);
  TissueMetrics m;
  for (const std::vector<double>& state : elements.strain) {
    if (state.size() != n) throw SignalError(SignalFault::Shape, "tissue metrics: ragged state");
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(state[i])) {
        throw SignalError(SignalFault::NotFinite, "tissue metrics: strain is not finite");
      }
      peak[i] = std::max(peak[i], state[i]);
    }
    m.mps95_state_max = std::max(m.mps95_state_max, percentile(state, 0.95));
  }
  m.mps_max = *std::max_element(peak.begin(), peak.end());
  m.mps95 = percentile(peak, 0.95);
  m.mps50 = percentile(peak, 0.50);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&peak](std::size_t a, std::size_t b) { return peak[a] < peak[b]; });
  const double total = std::accumulate(elements.volume.begin(), elements.volume.end(), 0.0);
  double held = 0;
  for (const std::size_t i : order) {
    held += elements.volume[i];
    m.mps95_volume = peak[i];
    if (held >= 0.95 * total * (1 - 1e-12)) break;
  }
  for (const double level : {0.05, 0.10, 0.15, 0.20, 0.25, 0.30}) {
    double above = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (peak[i] > level) above += elements.volume[i];
    }
    m.csdm.emplace_back(level, above / total);
  }
  return m;
}

}  // namespace crosswalk::recording
