#include "common/contact_shapes.h"

#include <fmt/format.h>

#include "common/body_description.h"
#include "common/config.h"
#include "common/vehicle_front.h"

namespace crosswalk {

std::vector<BodyShapes> read_contact_shapes(ConfigTable scenario,
                                            const std::vector<std::string>& bodies) {
  const BodyDescription subject =
      read_body_description(scenario.table("subject", "the pedestrian"));
  ConfigTable vehicle = scenario.table("vehicle", "the car");
  std::vector<BodyShapes> shapes;
  for (const std::string& name : bodies) {
    BodyShapes body;
    body.body = name;
    if (name == "buck") {
      body.facets = read_vehicle_front(vehicle).facets;
      shapes.push_back(body);
      continue;
    }
    const int segment = subject.find_segment(name);
    if (segment < 0) {
      scenario.problem("interfaces", "bodies of the pedestrian, or `buck`",
                       fmt::format("`{}`", name));
      continue;
    }
    for (const SurfaceEllipsoid& e : subject.ellipsoids) {
      if (e.segment != segment) continue;
      const Region& region = subject.regions[e.region];
      body.ellipsoids.push_back({e.name,
                                 region.name,
                                 {Quat::Identity(), e.centre - subject.segments[segment].com},
                                 e.semi_axes,
                                 region.flesh});
    }
    shapes.push_back(body);
  }
  return shapes;
}

}  // namespace crosswalk
