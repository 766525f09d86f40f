// The front of a car as plain data: facets of its centre-line profile, each with a component's
// characteristic. Frame: see contact_shapes.h, body `buck`.
#pragma once

#include <string>
#include <vector>

#include "common/config.h"
#include "common/contact_shapes.h"

namespace crosswalk {

struct VehicleComponent {
  std::string name;        ///< such as "hood"
  std::string provenance;  ///< published, measured or estimated
  double permanent_fraction = 0;
};

struct VehicleFront {
  std::string name;
  std::string provenance;  ///< the least certain of its components'
  std::vector<VehicleComponent> components;
  std::vector<FrontFacet> facets;  ///< from the ground up and to the rear
  std::vector<int> facet_component;
};

VehicleFront read_vehicle_front(ConfigTable vehicle);

/// Wrap-around distance of a point of the profile (y, z of the buck frame): the taut tape from the
/// ground under the foremost point, vertically to it, then along the profile; m.
double wrap_around_distance(const VehicleFront& front, const Eigen::Vector2d& point);

}  // namespace crosswalk
