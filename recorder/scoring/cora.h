// CORA rating of an evaluated signal y (simulation) against a reference x (test): corridor C1 and
// cross-correlation C2 (progression V, size G, phase P), C = (G_1 C1 + G_2 C2) / (G_1 + G_2)
// [gehre2009; CORAplus 4.0.4 manual]. Parameters carry CORA's own names.
//
// Published texts leave the sampling step, the automatic interval and the data outside the interval
// open; our reading of them is stated in docs/signals.md and every result carries its parameters.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "recorder/channel.h"

namespace crosswalk::recording {

enum class CoraInterval { Full, Manual, Automatic };

struct CoraParameters {
  CoraInterval interval = CoraInterval::Full;
  std::optional<double> t_min, t_max;  ///< s, manual interval; open where absent
  std::optional<double> dt;            ///< s; absent: the smaller median step of the two signals
  std::optional<double> Y_norm;        ///< absent: extremum of |x|
  double A_THRES = 0.030;              ///< start of the automatic interval, share of Y_norm
  double B_THRES = 0.075;              ///< its end
  double A_EVAL = 0.010;               ///< its widening, share of its length
  double B_DELTA_END = 0.200;          ///< shortening when the signal does not come back
  double K = 2;                        ///< exponent between the corridors
  double G_1 = 0.50;                   ///< weight of the corridor rating
  double G_2 = 0.50;                   ///< weight of the cross-correlation rating
  double a_0 = 0.05, b_0 = 0.50;       ///< half-widths of inner and outer corridor, share of Y_norm
  double a_sigma = 0, b_sigma = 0;     ///< multiples of the reference's standard deviation added
  double D_MIN = 0.01, D_MAX = 0.12;   ///< phase rating 1 below, 0 above; share of the interval
  double overlap_min =
      0.80;  ///< CORA's INT_MIN (a C macro): smallest overlap while shifting, share of the interval
  double K_V = 10, K_G = 1, K_P = 1;          ///< exponents of progression, size, phase
  double G_V = 0.50, G_G = 0.25, G_P = 0.25;  ///< weights inside C2
};

struct CoraResult {
  double C = 0, C1 = 0, C2 = 0, V = 0, G = 0, P = 0;
  double K_max = 0;   ///< largest normalised correlation
  int m = 0;          ///< its shift in steps; negative: the simulation lags the test
  double delta = 0;   ///< s, m * dt
  std::size_t n = 0;  ///< samples in the interval
  double dt = 0;      ///< s
  double t_min = 0;   ///< s
  double t_max = 0;   ///< s
  double Y_norm = 0;
};

/// `sigma` (on the reference's samples) may be empty; it is needed when a_sigma or b_sigma is not
/// 0.
CoraResult cora(const Series& reference, const Series& simulation, const CoraParameters& parameters,
                std::span<const double> sigma = {});

/// Words of the ISO/TR 9790 scale divided by ten: excellent, good, fair, marginal, unacceptable.
std::string cora_grade(double score);

}  // namespace crosswalk::recording
