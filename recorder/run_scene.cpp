#include "recorder/run_scene.h"

#include <algorithm>

#include "recorder/description.h"

namespace crosswalk::recording {

namespace {

using nlohmann::json;

json member(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? json::array() : *found;
}

/// The first `n` numbers of an array, zeros where there are none.
Eigen::VectorXd numbers(const json& list, int n) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(n);
  for (int i = 0; i < n && list.is_array() && i < static_cast<int>(list.size()); ++i) {
    if (list[i].is_number()) out[i] = list[i].get<double>();
  }
  return out;
}

void add_ellipsoids(Scene& scene, const json& mb) {
  for (const json& e : member(mb, "ellipsoids")) {
    if (!e.is_object()) continue;
    SceneEllipsoid shape;
    shape.body = e.value("body", -1);
    shape.name = e.value("name", "");
    shape.X_BE.p = numbers(member(e, "centre_m"), 3);
    const json turn = member(e, "quaternion_wxyz");
    if (turn.size() == 4) {
      const Eigen::VectorXd q = numbers(turn, 4);
      shape.X_BE.q = Quat(q[0], q[1], q[2], q[3]).normalized();
    }
    shape.semi_axes = numbers(member(e, "semi_axes_m"), 3);
    const bool is_sound = shape.body >= 0 && shape.body < static_cast<int>(scene.bodies.size()) &&
                          shape.semi_axes.minCoeff() > 0;
    if (is_sound) scene.ellipsoids.push_back(shape);
  }
}

void add_facets(Scene& scene, const json& vehicle) {
  for (const json& f : member(vehicle, "facets")) {
    if (!f.is_object()) continue;
    SceneFacet facet;
    facet.component = f.value("component", "");
    facet.begin = numbers(member(f, "begin_yz_m"), 2);
    facet.end = numbers(member(f, "end_yz_m"), 2);
    facet.half_width = f.value("half_width_m", 0.0);
    scene.facets.push_back(facet);
  }
}

void add_head(Scene& scene, const json& fe) {
  const json surface = fe.contains("head_surface") ? fe["head_surface"] : json::object();
  if (!surface.is_object()) return;
  SceneMesh mesh;
  for (const json& v : member(surface, "vertices_m")) mesh.vertices.emplace_back(numbers(v, 3));
  const int n = static_cast<int>(mesh.vertices.size());
  for (const json& t : member(surface, "triangles")) {
    const Eigen::VectorXi corners = numbers(t, 3).cast<int>();
    if (corners.minCoeff() < 0 || corners.maxCoeff() >= n) continue;
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  if (!mesh.triangles.empty()) scene.head = std::move(mesh);
}

/// Head pose of the sample nearest after t, when there are samples.
std::optional<Pose> head_pose(const RunRecord& record, std::int64_t t_ns) {
  if (record.head.empty()) return std::nullopt;
  const auto found = record.head.lower_bound(t_ns);
  return found == record.head.end() ? record.head.rbegin()->second.X_WH : found->second.X_WH;
}

}  // namespace

Scene shapes_of(const RunRecord& record) {
  const json mb = description_of(record, Role::Mb);
  Scene scene;
  for (const json& name : member(mb, "bodies")) {
    scene.bodies.push_back(name.is_string() ? name.get<std::string>() : "");
  }
  add_ellipsoids(scene, mb);
  if (mb.contains("vehicle") && mb["vehicle"].is_object()) add_facets(scene, mb["vehicle"]);
  add_head(scene, description_of(record, Role::Fe));
  return scene;
}

void add_frames(Scene& scene, const RunRecord& record, double t0) {
  const auto buck = std::find(scene.bodies.begin(), scene.bodies.end(), "buck");
  const auto buck_index = static_cast<std::size_t>(buck - scene.bodies.begin());
  for (const auto& [t_ns, poses] : record.bodies) {
    if (poses.size() != scene.bodies.size()) continue;
    SceneFrame frame;
    frame.t = 1e-9 * static_cast<double>(t_ns) - t0;
    frame.X_WB = poses;
    frame.X_WH = head_pose(record, t_ns);
    if (buck_index < poses.size()) frame.X_WV = poses[buck_index];
    scene.frames.push_back(std::move(frame));
  }
}

Scene scene_of(const RunRecord& record, double t0) {
  Scene scene = shapes_of(record);
  add_frames(scene, record, t0);
  return scene;
}

}  // namespace crosswalk::recording
