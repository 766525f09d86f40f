// Signal operations: SAE J211 / ISO 6487 channel filter, resampling, derivative, resultant.
//
// CFC filter: two-pole Butterworth run forward and backward (zero phase, four poles)
//   y_i = a0 x_i + a1 x_{i-1} + a2 x_{i-2} + b1 y_{i-1} + b2 y_{i-2},
//   wa = tan(pi CFC f dt), f = 1.25/0.6 (ISO 6487) or 2.0775 (SAE J211-1).
// Padding: both ends extended by point reflection over max(10 ms, 100 samples), at most n-1; each
// pass starts from the mean of its first ten inputs [ISO 6487, annex; choice stated in
// docs/signals.md]. Filters act on components; resultants are formed afterwards.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "recorder/channel.h"

namespace crosswalk::recording {

enum class FilterForm { Iso6487, SaeJ211 };

struct CfcCoefficients {
  double a0 = 0, a1 = 0, a2 = 0, b1 = 0, b2 = 0;
};

/// Throws bad_parameter when cfc * f >= 0.45 / dt (the pole pair would pass the Nyquist limit).
CfcCoefficients cfc_coefficients(double cfc, double dt, FilterForm form);

/// True when the sampling rate meets the class's minimum of 10 * CFC.
bool is_sampled_for_cfc(double cfc, double dt);

std::vector<double> cfc_filter(std::span<const double> x, double dt, double cfc,
                               FilterForm form = FilterForm::Iso6487);

/// Median of the time steps, s.
double median_step(std::span<const double> t);

/// True when every step agrees with the mean step within `tolerance` of it.
bool is_uniform(std::span<const double> t, double tolerance = 1e-3);

/// Samples of a grid of step dt from `from` on that lie up to `to`, against rounding up to 1e-6 of
/// a step beyond. Throws bad_parameter above two million: a step that small is a mistake.
std::size_t sample_count(double from, double to, double dt);

/// Linear interpolation at t_min + i * dt, i < n; outside the record the end values are held only
/// against rounding (callers never ask for more than half a step beyond the ends).
std::vector<double> resample(std::span<const double> t, std::span<const double> y, double t_min,
                             double dt, std::size_t n);

/// dy/dt: central differences of unequal steps, one-sided at the ends.
std::vector<double> derivative(std::span<const double> t, std::span<const double> y);
std::vector<double> derivative(std::span<const double> y, double dt);

/// Running trapezoid integral, 0 at the first sample.
std::vector<double> cumulative_integral(std::span<const double> t, std::span<const double> y);

/// Pointwise Euclidean norm of three components.
std::vector<double> resultant(std::span<const double> x, std::span<const double> y,
                              std::span<const double> z);

}  // namespace crosswalk::recording
