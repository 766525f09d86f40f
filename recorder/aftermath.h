// What happens to a struck pedestrian after the car: how far the body is thrown, and the second
// impact of the head, on the road, with an injury criterion of its own.
#pragma once

#include <optional>

#include "recorder/extract.h"
#include "recorder/run_record.h"
#include "recorder/scoring/head_injury.h"

namespace crosswalk::recording {

/// The head on the road. HIC15 is that of the record from the first touch on.
struct RoadImpact {
  double time = 0;        ///< s after t0, first force of the road on the head above 50 N
  double peak_force = 0;  ///< N
  double peak_g = 0;      ///< resultant, CFC 1000
  WindowMaximum HIC15;
  double peak_g_before = 0;  ///< the same two of the record until then: the car's share
  WindowMaximum HIC15_before;
};

/// Motion of the whole body's centre of mass from t0 to the end of the record.
struct Throw {
  double distance = 0;              ///< m, along the car's travel
  double sideways = 0;              ///< m, to the subject's front (x of W at heading 0)
  double highest = 0;               ///< m, above the road
  double end_time = 0;              ///< s after t0
  double end_speed = 0;             ///< m/s
  std::optional<double> rest_time;  ///< s after t0: slower than kRestSpeed from then on
};
inline constexpr double kRestSpeed = 0.1;  ///< m/s [E]

struct Aftermath {
  std::optional<RoadImpact> head_on_road;
  std::optional<Throw> thrown;  ///< absent when the description tells no masses
};

Aftermath aftermath_of(const RunRecord& record, const RunChannels& channels);

}  // namespace crosswalk::recording
