#include "common/vehicle_front.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace crosswalk {
namespace {

constexpr double kStraightUnloading = 1;  // exponent of a car component

Characteristic read_characteristic(ConfigTable& table) {
  Characteristic c;
  c.loading = table.curve("force", Dimension::Length, Dimension::Force, Curve::Outside::LastSlope,
                          "force against deflection, summed over one body segment's patch");
  c.permanent_fraction = table.quantity("permanent_fraction", Dimension::None, {0, 0.99},
                                        "deflection left after unloading, of the largest");
  c.unloading_exponent = kStraightUnloading;
  return c;
}

}  // namespace

VehicleFront read_vehicle_front(ConfigTable vehicle) {
  static const std::vector<std::string> kProvenance = {"measured", "published", "estimated"};
  VehicleFront front;
  front.name = vehicle.text_or("name", "vehicle", "name of the car");
  int worst = 0;
  ConfigTable components =
      vehicle.table("component", "parts of the front, from the ground up and to the rear");
  for (const std::string& name : components.table_names()) {
    ConfigTable table = components.table(name, "one part of the front");
    VehicleComponent component;
    component.name = name;
    component.provenance = table.choice_or("provenance", kProvenance, "estimated",
                                           "where profile and curve come from");
    worst = std::max(worst, static_cast<int>(std::find(kProvenance.begin(), kProvenance.end(),
                                                       component.provenance) -
                                             kProvenance.begin()));
    const std::vector<double> x =
        table.quantities("x", Dimension::Length, 0, "distances behind the foremost point");
    const std::vector<double> z = table.quantities(
        "z", Dimension::Length, static_cast<int>(x.size()), "heights above the ground");
    const double width = table.quantity("width", Dimension::Length, kPositive, "lateral width");
    const Characteristic structure = read_characteristic(table);
    component.permanent_fraction = structure.permanent_fraction;
    if (x.size() < 2) table.problem("x", "at least two points", fmt::format("{}", x.size()));
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      FrontFacet facet{name, {-x[i], z[i]}, {-x[i + 1], z[i + 1]}, {}, width / 2, structure};
      const Eigen::Vector2d along = facet.end - facet.begin;
      if (!(along.norm() > 0)) {
        table.problem("x", "distinct points", "a point twice");
        continue;
      }
      facet.normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
      front.facets.push_back(facet);
      front.facet_component.push_back(static_cast<int>(front.components.size()));
    }
    front.components.push_back(component);
  }
  if (front.components.empty()) {
    vehicle.problem("", "[vehicle.component.<name>] tables", "none",
                    "name a car, for example `base = \"../vehicles/generic_sedan_buck.toml\"`");
  }
  front.provenance = kProvenance[worst];
  return front;
}

double wrap_around_distance(const VehicleFront& front, const Eigen::Vector2d& point) {
  // From the foremost vertex on, along the vertices; gaps between components are bridged.
  std::vector<Eigen::Vector2d> vertices;
  for (const FrontFacet& facet : front.facets) {
    if (vertices.empty() || (vertices.back() - facet.begin).norm() > 1e-9) {
      vertices.push_back(facet.begin);
    }
    vertices.push_back(facet.end);
  }
  const auto foremost = std::max_element(
      vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  double length = foremost->y(), best = length, nearest = (point - *foremost).norm();
  for (auto v = foremost; v + 1 < vertices.end(); ++v) {
    const Eigen::Vector2d along = *(v + 1) - *v;
    const double s = std::clamp((point - *v).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (point - *v - s * along).norm();
    if (distance < nearest) {
      nearest = distance;
      best = length + s * along.norm();
    }
    length += along.norm();
  }
  return best;
}

}  // namespace crosswalk
