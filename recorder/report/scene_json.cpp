#include "recorder/report/scene_json.h"

#include <nlohmann/json.hpp>

#include "recorder/report/image.h"

namespace crosswalk::recording {
namespace {

nlohmann::ordered_json triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
nlohmann::ordered_json quaternion(const Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }

void append(std::vector<float>& out, const Pose& X) {
  for (const double v : {X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z()}) {
    out.push_back(static_cast<float>(v));
  }
}

std::string base64_of(const std::vector<float>& values) {
  return base64(values.data(), values.size() * sizeof(float));
}

nlohmann::ordered_json mesh_json(const SceneMesh& mesh) {
  std::vector<float> vertices;
  for (const Vec3& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(v[k]));
  }
  std::vector<std::uint32_t> corners;
  for (const auto& t : mesh.triangles) {
    for (const int corner : t) corners.push_back(static_cast<std::uint32_t>(corner));
  }
  return {{"vertices", base64_of(vertices)},
          {"triangles", base64(corners.data(), corners.size() * sizeof(std::uint32_t))}};
}

}  // namespace

std::string poses_base64(const Scene& scene) {
  std::vector<float> poses;
  for (const SceneFrame& frame : scene.frames) {
    poses.push_back(static_cast<float>(frame.t));
    for (const Pose& X : frame.X_WB) append(poses, X);
    append(poses, frame.X_WH.value_or(Pose{}));
    append(poses, frame.X_WV);
  }
  return base64_of(poses);
}

nlohmann::ordered_json scene_json(const Scene& scene) {
  nlohmann::ordered_json out;
  out["bodies"] = scene.bodies;
  out["ellipsoids"] = nlohmann::json::array();
  for (const SceneEllipsoid& e : scene.ellipsoids) {
    out["ellipsoids"].push_back({{"body", e.body},
                                 {"name", e.name},
                                 {"p", triple(e.X_BE.p)},
                                 {"q", quaternion(e.X_BE.q)},
                                 {"semi_axes", triple(e.semi_axes)}});
  }
  out["facets"] = nlohmann::json::array();
  for (const SceneFacet& f : scene.facets) {
    out["facets"].push_back({{"component", f.component},
                             {"begin", {f.begin.x(), f.begin.y()}},
                             {"end", {f.end.x(), f.end.y()}},
                             {"half_width", f.half_width}});
  }
  if (scene.head) out["head"] = mesh_json(*scene.head);
  out["frames"] = poses_base64(scene);
  return out;
}

}  // namespace crosswalk::recording
