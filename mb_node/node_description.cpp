// What the numbered records refer to, as one JSON object (docs/messages.md, docs/multibody.md).
#include "mb_node/node_description.h"

#include <nlohmann/json.hpp>

#include "mb_node/mb_node.h"

namespace crosswalk::mb {
namespace {

using nlohmann::json;

json array(const Vec3& v) { return json::array({v.x(), v.y(), v.z()}); }

}  // namespace

json vehicle_json(const Vehicle& vehicle) {
  json components = json::array(), facets = json::array();
  for (const VehicleComponent& c : vehicle.front.components) {
    components.push_back({{"name", c.name}, {"provenance", c.provenance}});
  }
  for (const FrontFacet& f : vehicle.front.facets) {
    facets.push_back({{"component", f.component},
                      {"begin_yz_m", {f.begin.x(), f.begin.y()}},
                      {"end_yz_m", {f.end.x(), f.end.y()}},
                      {"half_width_m", f.half_width}});
  }
  return {{"name", vehicle.front.name}, {"provenance", vehicle.front.provenance},
          {"speed_m_s", vehicle.speed}, {"friction", vehicle.friction},
          {"components", components},   {"facets", facets}};
}

std::string MbNode::description() const {
  const MbConfig& config = model_->config;
  json bodies = json::array(), ellipsoids = json::array(), links = json::array();
  json masses = json::array();
  for (const Segment& s : config.body.segments) {
    bodies.push_back(s.name);
    masses.push_back(s.mass);
    // For stick figures: the parent, and the joint centre in this body's frame.
    links.push_back({{"parent", s.parent}, {"joint_m", array(s.joint_centre - s.com)}});
  }
  bodies.push_back("buck");
  for (const SurfaceEllipsoid& e : config.body.ellipsoids) {
    ellipsoids.push_back({{"name", e.name},
                          {"body", e.segment},
                          {"region", config.body.regions[e.region].name},
                          {"centre_m", array(e.centre - config.body.segments[e.segment].com)},
                          {"semi_axes_m", array(e.semi_axes)}});
  }
  json pairs = json::array({"car_total"});
  for (const VehicleComponent& c : config.vehicle.front.components)
    pairs.push_back("car_" + c.name);
  pairs.push_back("head_car");
  pairs.push_back("ground");
  pairs.push_back("ground_head");  // the part of it on the head
  const Anthropometry& a = config.body.measures;
  const json description = {{"bodies", bodies},
                            {"masses_kg", masses},
                            {"links", links},
                            {"ellipsoids", ellipsoids},
                            {"head_body", model_->head},
                            {"contact_pairs", pairs},
                            {"vehicle", vehicle_json(config.vehicle)},
                            {"subject",
                             {{"name", config.body.name},
                              {"mass_kg", a.mass},
                              {"standing_height_m", a.standing_height},
                              {"model_mass_kg", config.body.total_mass()}}}};
  return description.dump();
}

}  // namespace crosswalk::mb
