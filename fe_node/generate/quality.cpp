#include "fe_node/generate/quality.h"

#include <algorithm>
#include <cmath>

namespace crosswalk::fe::generate {

namespace {

// Corner, then its three neighbours in right-handed order.
constexpr int kCornerEdges[8][4] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                    {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};
constexpr int kEdges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                               {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr int kFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                              {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
constexpr int kSigns[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

double jacobian_determinant(const HexCorners& x, double r, double s, double t) {
  Mat3 J = Mat3::Zero();
  for (int c = 0; c < 8; ++c) {
    const int* sign = kSigns[c];
    const double a = 1 + sign[0] * r, b = 1 + sign[1] * s, d = 1 + sign[2] * t;
    J += 0.125 * x[c] * Vec3(sign[0] * b * d, sign[1] * a * d, sign[2] * a * b).transpose();
  }
  return J.determinant();
}

/// Of a wedge, pyramid or tetrahedron: two of the corner's edges lie on each other, or one is none.
bool is_collapsed(const HexCorners& x, const int (&corner)[4]) {
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < a; ++b)
      if (x[corner[a]] == x[corner[b]]) return true;
  return false;
}

bool is_tetrahedron(const Hex& hex) {
  return std::all_of(hex.node.begin() + 4, hex.node.end(),
                     [&](int id) { return id == hex.node[3]; });
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

HexCorners corners_of(const MeshDraft& draft, const Hex& hex) {
  HexCorners x;
  for (int c = 0; c < 8; ++c) x[c] = draft.nodes[hex.node[c]];
  return x;
}

Vec3 trilinear(const HexCorners& x, double r, double s, double t) {
  Vec3 p = Vec3::Zero();
  for (int c = 0; c < 8; ++c)
    p += 0.125 * (1 + kSigns[c][0] * r) * (1 + kSigns[c][1] * s) * (1 + kSigns[c][2] * t) * x[c];
  return p;
}

// The determinant is at most quadratic in each coordinate: two Gauss points each way are exact.
double volume(const HexCorners& x) {
  const double g = 1.0 / std::sqrt(3.0);
  double sum = 0;
  for (const auto& sign : kSigns)
    sum += jacobian_determinant(x, g * sign[0], g * sign[1], g * sign[2]);
  return sum;
}

double scaled_jacobian(const HexCorners& x) {
  double least = 1;
  for (const auto& corner : kCornerEdges) {
    if (is_collapsed(x, corner)) continue;
    const Vec3 a = (x[corner[1]] - x[corner[0]]).normalized();
    const Vec3 b = (x[corner[2]] - x[corner[0]]).normalized();
    const Vec3 c = (x[corner[3]] - x[corner[0]]).normalized();
    least = std::min(least, a.cross(b).dot(c));
  }
  return least;
}

double aspect_ratio(const HexCorners& x) {
  double shortest = 1e300, longest = 0;
  for (const auto& edge : kEdges) {
    const double length = (x[edge[1]] - x[edge[0]]).norm();
    if (length > 0) shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return longest / shortest;
}

double warpage(const HexCorners& x) {
  double worst = 0;
  for (const auto& face : kFaces) {
    for (int turn = 0; turn < 2; ++turn) {
      if (is_collapsed(x, face)) continue;
      const Vec3 &a = x[face[turn]], &b = x[face[turn + 1]], &c = x[face[turn + 2]],
                 &d = x[face[(turn + 3) % 4]];
      worst = std::max(worst, angle_between((b - a).cross(c - a), (c - a).cross(d - a)));
    }
  }
  return worst;
}

// The area of a warped face is half the cross product of its diagonals.
double characteristic_length(const HexCorners& x) {
  double largest = 0;
  for (const auto& face : kFaces)
    largest =
        std::max(largest, 0.5 * (x[face[2]] - x[face[0]]).cross(x[face[3]] - x[face[1]]).norm());
  return volume(x) / largest;
}

std::vector<PartQuality> hex_quality(const MeshDraft& draft) {
  std::vector<PartQuality> parts;
  for (const Hex& hex : draft.hexes) {
    auto found = std::find_if(parts.begin(), parts.end(),
                              [&](const PartQuality& q) { return q.part == hex.part; });
    if (found == parts.end()) {
      parts.push_back({.part = hex.part});
      found = parts.end() - 1;
    }
    const HexCorners x = corners_of(draft, hex);
    ++found->elements;
    found->volume += volume(x);
    if (!is_tetrahedron(hex))
      found->min_scaled_jacobian = std::min(found->min_scaled_jacobian, scaled_jacobian(x));
    found->max_aspect = std::max(found->max_aspect, aspect_ratio(x));
    found->max_warpage = std::max(found->max_warpage, warpage(x));
    found->min_characteristic_length =
        std::min(found->min_characteristic_length, characteristic_length(x));
  }
  return parts;
}

}  // namespace crosswalk::fe::generate
