#include "common/body_scaling.h"

#include <cmath>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "common/units.h"

namespace crosswalk {
namespace {

constexpr int kSlices = 400;  // per body; mass properties change by less than 1e-5 beyond 200

enum Height { kAnkle, kKnee, kHip, kL5S1, kWaist, kC7T1, kSJC, kOC, kHeightCount };

struct Row {
  std::string equation;
  Eigen::Matrix<double, 1, kHeightCount> factors;
  double value;
  double sigma;
  std::string_view measure = {};  // the height it was measured by, and how `value` grows with it
  double slope = 0;
  Row of(std::string_view name, double d_value) && {
    measure = name;
    slope = d_value;
    return std::move(*this);
  }
};

Row row(std::string equation, std::initializer_list<std::pair<Height, double>> factors,
        double value, double sigma_mm) {
  Row r{std::move(equation), Eigen::Matrix<double, 1, kHeightCount>::Zero(), value,
        sigma_mm * kMilli};
  for (const auto& [height, factor] : factors) r.factors[height] = factor;
  return r;
}

// Statistical ratios to stature from [winter2009] (knee 0.285, ankle, shoulder, hip) and
// [deleva1996] (trunk lengths), moved from surface landmarks to joint centres; offsets and sigmas
// [E].
std::vector<Row> height_rows(const Anthropometry& a, const HeightOverrides& overrides) {
  const double H = a.standing_height;
  std::vector<Row> rows = {
      row("ankle = 0.80 outside ankle height", {{kAnkle, 1}}, 0.80 * a.ankle_height_outside, 8)
          .of("ankle_height_outside", 0.80),
      row("ankle = 0.042 H", {{kAnkle, 1}}, 0.042 * H, 10),
      row("knee = seated knee height - knee radius", {{kKnee, 1}},
          a.knee_height_seated - a.knee_circumference / (2 * kPi), 8)
          .of("knee_height_seated", 1),
      row("knee = 0.285 H", {{kKnee, 1}}, 0.285 * H, 25),
      row("hip = 1.056 H - seated height", {{kHip, 1}}, H - a.seated_height + 0.056 * H, 15)
          .of("seated_height", -1),
      row("hip = 0.5225 H", {{kHip, 1}}, 0.5225 * H, 20),
      row("waist = waist height", {{kWaist, 1}}, a.waist_height, 15).of("waist_height", 1),
      row("waist - hip = 0.0837 H", {{kWaist, 1}, {kHip, -1}}, 0.0837 * H, 12),
      row("L5S1 - hip = 0.050 H", {{kL5S1, 1}, {kHip, -1}}, 0.050 * H, 4),
      row("waist = 0.852 L5S1 + 0.148 C7T1", {{kWaist, 1}, {kL5S1, -0.852}, {kC7T1, -0.148}}, 0,
          12),
      row("C7T1 = shoulder height - 0.0114 H", {{kC7T1, 1}}, a.shoulder_height - 0.0114 * H, 12)
          .of("shoulder_height", 1),
      row("C7T1 = 0.8546 H", {{kC7T1, 1}}, 0.8546 * H, 20),
      row("shoulder joint = armpit height + 0.0385 H", {{kSJC, 1}}, a.armpit_height + 0.0385 * H,
          12)
          .of("armpit_height", 1),
      row("shoulder joint = 0.8184 H", {{kSJC, 1}}, 0.8184 * H, 20),
      row("C7T1 - shoulder joint = 0.0362 H", {{kC7T1, 1}, {kSJC, -1}}, 0.0362 * H, 10),
      row("occipital condyles = H - 0.64 head to chin", {{kOC, 1}},
          H - 0.64 * a.head_to_chin_height, 6),
  };
  if (overrides.SJC > 0)
    rows.push_back(row("shoulder joint = override", {{kSJC, 1}}, overrides.SJC, 1));
  if (overrides.C7T1 > 0) rows.push_back(row("C7T1 = override", {{kC7T1, 1}}, overrides.C7T1, 1));
  return rows;
}

/// Equations over their sigmas: A z = b.
struct Weighted {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
};
Weighted weighted(const std::vector<Row>& rows) {
  Weighted w{Eigen::MatrixXd(rows.size(), static_cast<int>(kHeightCount)),
             Eigen::VectorXd(rows.size())};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    w.A.row(i) = rows[i].factors / rows[i].sigma;
    w.b[i] = rows[i].value / rows[i].sigma;
  }
  return w;
}

}  // namespace

JointHeights solve_heights(const Anthropometry& a, const HeightOverrides& overrides) {
  const std::vector<Row> rows = height_rows(a, overrides);
  const auto [A, b] = weighted(rows);
  const Eigen::VectorXd z = A.colPivHouseholderQr().solve(b);
  JointHeights heights{.ankle = z[kAnkle],
                       .knee = z[kKnee],
                       .hip = z[kHip],
                       .L5S1 = z[kL5S1],
                       .waist = z[kWaist],
                       .C7T1 = z[kC7T1],
                       .SJC = z[kSJC],
                       .OC = z[kOC],
                       .residuals = {}};
  for (const Row& r : rows) {
    heights.residuals.push_back({r.equation, r.factors.dot(z) - r.value, r.sigma});
  }
  return heights;
}

// Least squares with row i left out: its residual is e_i / (1 - h_i), of standard deviation
// 1 / sqrt(1 - h_i) in weighted units, with the leverage h_i = |row i of Q|^2, A = Q R.
std::vector<HeightContradiction> height_contradictions(const Anthropometry& a) {
  const std::vector<Row> rows = height_rows(a, {});
  const auto [A, b] = weighted(rows);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), A.cols());
  const Eigen::VectorXd e = b - Q * (Q.transpose() * b);
  std::vector<HeightContradiction> found;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double rest = 1 - Q.row(k).squaredNorm();
    if (rows[i].measure.empty() || rest < 1e-9) continue;
    found.push_back({rows[i].measure, e[k] * rows[i].sigma / (rest * rows[i].slope),
                     std::abs(e[k]) / std::sqrt(rest)});
  }
  return found;
}

Variables body_variables(const Anthropometry& a, const JointHeights& heights,
                         const HeightOverrides& overrides) {
  Variables v;
  for (const Measure& measure : anthropometry_measures()) {
    v[fmt::format("P{}", measure.number)] = a.*measure.value;
  }
  const double H = a.standing_height;
  v["H"] = H;
  v["q"] = H / 1.74;  // reference stature
  v["SB"] = a.shoulder_breadth / 2;
  v["cd"] = a.chest_depth / 2;
  v["cb"] = a.chest_breadth / 2;
  v["wd"] = a.waist_depth / 2;
  v["wb"] = a.waist_breadth / 2;
  v["bd"] = a.buttock_depth / 2;
  v["hb"] = a.hip_breadth_standing / 2;
  for (const int number : {10, 20, 21, 22, 23, 25, 26, 27, 28, 29}) {
    v[fmt::format("c{}", number)] = v[fmt::format("P{}", number)] / (2 * kPi);
  }
  v["y_hip"] = overrides.stance_half_width > 0 ? overrides.stance_half_width
                                               : 0.245 * a.hip_breadth_standing;
  v["y_shoulder"] = a.shoulder_breadth / 2 - 0.022;
  const double spine = heights.C7T1 - heights.L5S1;  // levels along the spine [deleva1996, E]
  v["z_ankle"] = heights.ankle;
  v["z_knee"] = heights.knee;
  v["z_hip"] = heights.hip;
  v["z_L5S1"] = heights.L5S1;
  v["z_waist"] = heights.waist;
  v["z_L3L4"] = heights.L5S1 + 0.148 * spine;
  v["z_T12L1"] = heights.L5S1 + 0.385 * spine;
  v["z_T7T8"] = heights.L5S1 + 0.655 * spine;
  v["z_C7T1"] = heights.C7T1;
  v["z_C4"] = (heights.C7T1 + heights.OC) / 2;
  v["z_OC"] = heights.OC;
  v["z_SJC"] = heights.SJC;
  v["L_th"] = heights.hip - heights.knee;
  v["L_sh"] = heights.knee - heights.ankle;
  v["L_ua"] = 0.80 * a.shoulder_to_elbow_length;
  v["L_fa"] = a.forearm_hand_length - a.hand_length - 0.0125 * H;
  return v;
}

VolumeProperties limb_volume(const Vec3& top, double length, const Curve& radius, double begin,
                             double end) {
  const double d = (end - begin) * length / kSlices;
  VolumeProperties p;
  double first = 0, lateral = 0, axial = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double s = begin + (end - begin) * (i + 0.5) / kSlices;
    const double r = radius.value(s);
    const double volume = kPi * r * r * d;
    const double depth = s * length;
    p.volume += volume;
    first += volume * depth;
    lateral += volume * (r * r / 4 + d * d / 12 + depth * depth);
    axial += volume * r * r / 2;
  }
  const double centre = first / p.volume;
  p.centre = top - Vec3(0, 0, centre);
  lateral -= p.volume * centre * centre;
  p.moments = {lateral, lateral, axial};
  return p;
}

VolumeProperties trunk_volume(const Curve& a, const Curve& b, const Curve& x, double z_begin,
                              double z_end) {
  const double d = (z_end - z_begin) / kSlices;
  VolumeProperties p;
  Vec3 first = Vec3::Zero();
  for (int i = 0; i < kSlices; ++i) {
    const double z = z_begin + (z_end - z_begin) * (i + 0.5) / kSlices;
    const double a2 = std::pow(a.value(z), 2), b2 = std::pow(b.value(z), 2), xc = x.value(z);
    const double volume = kPi * std::sqrt(a2 * b2) * d;
    p.volume += volume;
    first += volume * Vec3(xc, 0, z);
    p.moments += volume * Vec3(b2 / 4 + z * z, a2 / 4 + z * z + xc * xc, (a2 + b2) / 4 + xc * xc);
  }
  p.centre = first / p.volume;
  const Vec3 c2 = p.centre.cwiseAbs2();
  p.moments -= p.volume * Vec3(c2.y() + c2.z(), c2.x() + c2.z(), c2.x() + c2.y());
  return p;
}

}  // namespace crosswalk
