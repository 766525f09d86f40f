#include "fe_node/deck/affine_map.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace crosswalk::fe {

namespace {

using Row = std::pair<std::string, std::array<double, 7>>;

/// Axes through the first point: x to the second, the third in the xy plane; none for points in a
/// line.
std::optional<Mat3> frame(const Vec3& origin, const Vec3& on_x, const Vec3& in_xy) {
  Mat3 R;
  const Vec3 x = on_x - origin, normal = x.cross(in_xy - origin);
  if (!(x.norm() > 0) || !(normal.norm() > 1e-12 * x.squaredNorm())) return std::nullopt;
  R.col(0) = x.normalized();
  R.col(2) = normal.normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

class MapBuilder {
 public:
  MapBuilder(const Transformation& card, const Deck& deck, ProblemList& errors)
      : card_(card), deck_(deck), errors_(errors) {}

  AffineMap run() {
    for (const Row& row : card_.rows) add(row);
    if (!(map_.linear.determinant() > 0) || !map_.linear.allFinite() || !map_.shift.allFinite()) {
      problem("a map that keeps volumes positive",
              fmt::format("a volume ratio of {:g}", map_.linear.determinant()),
              "mirrored or flattened elements cannot be computed");
      return {};
    }
    return map_;
  }

 private:
  void add(const Row& row) {
    const auto& [option, a] = row;
    const Vec3 first(a[0], a[1], a[2]), second(a[3], a[4], a[5]);
    if (option == "SCALE") {
      apply(first.asDiagonal(), Vec3::Zero());
    } else if (option == "TRANSL") {
      apply(Mat3::Identity(), first);
    } else if (option == "ROTATE") {
      const bool is_by_points = second.isZero(0) && a[6] == 0 && a[2] != 0;
      is_by_points ? rotate_about_points(a) : rotate(first, second, a[6]);
    } else if (option == "POINT") {
      points_[a[0]] = Vec3(a[1], a[2], a[3]);
    } else if (option == "TRANSL2ND") {
      const auto from = point(a[0]), to = point(a[1]);
      if (!from || !to) return;
      const Vec3 direction = *to - *from;
      if (!(direction.norm() > 0)) return problem("two different points", option);
      apply(Mat3::Identity(), a[2] * direction.normalized());
    } else if (option == "POS6P") {
      position(a);
    } else {
      problem("SCALE, TRANSL, ROTATE, POINT, TRANSL2ND or POS6P", fmt::format("'{:.20}'", option));
    }
  }

  void rotate_about_points(const std::array<double, 7>& a) {
    const auto from = point(a[0]), to = point(a[1]);
    if (from && to) rotate(*to - *from, *from, a[2]);
  }

  void rotate(const Vec3& axis, const Vec3& through, double angle_deg) {
    if (!(axis.norm() > 0)) return problem("ROTATE about an axis that has a length", "none");
    const Mat3 R =
        Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
    turn(R, through - R * through);
  }

  /// Six POINTs: the frame of the first three goes where that of the others is.
  void position(const std::array<double, 7>& a) {
    std::array<Vec3, 6> p;
    for (std::size_t i = 0; i < 6; ++i) {
      const auto found = point(a[i]);
      if (!found) return;
      p[i] = *found;
    }
    const auto from = frame(p[0], p[1], p[2]), to = frame(p[3], p[4], p[5]);
    if (!from || !to) return problem("POS6P with points that span two planes", "points in a line");
    const Mat3 R = *to * from->transpose();
    turn(R, p[3] - R * p[0]);
  }

  void turn(const Mat3& R, const Vec3& shift) {
    apply(R, shift);
    map_.rotation = R * map_.rotation;
  }

  void apply(const Mat3& A, const Vec3& b) {
    map_.linear = A * map_.linear;
    map_.shift = A * map_.shift + b;
    for (auto& [id, x] : points_) x = A * x + b;
  }

  std::optional<Vec3> point(double id) {
    const auto found = points_.find(id);
    if (found != points_.end()) return found->second;
    problem(fmt::format("a POINT {:g} before its use", id), "none");
    return std::nullopt;
  }

  void problem(const std::string& expected, const std::string& found, std::string hint = {}) {
    errors_.add(deck_.place(card_.source), fmt::format("*DEFINE_TRANSFORMATION {}", card_.id.value),
                expected, found, std::move(hint));
  }

  const Transformation& card_;
  const Deck& deck_;
  ProblemList& errors_;
  AffineMap map_;
  std::map<double, Vec3> points_;
};

}  // namespace

AffineMap affine_map(const Transformation& transformation, const Deck& deck, ProblemList& errors) {
  return MapBuilder(transformation, deck, errors).run();
}

}  // namespace crosswalk::fe
