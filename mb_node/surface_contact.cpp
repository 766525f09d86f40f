#include "mb_node/surface_contact.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "common/units.h"

namespace crosswalk::mb {
namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

constexpr int kNewtonSteps = 30;
constexpr double kConverged = 1e-12;    // rad
constexpr double kEndTolerance = 0.01;  // m: how far past a closed end the deepest point may lie
constexpr double kFreeFan =
    60 * kDegree;  // normals around a free end: the surface curls away there [E]

double support(const Mat3& A, const Vec3& n) { return std::sqrt(n.dot(A * n)); }

Overlap make_overlap(const PosedEllipsoid& e, const Vec3& n, double depth) {
  return {depth, n, e.centre - e.A * n / support(e.A, n)};
}

/// The part of an ellipsoid seen along an axis: an ellipse in the plane across it.
struct Ellipse {
  Vec2 centre;
  Mat2 A;
  double height(const Vec2& n) const { return std::sqrt(n.dot(A * n)); }
  Vec2 deepest(const Vec2& n) const { return centre - A * n / height(n); }
};

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vec2 turned(const Vec2& n) { return {-n.y(), n.x()}; }

/// Overlap along n with a point (a vertex of the front): g and its slope with the angle of n.
double vertex_overlap(const Ellipse& e, const Vec2& vertex, const Vec2& n) {
  return e.height(n) - (e.centre - vertex).dot(n);
}
double vertex_slope(const Ellipse& e, const Vec2& vertex, const Vec2& n) {
  return -(e.deepest(n) - vertex).dot(turned(n));
}

/// Normal of the smallest overlap between two normals less than half a turn apart around a vertex,
/// if it lies inside: root of the slope on the arc by the bracketed secant (Illinois).
std::optional<Vec2> vertex_minimum(const Ellipse& e, const Vec2& vertex, const Vec2& from,
                                   const Vec2& to) {
  double g_low = vertex_slope(e, vertex, from), g_high = vertex_slope(e, vertex, to);
  if (g_low >= 0 || g_high <= 0) return std::nullopt;
  const double scale = g_high - g_low;
  double low = 0, high = 1;
  Vec2 n = from;
  int kept = 0;  // which end stayed: its value is halved when it stays twice
  for (int i = 0; i < 60 && high - low > 1e-14; ++i) {
    const double s = high - g_high * (high - low) / (g_high - g_low);
    n = ((1 - s) * from + s * to).normalized();
    const double g = vertex_slope(e, vertex, n);
    if (std::abs(g) < 1e-14 * scale) break;
    if (g > 0) {
      high = s;
      g_high = g;
      if (kept == -1) g_low *= 0.5;
      kept = -1;
    } else {
      low = s;
      g_low = g;
      if (kept == 1) g_high *= 0.5;
      kept = 1;
    }
  }
  return n;
}

double angle_of(const Vec2& n) { return std::atan2(n.y(), n.x()); }

}  // namespace

PosedEllipsoid::PosedEllipsoid(const Vec3& p_W, const Mat3& R_WE, const Vec3& semi_axes)
    : centre(p_W), A(R_WE * semi_axes.cwiseAbs2().asDiagonal() * R_WE.transpose()) {}

std::optional<Overlap> overlap_with_plane(const PosedEllipsoid& e, const Vec3& normal,
                                          const Vec3& on_plane) {
  const double depth = support(e.A, normal) - (e.centre - on_plane).dot(normal);
  if (depth <= 0) return std::nullopt;
  return make_overlap(e, normal, depth);
}

std::optional<Overlap> overlap_with_cylinder(const PosedEllipsoid& e, const Vec3& on_axis,
                                             const Vec3& axis, double radius) {
  // In the plane across the axis: ellipse against circle, Newton on the angle of the normal.
  const Vec3 x = axis.unitOrthogonal();
  const Vec3 y = axis.cross(x);
  Eigen::Matrix<double, 3, 2> P;
  P << x, y;
  const Ellipse ellipse{P.transpose() * (e.centre - on_axis), P.transpose() * e.A * P};
  double angle = angle_of(ellipse.centre);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Vec2 n = direction(angle), t = turned(n);
    const double h = ellipse.height(n);
    if (h + radius - ellipse.centre.dot(n) <= 0) return std::nullopt;
    const double first = n.dot(ellipse.A * t) / h - ellipse.centre.dot(t);
    const double ht = n.dot(ellipse.A * t) / h;
    const double second =
        (t.dot(ellipse.A * t) - n.dot(ellipse.A * n) - ht * ht) / h + ellipse.centre.dot(n);
    const double step = second > 0 ? -first / second : -std::copysign(0.1, first);
    angle += std::clamp(step, -0.3, 0.3);
    if (std::abs(step) < kConverged) break;
  }
  const Vec2 n = direction(angle);
  return make_overlap(e, P * n, ellipse.height(n) + radius - ellipse.centre.dot(n));
}

std::optional<Overlap> overlap_with_ellipsoid(const PosedEllipsoid& first,
                                              const PosedEllipsoid& second) {
  const Vec3 d = first.centre - second.centre;
  if (d.squaredNorm() < 1e-16) return std::nullopt;  // concentric: no direction out
  Vec3 n = d.normalized();
  double g = 0;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double h1 = support(first.A, n), h2 = support(second.A, n);
    g = h1 + h2 - d.dot(n);
    if (g <= 0) return std::nullopt;
    // Newton on the unit sphere: tangent gradient and Hessian of the homogeneous g.
    const Vec3 a1 = first.A * n / h1, a2 = second.A * n / h2;
    const Vec3 t1 = n.unitOrthogonal();
    Eigen::Matrix<double, 3, 2> T;
    T << t1, n.cross(t1);
    const Vec2 gradient = T.transpose() * (a1 + a2 - d);
    const Mat3 H = (first.A - a1 * a1.transpose()) / h1 + (second.A - a2 * a2.transpose()) / h2;
    Mat2 hessian = T.transpose() * H * T - g * Mat2::Identity();
    // Keep the step downhill where the overlap is deeper than the curvature allows.
    const double lowest =
        hessian.trace() / 2 -
        std::sqrt(std::max(0.0, std::pow(hessian.trace() / 2, 2) - hessian.determinant()));
    const double scale = h1 + h2;
    if (lowest < 0.05 * scale) hessian += (0.05 * scale - lowest) * Mat2::Identity();
    Vec2 step = -hessian.inverse() * gradient;
    if (step.norm() > 0.5) step *= 0.5 / step.norm();
    n = (n + T * step).normalized();
    if (step.norm() < kConverged) break;
  }
  g = support(first.A, n) + support(second.A, n) - d.dot(n);
  if (g <= 0) return std::nullopt;
  return make_overlap(first, n, g);
}

std::vector<FrontChain> convex_chains(const VehicleFront& front) {
  constexpr double kJoined = 1e-9;  // m
  std::vector<FrontChain> chains;
  for (int i = 0; i < static_cast<int>(front.facets.size()); ++i) {
    const FrontFacet& facet = front.facets[i];
    const bool is_joined = i > 0 && (front.facets[i - 1].end - facet.begin).norm() < kJoined;
    // Going up and to the rear the normal of an outward bend turns from +y towards +z.
    const bool is_convex = is_joined && front.facets[i - 1].normal.x() * facet.normal.y() -
                                                front.facets[i - 1].normal.y() * facet.normal.x() >=
                                            0;
    if (!is_convex) {
      if (!chains.empty()) chains.back().is_open_end = !is_joined;
      chains.push_back({{}, !is_joined, true});
    }
    chains.back().facets.push_back(i);
  }
  return chains;
}

std::optional<FrontOverlap> overlap_with_front(const PosedEllipsoid& e, const VehicleFront& front,
                                               const FrontChain& chain, const Pose& X_WF) {
  const Mat3 R = X_WF.R();
  const Vec3 centre_F = R.transpose() * (e.centre - X_WF.p);
  const Mat3 A_F = R.transpose() * e.A * R;
  const Ellipse ellipse{centre_F.tail<2>(), A_F.bottomRightCorner<2, 2>()};
  double best = std::numeric_limits<double>::infinity();
  Vec2 n = Vec2::Zero();
  int best_facet = -1;
  // Normals of the facets; any gap ends the search.
  for (const int i : chain.facets) {
    const FrontFacet& facet = front.facets[i];
    const double g = vertex_overlap(ellipse, facet.begin, facet.normal);
    if (g <= 0) return std::nullopt;
    if (g >= best) continue;
    best = g;
    n = facet.normal;
    best_facet = i;
  }
  // Normals around the vertices between them, and around free ends.
  const auto try_normal = [&](const Vec2& vertex, const Vec2& normal, int facet) {
    const double g = vertex_overlap(ellipse, vertex, normal);
    if (g >= best) return;
    best = g;
    n = normal;
    best_facet = facet;
  };
  const auto try_vertex = [&](const Vec2& vertex, const Vec2& from, const Vec2& to, int facet) {
    const std::optional<Vec2> found = vertex_minimum(ellipse, vertex, from, to);
    if (found) try_normal(vertex, *found, facet);
  };
  for (std::size_t k = 0; k + 1 < chain.facets.size(); ++k) {
    const FrontFacet& below = front.facets[chain.facets[k]];
    const FrontFacet& above = front.facets[chain.facets[k + 1]];
    try_vertex(below.end, below.normal, above.normal, chain.facets[k]);
  }
  const FrontFacet& first = front.facets[chain.facets.front()];
  const FrontFacet& last = front.facets[chain.facets.back()];
  const Eigen::Rotation2Dd fan(kFreeFan);
  const Vec2 under = fan.inverse() * first.normal;
  // Behind the last part of the front a roof goes on level [E].
  const bool is_rear = chain.facets.back() + 1 == static_cast<int>(front.facets.size());
  const Vec2 over = is_rear && last.normal.x() > 0 ? Vec2::UnitY() : fan * last.normal;
  if (chain.is_open_begin) {
    if (vertex_overlap(ellipse, first.begin, under) <= 0) return std::nullopt;
    try_vertex(first.begin, under, first.normal, chain.facets.front());
  }
  if (chain.is_open_end) {
    if (vertex_overlap(ellipse, last.end, over) <= 0) return std::nullopt;
    try_vertex(last.end, last.normal, over, chain.facets.back());
  }
  if (best <= 0) return std::nullopt;
  const Vec2 deepest = ellipse.deepest(n);
  // Facets in one plane: the one that the deepest point lies on.
  while (best_facet != chain.facets.back()) {
    const FrontFacet& here = front.facets[best_facet];
    const FrontFacet& above = front.facets[best_facet + 1];
    const bool is_one_plane = here.normal.dot(above.normal) > 1 - 1e-12;
    if (!is_one_plane || (deepest - here.end).dot(here.end - here.begin) <= 0) break;
    ++best_facet;
  }
  // Past a closed end the next chain takes over.
  const double before =
      (deepest - first.begin).dot(first.end - first.begin) / (first.end - first.begin).norm();
  const double after =
      (deepest - last.end).dot(last.end - last.begin) / (last.end - last.begin).norm();
  if (before < -kEndTolerance || after > kEndTolerance) {
    const bool is_first = best_facet == chain.facets.front() && before < -kEndTolerance;
    const bool is_last = best_facet == chain.facets.back() && after > kEndTolerance;
    if (is_first && !chain.is_open_begin) return std::nullopt;
    if (is_last && !chain.is_open_end) return std::nullopt;
  }
  // The limits of the fans count as well: behind a free end the depth falls to nothing steadily.
  if (chain.is_open_begin) try_normal(first.begin, under, chain.facets.front());
  if (chain.is_open_end) try_normal(last.end, over, chain.facets.back());
  const Vec3 normal = R * Vec3(0, n.x(), n.y());
  const FrontOverlap found{make_overlap(e, normal, best), best_facet};
  const double lateral = (R.transpose() * (found.overlap.point - X_WF.p)).x();
  if (std::abs(lateral) > front.facets[best_facet].half_width) return std::nullopt;
  return found;
}

}  // namespace crosswalk::mb
