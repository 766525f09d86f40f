// Brain injury metrics: from head rotation in head-fixed SAE J211 axes (x forward, y right, z
// down), rad/s and rad/s2, and from tissue strain of brain elements.
//
// BrIC   sqrt(sum (max|w_i| / w_ic)^2), maxima independent in time [takhounts2013].
// UBrIC  (sum [w_i + (a_i - w_i) exp(-a_i/w_i)]^2)^(1/2) of normalised peaks [gabler2018].
// DAMAGE peak of beta |d| with M d'' + C d' + K d = M alpha(t), d(0) = d'(0) = 0: a three-axis
//        oscillator whose x and z couple, so the sense of the axes matters [gabler2019]. Solved by
//        CVODE (BDF, constant Jacobian) with a stop time at every sample: alpha is linear between
//        samples and no step may cross a kink.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/spatial.h"
#include "recorder/scoring/head_injury.h"

namespace crosswalk::recording {

struct Bric {
  double csdm = 0;  ///< critical values from CSDM
  double mps = 0;   ///< critical values from MPS
  double avg = 0;   ///< their mean, the usual one
};
Bric bric(const VectorSeries& angular_velocity);

enum class UbricPeak { PeakToPeak, Maximum };
/// MPS set of critical values.
double ubric(const VectorSeries& angular_velocity, const VectorSeries& angular_acceleration,
             UbricPeak peak);

struct Damage {
  double value = 0;
  double time = 0;             ///< s, of the peak
  double x = 0, y = 0, z = 0;  ///< largest absolute value per axis, same scaling
};
Damage damage(const VectorSeries& angular_acceleration);

/// 0.0148 HIC15 + 15.6 DAMAGE [bailey2020].
double harm(double hic15, double damage_value);

/// Principal strains of a deformation gradient, descending.
struct PrincipalStrains {
  std::array<double, 3> green{}, log{}, engineering{};
};
PrincipalStrains principal_strains(const Mat3& deformation_gradient);

/// Maximum principal strain history of brain elements: strain[state][element].
struct ElementStrains {
  std::vector<double> volume;               ///< m3
  std::vector<std::vector<double>> strain;  ///< first principal strain per stored state
};
struct TissueMetrics {
  double mps_max = 0;  ///< largest peak of any element: noisy, never alone
  double mps95 = 0;    ///< 95th percentile of the element peaks, linear interpolation
  double mps50 = 0;
  double mps95_volume = 0;     ///< smallest level that holds 95 % of the volume
  double mps95_state_max = 0;  ///< largest 95th percentile of any single state
  std::vector<std::pair<double, double>>
      csdm;  ///< strain level, volume share that ever exceeded it
};
TissueMetrics tissue_metrics(const ElementStrains& elements);

/// Percentile p in [0, 1] with linear interpolation between order statistics.
double percentile(std::vector<double> values, double p);

}  // namespace crosswalk::recording
