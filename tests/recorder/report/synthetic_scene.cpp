#include <cmath>
#include <numbers>

#include "tests/recorder/report/synthetic_run.h"

namespace crosswalk::recording::synthetic {
namespace {

constexpr double kCarSpeed = 11.1;  // m/s

struct Part {
  const char* name;
  Vec3 centre;  // m, standing
  Vec3 semi_axes;
};

const std::vector<Part>& parts() {
  static const std::vector<Part> list{{"head", {0.02, 0.00, 1.66}, {0.095, 0.075, 0.125}},
                                      {"neck", {0.00, 0.00, 1.50}, {0.055, 0.055, 0.075}},
                                      {"thorax", {0.00, 0.00, 1.26}, {0.115, 0.165, 0.220}},
                                      {"abdomen", {0.00, 0.00, 1.08}, {0.110, 0.145, 0.130}},
                                      {"pelvis", {0.00, 0.00, 0.94}, {0.120, 0.170, 0.120}},
                                      {"thigh_r", {-0.02, -0.09, 0.68}, {0.075, 0.075, 0.240}},
                                      {"thigh_l", {0.04, 0.09, 0.68}, {0.075, 0.075, 0.240}},
                                      {"shank_r", {-0.08, -0.09, 0.28}, {0.055, 0.055, 0.240}},
                                      {"shank_l", {0.08, 0.09, 0.28}, {0.055, 0.055, 0.240}},
                                      {"foot_r", {-0.04, -0.09, 0.05}, {0.130, 0.045, 0.050}},
                                      {"foot_l", {0.14, 0.09, 0.05}, {0.130, 0.045, 0.050}},
                                      {"upper_arm_r", {0.04, -0.21, 1.27}, {0.050, 0.050, 0.160}},
                                      {"upper_arm_l", {0.04, 0.21, 1.27}, {0.050, 0.050, 0.160}},
                                      {"lower_arm_r", {0.15, -0.12, 1.08}, {0.130, 0.080, 0.040}},
                                      {"lower_arm_l", {0.15, 0.12, 1.08}, {0.130, 0.080, 0.040}}};
  return list;
}

SceneMesh head_surface() {
  constexpr int kRings = 12;
  constexpr int kSectors = 20;
  SceneMesh mesh;
  for (int i = 0; i <= kRings; ++i) {
    const double polar = std::numbers::pi * i / kRings;
    for (int j = 0; j < kSectors; ++j) {
      const double azimuth = 2.0 * std::numbers::pi * j / kSectors;
      mesh.vertices.emplace_back(0.10 * std::sin(polar) * std::cos(azimuth),
                                 0.078 * std::sin(polar) * std::sin(azimuth),
                                 0.125 * std::cos(polar));
    }
  }
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSectors; ++j) {
      const int a = i * kSectors + j;
      const int b = i * kSectors + (j + 1) % kSectors;
      mesh.triangles.push_back({a, a + kSectors, b});
      mesh.triangles.push_back({b, a + kSectors, b + kSectors});
    }
  }
  return mesh;
}

/// The figure carried by the car from its pelvis, tipping towards the car about x.
Pose placed(const Part& part, double t) {
  const double tip = 1.45 * std::clamp((t - 0.015) / 0.12, 0.0, 1.1);
  const double shove = 0.75 * kCarSpeed * std::max(0.0, t - 0.01);
  const Vec3 hinge(0, -0.05, 0.85);
  const double share = part.centre.z() > hinge.z() ? 1.0 : 0.45;
  const Quat turn(Eigen::AngleAxisd(share * tip, Vec3::UnitX()));
  const Vec3 shift(0, shove, 0.15 * std::sin(std::min(tip, 1.5)));
  return {turn, turn * (part.centre - hinge) + hinge + shift};
}

}  // namespace

Scene scene() {
  Scene scene;
  for (const Part& part : parts()) {
    if (std::string(part.name) != "head") {
      scene.ellipsoids.push_back(
          {static_cast<int>(scene.bodies.size()), part.name, Pose{}, part.semi_axes});
    }
    scene.bodies.emplace_back(part.name);
  }
  scene.head = head_surface();
  const auto facet = [&scene](const char* name, double y0, double z0, double y1, double z1) {
    scene.facets.push_back({name, {y0, z0}, {y1, z1}, 0.75});
  };
  facet("spoiler", -0.03, 0.25, -0.01, 0.40);
  facet("bumper", -0.01, 0.40, 0.00, 0.55);
  facet("hood_leading_edge", 0.00, 0.55, -0.14, 0.74);
  facet("hood", -0.14, 0.74, -1.05, 0.95);
  facet("windshield", -1.05, 0.95, -1.75, 1.35);
  for (int i = 0; i <= 220; ++i) {
    SceneFrame frame;
    frame.t = 0.001 * i;
    for (const Part& part : parts()) frame.X_WB.push_back(placed(part, frame.t));
    frame.X_WH = frame.X_WB.front();
    frame.X_WV.p = Vec3(0, -0.16 + kCarSpeed * frame.t, 0);
    scene.frames.push_back(frame);
  }
  return scene;
}

}  // namespace crosswalk::recording::synthetic
