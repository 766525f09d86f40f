#include "fe_node/deck/element_measure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace crosswalk::fe {

namespace {

using Corner = std::array<int, 4>;  ///< a node and its three neighbours, right-handed

constexpr std::array<Corner, 8> kHexCorners{{{0, 1, 3, 4},
                                             {1, 2, 0, 5},
                                             {2, 3, 1, 6},
                                             {3, 0, 2, 7},
                                             {4, 7, 5, 0},
                                             {5, 4, 6, 1},
                                             {6, 5, 7, 2},
                                             {7, 6, 4, 3}}};
constexpr std::array<Corner, 6> kPentaCorners{
    {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}};
constexpr std::array<Corner, 4> kPyramidCorners{
    {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};
constexpr std::array<Corner, 1> kTetCorners{{{0, 1, 2, 3}}};

double corner_jacobian(std::span<const Vec3> x, const Corner& corner) {
  const Vec3& origin = x[static_cast<std::size_t>(corner[0])];
  const auto edge = [&](int i) -> Vec3 {
    return x[static_cast<std::size_t>(corner[static_cast<std::size_t>(i)])] - origin;
  };
  return edge(1).cross(edge(2)).dot(edge(3));
}

/// Six times the volume under a quadrilateral or triangular face as seen from the origin; the faces
/// of a closed surface with outward normals add up to six times its volume. A quadrilateral is
/// taken as the mean of its two splits, which is exact for the bilinear face.
double face_term(std::span<const Vec3> x, std::span<const int> face) {
  const auto at = [&](std::size_t i) -> const Vec3& {
    return x[static_cast<std::size_t>(face[i])];
  };
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    return at(a).cross(at(b)).dot(at(c));
  };
  if (face.size() == 3) return triangle(0, 1, 2);
  return 0.5 * (triangle(0, 1, 2) + triangle(0, 2, 3) + triangle(0, 1, 3) + triangle(1, 2, 3));
}

double volume(SolidShape shape, std::span<const Vec3> x) {
  static constexpr int kHex[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                     {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  static constexpr int kPentaQuads[3][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  static constexpr int kPentaTriangles[2][3] = {{0, 2, 1}, {3, 4, 5}};
  static constexpr int kPyramidBase[4] = {0, 3, 2, 1};
  static constexpr int kPyramidSides[4][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  static constexpr int kTet[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  double six_volumes = 0;
  switch (shape) {
    case SolidShape::Penta6:
      for (const auto& face : kPentaQuads) six_volumes += face_term(x, face);
      for (const auto& face : kPentaTriangles) six_volumes += face_term(x, face);
      break;
    case SolidShape::Pyramid5:
      six_volumes += face_term(x, kPyramidBase);
      for (const auto& face : kPyramidSides) six_volumes += face_term(x, face);
      break;
    case SolidShape::Tet4:
    case SolidShape::Tet10:
      for (const auto& face : kTet) six_volumes += face_term(x, face);
      break;
    case SolidShape::Hex8:
    case SolidShape::Other:
      for (const auto& face : kHex) six_volumes += face_term(x, face);
      break;
  }
  return six_volumes / 6;
}

std::span<const Corner> corners(SolidShape shape) {
  switch (shape) {
    case SolidShape::Penta6:
      return kPentaCorners;
    case SolidShape::Pyramid5:
      return kPyramidCorners;
    case SolidShape::Tet4:
    case SolidShape::Tet10:
      return kTetCorners;
    case SolidShape::Hex8:
    case SolidShape::Other:
      break;
  }
  return kHexCorners;
}

double least_over_largest(std::span<const double> values) {
  double least = values[0], largest = 0;
  for (const double value : values) {
    least = std::min(least, value);
    largest = std::max(largest, std::abs(value));
  }
  return largest > 0 ? least / largest : 0;
}

}  // namespace

Measure solid_measure(SolidShape shape, std::span<const Vec3> nodes) {
  // Positions relative to the first node keep the volume exact far from the origin.
  std::array<Vec3, 10> x;
  for (std::size_t i = 0; i < nodes.size(); ++i) x[i] = nodes[i] - nodes[0];
  const std::span<const Vec3> local(x.data(), nodes.size());
  std::array<double, 8> jacobians{};
  const std::span<const Corner> at = corners(shape);
  for (std::size_t i = 0; i < at.size(); ++i) jacobians[i] = corner_jacobian(local, at[i]);
  Measure measure{.size = volume(shape, local),
                  .worst = least_over_largest({jacobians.data(), at.size()})};
  // A collapsed hexahedron has zero corners by design: only its volume counts.
  if (shape == SolidShape::Other) measure.worst = measure.size > 0 ? 1 : -1;
  return measure;
}

Measure shell_measure(std::span<const Vec3> nodes) {
  if (nodes.size() == 3) {
    const Vec3 normal = (nodes[1] - nodes[0]).cross(nodes[2] - nodes[0]);
    return {.size = 0.5 * normal.norm(), .worst = normal.norm() > 0 ? 1.0 : 0.0};
  }
  const Vec3 normal = (nodes[2] - nodes[0]).cross(nodes[3] - nodes[1]);
  std::array<double, 4> jacobians{};
  for (std::size_t i = 0; i < 4; ++i)
    jacobians[i] = (nodes[(i + 1) % 4] - nodes[i]).cross(nodes[(i + 3) % 4] - nodes[i]).dot(normal);
  return {.size = 0.5 * normal.norm(), .worst = least_over_largest(jacobians)};
}

}  // namespace crosswalk::fe
