// Motion of the head COG at the rate it was recorded, derived signals and their filters
// (extract.h).
#pragma once

#include <cstdint>
#include <map>

#include "common/exchange.h"
#include "recorder/extract.h"
#include "recorder/scoring/head_injury.h"

namespace crosswalk::recording {

std::vector<double> scaled(std::vector<double> values, double factor);

/// The filtered J211 channels of a run (or its channels.csv) as input of the metrics; the stretch
/// before the first and after the last finite sample is left out.
HeadSignals head_signals(const std::vector<Channel>& channels);

class HeadMotion {
 public:
  /// Times relative to t0 (s); gaps in the samples are closed by interpolation.
  HeadMotion(const std::map<std::int64_t, HeadSample>& samples, double t0);

  bool is_resampled() const { return is_resampled_; }
  VectorSeries displacement_mm() const;
  VectorSeries relative_displacement_mm(const BuckMotion& buck) const;
  Series relative_speed(const BuckMotion& buck) const;
  VectorSeries velocity() const;
  VectorSeries acceleration() const;                 ///< J211 head axes, unfiltered
  VectorSeries acceleration_filtered() const;        ///< J211 head axes, CFC 1000
  VectorSeries world_acceleration_filtered() const;  ///< frame W, CFC 1000
  VectorSeries angular_velocity_filtered() const;    ///< J211 head axes, CFC 60
  VectorSeries angular_acceleration() const;         ///< derivative of the former
  bool has_neck() const;                             ///< some sample holds a load of the neck
  VectorSeries neck_force_filtered() const;          ///< N, of the neck on the head, J211, CFC 1000
  VectorSeries neck_moment_filtered() const;         ///< N m, about the condyles, J211, CFC 600

 private:
  std::vector<Vec3> acceleration_W() const;
  VectorSeries in_head_axes(const std::vector<Vec3>& world) const;
  VectorSeries filtered(VectorSeries v, double cfc) const;

  std::vector<double> t_;
  double dt_ = 0;
  std::vector<Vec3> position_, velocity_, angular_velocity_, neck_force_, neck_moment_;
  std::vector<Quat> attitude_;
  bool is_resampled_ = false;
};

}  // namespace crosswalk::recording
