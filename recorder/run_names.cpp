// Names and the buck's motion from descriptions and messages (extract.h).
#include <algorithm>
#include <cmath>

#include "recorder/description.h"
#include "recorder/extract.h"
#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

using nlohmann::json;

std::vector<std::string> strings(const json& object, const char* key) {
  std::vector<std::string> out;
  if (!object.contains(key) || !object[key].is_array()) return out;
  for (const json& item : object[key]) {
    if (item.is_string()) out.push_back(item.get<std::string>());
    if (item.is_object() && item.contains("name")) out.push_back(item["name"].get<std::string>());
  }
  return out;
}

std::optional<double> number(const json& object, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (object.contains(key) && object[key].is_number()) return object[key].get<double>();
  }
  return std::nullopt;
}

bool is_vehicle(const std::string& body) {
  return body == "buck" || body == "car" || body == "vehicle" || body == "sedan_buck";
}

int vehicle_index(const std::vector<std::string>& bodies) {
  const auto found = std::find_if(bodies.begin(), bodies.end(), is_vehicle);
  return found == bodies.end() ? -1 : static_cast<int>(found - bodies.begin());
}

std::vector<FrontFacet> facets_of(const json& vehicle) {
  std::vector<FrontFacet> facets;
  if (!vehicle.contains("facets") || !vehicle["facets"].is_array()) return facets;
  const auto point = [](const json& f, const char* key, Eigen::Vector2d& out) {
    if (!f.contains(key) || !f[key].is_array() || f[key].size() != 2) return false;
    if (!f[key][0].is_number() || !f[key][1].is_number()) return false;
    out = {f[key][0].get<double>(), f[key][1].get<double>()};
    return true;
  };
  for (const json& f : vehicle["facets"]) {
    FrontFacet facet;
    if (!point(f, "begin_yz_m", facet.begin) || !point(f, "end_yz_m", facet.end)) return {};
    facet.component = f.value("component", "");
    facets.push_back(facet);
  }
  return facets;
}

double seconds(std::int64_t t_ns) { return 1e-9 * static_cast<double>(t_ns); }

}  // namespace

RunNames run_names(const RunRecord& record) {
  RunNames names;
  const json mb = description_of(record, Role::Mb);
  const json fe = description_of(record, Role::Fe);
  names.bodies = strings(mb, "bodies");
  names.contact_pairs = strings(mb, "contact_pairs");
  names.regions = strings(fe, "regions");
  if (mb.contains("head_body") && mb["head_body"].is_number_integer())
    names.head_body = mb["head_body"];
  if (!mb.contains("vehicle") || !mb["vehicle"].is_object()) return names;
  const json& vehicle = mb["vehicle"];
  names.front.facets = facets_of(vehicle);
  names.vehicle_speed = number(vehicle, {"speed_mps", "speed_m_s", "speed"});
  return names;
}

BuckMotion buck_motion(const RunRecord& record, const RunNames& names) {
  BuckMotion buck;
  const int interface = record.manifest ? vehicle_index(record.manifest->bodies) : -1;
  if (interface >= 0 && !record.mb.empty()) {
    for (const auto& [window, w] : record.mb) {
      if (interface >= static_cast<int>(w.bodies.size())) continue;
      const BodyMotion& motion = w.bodies[static_cast<std::size_t>(interface)];
      buck.position.t.push_back(seconds(w.t_ns));
      buck.position.y.push_back(motion.X_WB.p.y());
      buck.velocity.y.push_back(motion.V_WB.v.y());
    }
    buck.source = "interface body of mb_done";
  } else if (const int body = vehicle_index(names.bodies); body >= 0 && record.bodies.size() > 2) {
    for (const auto& [t_ns, poses] : record.bodies) {
      if (body >= static_cast<int>(poses.size())) continue;
      buck.position.t.push_back(seconds(t_ns));
      buck.position.y.push_back(poses[static_cast<std::size_t>(body)].p.y());
    }
    buck.velocity.y = derivative(buck.position.t, buck.position.y);
    buck.source = "body_states";
  } else if (names.vehicle_speed && !record.mb.empty()) {
    for (const std::int64_t t_ns : {std::int64_t{0}, record.mb.rbegin()->second.t_ns}) {
      buck.position.t.push_back(seconds(t_ns));
      buck.position.y.push_back(*names.vehicle_speed * seconds(t_ns));
      buck.velocity.y.push_back(*names.vehicle_speed);
    }
    buck.source = "constant speed of the vehicle's description";
  }
  buck.velocity.t = buck.position.t;
  if (!buck.position.y.empty()) {
    const double start = buck.position.y.front();
    for (double& y : buck.position.y) y -= start;
  }
  return buck;
}

std::optional<Vec3> buck_origin_at(const RunRecord& record, const RunNames& names, double t) {
  const auto t_ns = static_cast<std::int64_t>(std::llround(1e9 * t));
  if (const int i = record.manifest ? vehicle_index(record.manifest->bodies) : -1; i >= 0) {
    for (const auto& [window, w] : record.mb) {
      if (w.t_ns >= t_ns && i < static_cast<int>(w.bodies.size())) {
        return w.bodies[static_cast<std::size_t>(i)].X_WB.p;
      }
    }
  }
  const int body = vehicle_index(names.bodies);
  const auto after = record.bodies.lower_bound(t_ns);
  if (body < 0 || after == record.bodies.end() || after == record.bodies.begin())
    return std::nullopt;
  const auto before = std::prev(after);
  if (body >= static_cast<int>(std::min(before->second.size(), after->second.size()))) {
    return std::nullopt;
  }
  const double share =
      static_cast<double>(t_ns - before->first) / static_cast<double>(after->first - before->first);
  const Vec3& from = before->second[static_cast<std::size_t>(body)].p;
  const Vec3& to = after->second[static_cast<std::size_t>(body)].p;
  return from + share * (to - from);
}

std::optional<Vec3> head_position_at(const RunRecord& record, double t) {
  const auto found = record.head.lower_bound(static_cast<std::int64_t>(std::llround(1e9 * t)));
  if (found == record.head.end()) return std::nullopt;
  return found->second.X_WH.p;
}

}  // namespace crosswalk::recording
