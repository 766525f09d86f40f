#include "fe_node/contact/segment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crosswalk::fe {
namespace {

/// Barycentric weights of the point of triangle abc closest to p [ericson2005, 5.1.5].
Vec3 closest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double s = 1 / (va + vb + vc);
  return {va * s, vb * s, vc * s};
}

Vec3 centre_of(const FacetCorners& x) { return 0.25 * (x[0] + x[1] + x[2] + x[3]); }

}  // namespace

Projection closest_point(const Vec3& p, const FacetCorners& x, bool is_triangle) {
  Projection out;
  if (is_triangle) {
    const Vec3 w = closest_weights(p, x[0], x[1], x[2]);
    out.weight = {w[0], w[1], w[2], 0};
    out.point = w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
    out.normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    out.distance = (p - out.point).norm();
    return out;
  }
  const Vec3 centre = centre_of(x);
  double best = std::numeric_limits<double>::infinity();
  Vec3 best_weight = Vec3::Zero();
  for (int s = 0; s < 4; ++s) {
    const Vec3& a = x[s];
    const Vec3& b = x[(s + 1) % 4];
    const Vec3 w = closest_weights(p, a, b, centre);
    const Vec3 point = w[0] * a + w[1] * b + w[2] * centre;
    const double d2 = (p - point).squaredNorm();
    if (d2 < best) {
      best = d2;
      best_weight = w;
      out.sector = s;
      out.point = point;
    }
  }
  out.weight.fill(0.25 * best_weight[2]);
  out.weight[out.sector] += best_weight[0];
  out.weight[(out.sector + 1) % 4] += best_weight[1];
  const Vec3& a = x[out.sector];
  out.normal = (x[(out.sector + 1) % 4] - a).cross(centre - a).normalized();
  out.distance = std::sqrt(best);
  return out;
}

DistanceBounds distance_bounds(const Vec3& p, const FacetCorners& x) {
  const Vec3 centre = centre_of(x);
  double radius2 = 0;
  for (const Vec3& corner : x) radius2 = std::max(radius2, (corner - centre).squaredNorm());
  const double most = (p - centre).norm();
  return {most - std::sqrt(radius2), most};
}

std::array<Vec3, 4> weight_gradients(const FacetCorners& x, bool is_triangle, int sector) {
  const int i = is_triangle ? 0 : sector, j = is_triangle ? 1 : (sector + 1) % 4;
  const Vec3 a = x[i], b = x[j], c = is_triangle ? x[2] : centre_of(x);
  const Vec3 area = (b - a).cross(c - a);  // twice, along the normal
  const Vec3 n = area / area.squaredNorm();
  const Vec3 ga = n.cross(c - b), gb = n.cross(a - c), gc = n.cross(b - a);
  std::array<Vec3, 4> g;
  if (is_triangle) return {ga, gb, gc, Vec3::Zero()};
  g.fill(0.25 * gc);
  g[i] += ga;
  g[j] += gb;
  return g;
}

}  // namespace crosswalk::fe
