#include "fe_node/generate/head_shape.h"

#include <algorithm>
#include <cmath>

#include "common/units.h"
#include "fe_node/generate/primitives.h"

namespace crosswalk::fe::generate {

namespace {

constexpr double kReferenceLength = 0.197, kReferenceBreadth = 0.155;  // [gordon1989], m
constexpr double kHalfAxisUp = 0.090, kPosteriorFossa = 0.066, kAnteriorFossa = 0.036;  // m [E]
constexpr double kFossaStepBack = -0.2, kFossaStepFront = 0.6;  // of the half length [E]

/// What a layer of bone has more or less than at the vertex, mm.
struct Regions {
  double frontal, occipital, temporal, base;
};

/// Thickness of a layer of bone in a direction from the cranial centre, m.
double mapped_thickness(const Vec3& d, double vertex, const Regions& more) {
  const double front = std::max(0.0, d.x()), back = std::max(0.0, -d.x());
  const double temporal =
      smooth_step(0.6, 0.98, std::abs(d.y())) * (1.0 - smooth_step(0.0, 0.45, d.z()));
  return 1e-3 * (vertex + more.frontal * front * front + more.occipital * back * back +
                 more.temporal * temporal + more.base * smooth_step(0.3, 0.7, -d.z()));
}

}  // namespace

// The chin alone follows the measured chin height: the three heights of [yu2020, Table 2] are
// computed, not measured, and would else distort the brain case.
HeadShape::HeadShape(const HeadMeasures& measures) : measures_(measures) {
  const double sx = measures.length / kReferenceLength, sy = measures.breadth / kReferenceBreadth;
  scale_ = {sx, sy, std::sqrt(sx * sy)};
}

double HeadShape::half_axis_z(double ux, bool upper) const {
  if (upper) return kHalfAxisUp * scale_.z();
  const double forward = smooth_step(kFossaStepBack, kFossaStepFront, ux);
  return scale_.z() * (kPosteriorFossa + (kAnteriorFossa - kPosteriorFossa) * forward);
}

double HeadShape::half_axis_slope(double ux, bool upper) const {
  if (upper || ux <= kFossaStepBack || ux >= kFossaStepFront) return 0;
  const double width = kFossaStepFront - kFossaStepBack, t = (ux - kFossaStepBack) / width;
  return scale_.z() * (kAnteriorFossa - kPosteriorFossa) * 6 * t * (1 - t) / width;
}

Vec3 HeadShape::spread(const Vec3& u) const {
  return {0.5 * measures_.length * u.x(), 0.5 * measures_.breadth * u.y(),
          half_axis_z(u.x(), u.z() >= 0) * u.z()};
}

// The half-axis depends on the point sought: a few repetitions settle it.
Vec3 HeadShape::on_ball(const Vec3& d) const {
  Vec3 u = d.normalized();
  for (int i = 0; i < 8; ++i)
    u = Vec3(d.x() / (0.5 * measures_.length), d.y() / (0.5 * measures_.breadth),
             d.z() / half_axis_z(u.x(), d.z() >= 0))
            .normalized();
  return u;
}

// Normal of (x/a)^2 + (y/b)^2 + (z/c(x/a))^2 = 1 by its gradient.
HeadShape::Ray HeadShape::ray(const Vec3& u) const {
  const double a = 0.5 * measures_.length, b = 0.5 * measures_.breadth;
  const double c = half_axis_z(u.x(), u.z() >= 0), slope = half_axis_slope(u.x(), u.z() >= 0);
  const Vec3 normal(u.x() / a - u.z() * u.z() * slope / (a * c), u.y() / b, u.z() / c);
  const Vec3 p = spread(u);
  constexpr double kMostOblique = 1.6;
  Ray ray{.direction = p.normalized(), .skin = p.norm()};
  const double oblique = std::min(normal.norm() / normal.dot(ray.direction), kMostOblique);
  ray.skull_outer = ray.skin - oblique * scalp_thickness(ray.direction);
  ray.skull_inner = ray.skull_outer - oblique * skull_thickness(ray.direction);
  ray.brain = ray.skull_inner - oblique * kCsfThickness;
  return ray;
}

double HeadShape::scalp_thickness(const Vec3& d) {
  const double temporal =
      smooth_step(0.55, 0.95, std::abs(d.y())) * (1.0 - smooth_step(0.1, 0.5, d.z()));
  const double occipital = smooth_step(0.5, 0.95, -d.x()) * (1.0 - smooth_step(0.2, 0.6, d.z()));
  return 0.005 + 0.004 * temporal + 0.002 * occipital;
}

// Skull, outer and inner table, mm: vertex 6.8, 1.8, 1.4; frontal 7.4, 2.0, 1.5;
// occipital 8.0, 2.2, 1.7; temporal 4.5, 1.6, 1.3; base 9.3, 2.0, 1.5. Layer medians over all
// regions are 2.4 (outer) and 1.7 mm (inner) [zwirner2021].
double HeadShape::skull_thickness(const Vec3& d) {
  return mapped_thickness(d, 6.8, {0.6, 1.2, -2.3, 2.5});
}
double HeadShape::outer_table_thickness(const Vec3& d) {
  return mapped_thickness(d, 1.8, {0.2, 0.4, -0.2, 0.2});
}
double HeadShape::inner_table_thickness(const Vec3& d) {
  return mapped_thickness(d, 1.4, {0.1, 0.3, -0.1, 0.1});
}

double HeadShape::face_height(double z) const {
  return (z - menton_z()) / (centre().z() - 0.005 - menton_z());
}

Vec3 HeadShape::face_outline(double height, double depth, double side, double back) const {
  const double h = std::clamp(height, 0.0, 1.0);
  const double half_width = scale_.y() * (0.042 + 0.024 * std::min(h / 0.7, 1.0));
  const double front = std::min(0.0865 * scale_.x() + 0.008 * std::sin(kPi * h),
                                0.5 * measures_.length - (h > 0.95 ? 0.004 : 0.0));
  constexpr double kStraight = 0.35;  // share of the depth with parallel sides
  if (depth <= kStraight) return {back + (front - back) * depth, side * half_width, 0};
  const Vec3 disc = square_to_disc((depth - kStraight) / (1 - kStraight), side, 0.85);
  return {back + (front - back) * (kStraight + (1 - kStraight) * disc.x()), half_width * disc.y(),
          0};
}

}  // namespace crosswalk::fe::generate
