#include "recorder/aftermath.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/units.h"
#include "recorder/description.h"

namespace crosswalk::recording {

namespace {

constexpr double kRoadForce = 50;      // N, as for the head on the car
constexpr double kBeforeTouch = 1e-3;  // s: the touch itself belongs to the road
constexpr double kSpeedSpan = 10e-3;   // s, over which a speed is taken from positions

double seconds(std::int64_t t_ns) { return 1e-9 * static_cast<double>(t_ns); }

std::vector<double> body_masses(const RunRecord& record) {
  const nlohmann::json mb = description_of(record, Role::Mb);
  std::vector<double> masses;
  if (!mb.contains("masses_kg") || !mb["masses_kg"].is_array()) return masses;
  for (const auto& mass : mb["masses_kg"]) {
    if (!mass.is_number() || !(mass.get<double>() > 0)) return {};
    masses.push_back(mass.get<double>());
  }
  return masses;
}

struct Course {
  std::vector<double> t;  ///< s after t0
  std::vector<Vec3> p;    ///< m, W
};

Course centre_of_mass(const RunRecord& record, const std::vector<double>& masses, double t0) {
  Course course;
  for (const auto& [t_ns, poses] : record.bodies) {
    const double t = seconds(t_ns) - t0;
    if (t < 0 || poses.size() < masses.size()) continue;
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      sum += masses[i] * poses[i].p;
      mass += masses[i];
    }
    course.t.push_back(t);
    course.p.push_back(sum / mass);
  }
  return course;
}

std::optional<Throw> throw_of(const Course& course) {
  const std::size_t n = course.t.size();
  if (n < 2 || course.t.back() - course.t.front() < kSpeedSpan) return std::nullopt;
  Throw out;
  const Vec3 moved = course.p.back() - course.p.front();
  out.distance = moved.y();
  out.sideways = moved.x();
  out.end_time = course.t.back();
  for (const Vec3& p : course.p) out.highest = std::max(out.highest, p.z());
  // Speed over the span that ends at each instant; the last one that is too fast ends the motion.
  std::size_t from = 0;
  double rest = course.t.front();
  for (std::size_t i = 1; i < n; ++i) {
    while (from + 1 < i && course.t[i] - course.t[from + 1] >= kSpeedSpan) ++from;
    if (course.t[i] - course.t[from] < kSpeedSpan) continue;
    out.end_speed = (course.p[i] - course.p[from]).norm() / (course.t[i] - course.t[from]);
    if (out.end_speed > kRestSpeed) rest = course.t[i];
  }
  if (out.end_speed <= kRestSpeed) out.rest_time = rest;
  return out;
}

/// The part of a resultant with t in [from, to), as HIC15 and peak.
void rate(const Series& a, double from, double to, WindowMaximum& HIC15, double& peak_g) {
  Series part;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.t[i] < from || a.t[i] >= to) continue;
    part.t.push_back(a.t[i]);
    part.y.push_back(a.y[i]);
    peak_g = std::max(peak_g, a.y[i] / kStandardGravity);
  }
  if (part.size() > 1) HIC15 = hic(part, 0.015);
}

std::optional<RoadImpact> road_impact(const RunRecord& record, const RunChannels& channels) {
  const auto names = run_names(record).contact_pairs;
  const auto pair = std::find(names.begin(), names.end(), "ground_head");
  if (pair == names.end()) return std::nullopt;
  const auto index = static_cast<std::size_t>(pair - names.begin());
  std::optional<RoadImpact> out;
  for (const auto& [t_ns, forces] : record.contact) {
    if (index >= forces.size()) continue;
    const double force = forces[index].norm();
    if (!out && force > kRoadForce) {
      out.emplace();
      out->time = seconds(t_ns) - channels.t0;
    }
    if (out) out->peak_force = std::max(out->peak_force, force);
  }
  if (!out || !channels.head.acceleration) return out;
  const VectorSeries& a = *channels.head.acceleration;
  const Series resultant{a.t, a.magnitude()};
  const double touch = out->time - kBeforeTouch;
  rate(resultant, a.t.front(), touch, out->HIC15_before, out->peak_g_before);
  rate(resultant, touch, a.t.back() + 1, out->HIC15, out->peak_g);
  return out;
}

}  // namespace

Aftermath aftermath_of(const RunRecord& record, const RunChannels& channels) {
  Aftermath out;
  if (!channels.has_first_contact) return out;
  out.head_on_road = road_impact(record, channels);
  if (const std::vector<double> masses = body_masses(record); !masses.empty()) {
    out.thrown = throw_of(centre_of_mass(record, masses, channels.t0));
  }
  return out;
}

}  // namespace crosswalk::recording
