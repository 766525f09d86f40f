#include "common/body_description.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/units.h"

namespace crosswalk {
namespace {

bool is_head_or_neck(const std::string& segment) {
  return segment == "head" || segment == "neck_low" || segment == "neck_up";
}

/// Half extents of the trunk along an axis (0: x, 1: y) at a height: the widest ellipsoid there.
double extent_at(const BodyDescription& body, double z, int axis, double direction) {
  double extent = 0;
  for (const SurfaceEllipsoid& e : body.ellipsoids) {
    const std::string& segment = body.segments[e.segment].name;
    if (segment != "pelvis" && segment.find("lumbar") != 0 && segment.find("torso") != 0) continue;
    const double s = (z - e.centre.z()) / e.semi_axes.z();
    if (std::abs(s) >= 1) continue;
    extent =
        std::max(extent, direction * e.centre[axis] + e.semi_axes[axis] * std::sqrt(1 - s * s));
  }
  return extent;
}

}  // namespace

int BodyDescription::find_segment(std::string_view wanted) const {
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].name == wanted) return static_cast<int>(i);
  }
  return -1;
}

int BodyDescription::find_ellipsoid(std::string_view wanted) const {
  for (std::size_t i = 0; i < ellipsoids.size(); ++i) {
    if (ellipsoids[i].name == wanted) return static_cast<int>(i);
  }
  return -1;
}

double BodyDescription::total_mass() const {
  double mass = 0;
  for (const Segment& segment : segments) mass += segment.mass;
  return mass;
}

BodyDescription without_head_and_neck(const BodyDescription& body) {
  BodyDescription out = body;
  out.segments.clear();
  out.ellipsoids.clear();
  std::vector<int> segment_index(body.segments.size(), -1);
  std::vector<int> ellipsoid_index(body.ellipsoids.size(), -1);
  for (std::size_t i = 0; i < body.segments.size(); ++i) {
    if (is_head_or_neck(body.segments[i].name)) continue;
    segment_index[i] = static_cast<int>(out.segments.size());
    out.segments.push_back(body.segments[i]);
    Segment& segment = out.segments.back();
    if (segment.parent >= 0) segment.parent = segment_index[segment.parent];
  }
  for (std::size_t i = 0; i < body.ellipsoids.size(); ++i) {
    if (segment_index[body.ellipsoids[i].segment] < 0) continue;
    ellipsoid_index[i] = static_cast<int>(out.ellipsoids.size());
    out.ellipsoids.push_back(body.ellipsoids[i]);
    out.ellipsoids.back().segment = segment_index[body.ellipsoids[i].segment];
  }
  for (Bushing& bushing : out.bushings) {
    bushing.segment = segment_index[bushing.segment];
    bushing.base = segment_index[bushing.base];
  }
  out.self_contacts.clear();
  for (const auto& [a, b] : body.self_contacts) {
    if (ellipsoid_index[a] >= 0 && ellipsoid_index[b] >= 0) {
      out.self_contacts.emplace_back(ellipsoid_index[a], ellipsoid_index[b]);
    }
  }
  return out;
}

// Taken as a tape and calipers would on the ellipsoids and joint centres of the model; the offsets
// from joint centres to surface landmarks are those of the height equations.
Anthropometry measured_on(const BodyDescription& body) {
  const auto joint = [&](const char* name) -> const Vec3& {
    const int i = body.find_segment(name);
    CW_ASSERT(i >= 0);
    return body.segments[i].joint_centre;
  };
  const auto surface = [&](const char* name) {
    const int i = body.find_ellipsoid(name);
    return i >= 0 ? body.ellipsoids[i] : SurfaceEllipsoid{};
  };
  const auto girth = [&](const char* name) { return 2 * kPi * surface(name).semi_axes.x(); };
  const auto depth = [&](double z) { return extent_at(body, z, 0, 1) + extent_at(body, z, 0, -1); };
  const auto breadth = [&](double z) { return 2 * extent_at(body, z, 1, 1); };
  Anthropometry a;
  a.mass = body.total_mass();
  const SurfaceEllipsoid cranium = surface("cranium");
  const double H = cranium.centre.z() + cranium.semi_axes.z();
  a.standing_height = H;
  const double z_c7t1 = joint("neck_low").z(), z_hip = joint("femur_1_l").z();
  const double z_sjc = joint("upper_arm_l").z(), z_elbow = joint("forearm_prox_l").z();
  const double z_chest = surface("thorax_up").centre.z(), z_waist = joint("lumbar_up").z();
  a.shoulder_height = z_c7t1 + 0.0114 * H;
  a.armpit_height = z_sjc - 0.0385 * H;
  a.waist_height = z_waist;
  a.seated_height = 1.056 * H - z_hip;
  a.head_length = 2 * cranium.semi_axes.x();
  a.head_breadth = 2 * cranium.semi_axes.y();
  const SurfaceEllipsoid face = surface("face");
  a.head_to_chin_height = H - (face.centre.z() - face.semi_axes.z());
  a.neck_circumference = girth("neck_low");
  a.shoulder_breadth = 2 * (joint("upper_arm_l").y() + 0.022);
  a.chest_depth = depth(z_chest);
  a.chest_breadth = breadth(z_chest);
  a.waist_depth = depth(z_waist);
  a.waist_breadth = breadth(z_waist);
  a.buttock_depth = depth(z_hip);
  a.hip_breadth_standing = breadth(z_hip);
  a.shoulder_to_elbow_length = (z_sjc - z_elbow) / 0.80;
  const SurfaceEllipsoid fingers = surface("fingers_l");
  if (body.find_segment("hand_l") >= 0) {
    const double z_wrist = joint("hand_l").z();
    const double tip = fingers.centre.z() - fingers.semi_axes.z();
    a.forearm_hand_length = z_elbow - tip + 0.0125 * H;
    a.hand_length = z_wrist - tip;
    a.hand_breadth = 2 * surface("hand_l").semi_axes.x();
    a.hand_depth = 2 * surface("hand_l").semi_axes.y();
    a.wrist_circumference = girth("farm_dist_l");
  }
  a.biceps_circumference = girth("uarm_prox_l");
  a.elbow_circumference = girth("uarm_dist_l");
  a.forearm_circumference = girth("farm_prox_l");
  a.knee_height_seated = joint("tibia_1_l").z() + surface("knee_l").semi_axes.x();
  a.thigh_circumference = girth("thigh_1_l");
  a.upper_leg_circumference = girth("thigh_3_l");
  a.knee_circumference = girth("knee_l");
  a.calf_circumference = girth("leg_2_l");
  a.ankle_circumference = girth("leg_5_l");
  a.ankle_height_outside = joint("talus_l").z() / 0.80;
  const SurfaceEllipsoid medial = surface("ball_med_l"), lateral = surface("ball_lat_l");
  a.foot_breadth =
      lateral.centre.y() + lateral.semi_axes.y() - medial.centre.y() + medial.semi_axes.y();
  const SurfaceEllipsoid heel = surface("heel_l"), toes = surface("toes_l");
  a.foot_length = toes.centre.x() + toes.semi_axes.x() - heel.centre.x() + heel.semi_axes.x();
  return a;
}

}  // namespace crosswalk
