// From the messages of a run to named channels on one uniform time base, relative to time zero.
//
// Time zero t0: the first instant at which the force between car and pedestrian exceeds 10 N.
// Frames: W is x subject's front, y buck travel, z up (the published tests' frame: impact direction
// Y, Z up); head-fixed signals use SAE J211 axes (x forward, y right, z down). Accelerations come
// from differences of the recorded velocity over one window (the exact mean), are turned into the
// head and filtered per component at the native rate (CFC 1000 linear, CFC 60 angular velocity),
// and only then put onto the common grid of 20 kHz. A sample outside a stream's own time is missing
// (NaN).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/vehicle_front.h"
#include "recorder/channel.h"
#include "recorder/run_record.h"
#include "recorder/scoring/score_card.h"

namespace crosswalk::recording {

/// Names the numbered messages refer to, from the nodes' descriptions.
struct RunNames {
  std::vector<std::string> bodies, contact_pairs, regions;
  int head_body = -1;
  VehicleFront front;                   ///< facets of the car's profile
  std::optional<double> vehicle_speed;  ///< m/s, along +y, constant, when the description says so
};
RunNames run_names(const RunRecord& record);

/// Motion of the buck along its travel.
struct BuckMotion {
  Series position;     ///< m, displacement along y since the start
  Series velocity;     ///< m/s
  std::string source;  ///< which messages it came from, for provenance
  bool empty() const { return position.t.empty(); }
};
BuckMotion buck_motion(const RunRecord& record, const RunNames& names);

/// Origin of the buck frame (on the ground under the foremost point) in W at a simulated time (s),
/// when a body's pose tells it.
std::optional<Vec3> buck_origin_at(const RunRecord& record, const RunNames& names, double t);
/// Head COG in W at the sample nearest to a simulated time (s).
std::optional<Vec3> head_position_at(const RunRecord& record, double t);

struct HeadContact {
  double time = 0;            ///< s after t0, first head-vehicle force above 50 N
  std::string partner;        ///< part of the car nearest to the head; else the pair, or "car"
  double peak_force = 0;      ///< N, of the head against the vehicle, whole run
  double relative_speed = 0;  ///< m/s, head COG against the buck, just before
  double buck_speed = 0;      ///< m/s, then
  std::optional<double> wrap_around_distance;  ///< m, along the profile from the ground
};

struct RunChannels {
  double t0 = 0;                   ///< s, simulated time of time zero
  bool has_first_contact = false;  ///< false: t0 is the start of the simulation
  double dt = 0;                   ///< s
  std::vector<Channel> channels;   ///< all on the same grid
  HeadSignals head;                ///< J211 axes, filtered, for the metrics
  std::optional<HeadContact> head_contact;
  std::optional<double> initial_buck_speed;  ///< m/s
  std::vector<std::string> warnings;

  const Channel* find(const std::string& name) const;
};

RunChannels extract(const RunRecord& record);

}  // namespace crosswalk::recording
