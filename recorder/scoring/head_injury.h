// Head injury criteria from linear (and mixed) acceleration. SI in; criteria defined in g convert
// with standard gravity inside. Signals must be filtered before (CFC 1000 per component, then
// resultant).
//
// HIC = max over windows t2 - t1 <= W of (t2 - t1) [ mean of a over the window ]^2.5 with a in g
// and t in s [FMVSS 208]; window ends lie on samples, the first maximum is kept, negative means are
// skipped. The same window search serves RIC (|alpha|) and PRHIC (rotational power) [kimpara2012].
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "recorder/channel.h"

namespace crosswalk::recording {

struct WindowMaximum {
  double value = 0;
  std::optional<double> t1, t2;  ///< s; absent when no window has a positive mean
  bool is_unique = false;        ///< no other window reaches the value within 1e-9 of it
};

/// max over windows of (t2 - t1) mean^2.5 of a signal in whatever unit the criterion uses.
WindowMaximum window_criterion(std::span<const double> t, std::span<const double> signal,
                               double window);

/// HIC of a resultant acceleration in m/s2; window 0.015 or 0.036 s.
WindowMaximum hic(const Series& resultant, double window);

/// Largest level in g that the resultant holds for 3 ms in one piece; throws too_short for a record
/// under 3 ms.
WindowMaximum clip_3ms_single(const Series& resultant);

/// Largest sample level in g exceeded for 3 ms in total; throws too_short for a record under 3 ms.
double clip_3ms_cumulative(const Series& resultant);

/// Gadd severity index: integral of a^2.5 dt, a in g.
double severity_index(const Series& resultant);

/// Generalized acceleration model for brain injury threshold, two published forms.
enum class GambitForm {
  Power2,   ///< 250 g, 10 000 rad/s2, exponents 2
  Power25,  ///< 250 g, 25 000 rad/s2, exponents 2.5 [newman1986]
};
double gambit(std::span<const double> linear, std::span<const double> angular, GambitForm form);

/// Three components on one time base.
struct VectorSeries {
  std::vector<double> t, x, y, z;
  std::vector<double> magnitude() const;
};

/// Head impact power in W, its maximum and its rotational part over time; head axes [newman2000].
struct HeadImpactPower {
  double peak = 0;                 ///< W
  std::vector<double> rotational;  ///< W
};
HeadImpactPower head_impact_power(const VectorSeries& linear, const VectorSeries& angular);

/// 0.004718 omega_peak + 0.000224 HIC36 [kleiven2007].
double kleiven_combination(double peak_angular_velocity, double hic36);

}  // namespace crosswalk::recording
