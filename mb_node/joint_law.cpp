#include "mb_node/joint_law.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "common/units.h"

namespace crosswalk::mb {
namespace {

constexpr double kFrictionRate = 0.1;    // rad/s, width of the friction's sign change
constexpr double kUnloadStart = 0.3;     // of the deepest: where an unloading stop lets go [E]
constexpr double kUnloadExponent = 1.5;  // [E]
constexpr double kBrokenBending = 0.02;  // stiffness left after fracture [E]
constexpr double kBrokenTorsion = 0.10;  // [E]
constexpr double kBrokenStopAngle = 60 * kDegree;  // soft tissue around a broken bone [E]
constexpr double kBrokenStop = 150;                // N m/rad [E]
constexpr double kBrokenFriction = 10;             // N m [E]
constexpr double kIntactLigament = 12 * kDegree;   // end of the intact part of the knee curve

double envelope(const StopLaw& law, double depth) {
  return law.k1 * depth + law.k2 * depth * depth;
}

/// Cardan angles R = Ry(alpha) Rx(beta) Rz(gamma) and the axes of their rates in the parent frame.
void cardan(const Mat3& R, Vec3& angle, Mat3& axes) {
  const double beta = std::asin(std::clamp(-R(1, 2), -1.0, 1.0));
  const double alpha = std::atan2(R(0, 2), R(2, 2));
  angle = {alpha, beta, std::atan2(R(1, 0), R(1, 1))};
  axes.col(0) = Vec3::UnitY();
  axes.col(1) = Vec3(std::cos(alpha), 0, -std::sin(alpha));
  axes.col(2) = R.col(2);
}

/// Swing (rotation vector in the x, y plane) after a twist about z; axes of the rates of its y, x
/// components and of the twist: columns of the left Jacobian of the swing, and the swung z.
void swing_twist(const Mat3& R, Vec3& angle, Mat3& axes) {
  const Vec3 limb = R.col(2);
  const Vec3 across(-limb.y(), limb.x(), 0);  // z cross limb
  const double s = across.norm();
  const double phi = std::atan2(s, limb.z());
  const Vec3 axis = s > 1e-12 ? Vec3(across / s) : Vec3::UnitX();
  const Vec3 swing = phi * axis;
  const Mat3 R_swing = exp_rotation(swing).toRotationMatrix();
  const Mat3 R_twist = R_swing.transpose() * R;
  angle = {swing.y(), swing.x(), std::atan2(R_twist(1, 0), R_twist(0, 0))};
  const double ratio = phi > 1e-6 ? std::sin(phi) / phi : 1;
  const double rise = phi > 1e-6 ? (1 - std::cos(phi)) / phi : phi / 2;
  const Mat3 J =
      ratio * Mat3::Identity() + (1 - ratio) * axis * axis.transpose() + rise * skew(axis);
  axes.col(0) = J.col(1);
  axes.col(1) = J.col(0);
  axes.col(2) = limb;
}

double degrees(double angle, double min_deg, double max_deg) {
  return std::clamp(angle / kDegree, min_deg, max_deg);
}

}  // namespace

JointMotion joint_motion(JointType type, const AngleFrame& frame, const Mat3& R_WP,
                         const Mat3& R_WC, const Vec3& w_relative) {
  const Mat3 R = R_WP.transpose() * R_WC;
  JointMotion motion;
  switch (type) {
    case JointType::Ball: {
      const Mat3 R_WZ = R_WP * frame.R_PZ;
      const Mat3 R_ZC = R_WZ.transpose() * R_WC;
      Mat3 axes;
      if (frame.coordinates == Coordinates::Cardan) {
        cardan(R_ZC, motion.angle, axes);
      } else {
        swing_twist(R_ZC, motion.angle, axes);
      }
      motion.dual = R_WZ * axes.inverse().transpose();
      break;
    }
    case JointType::HingeY:
      motion.angle[0] = std::atan2(R(0, 2), R(2, 2));
      motion.dual.col(0) = R_WP.col(1);
      break;
    case JointType::HingeX:
      motion.angle[1] = std::atan2(R(2, 1), R(1, 1));
      motion.dual.col(1) = R_WP.col(0);
      break;
    case JointType::HingeZ:
      motion.angle[2] = std::atan2(R(1, 0), R(0, 0));
      motion.dual.col(2) = R_WP.col(2);
      break;
    case JointType::UniversalXY:
      motion.angle[0] = std::atan2(R(0, 2), R(0, 0));
      motion.angle[1] = std::atan2(R(2, 1), R(1, 1));
      motion.dual.col(0) = R_WC.col(1);
      motion.dual.col(1) = R_WP.col(0);
      break;
    case JointType::SliderY:
    case JointType::Free:
      break;
  }
  motion.rate = motion.dual.transpose() * w_relative;
  return motion;
}

double stop_moment(const StopLaw& law, double depth, StopHistory& history) {
  if (depth <= 0) return 0;
  if (depth >= history.deepest) {
    history.deepest = depth;
    return envelope(law, depth);
  }
  const double start = kUnloadStart * history.deepest;
  if (depth <= start) return 0;
  return envelope(law, history.deepest) *
         std::pow((depth - start) / (history.deepest - start), kUnloadExponent);
}

double stop_loss(const StopLaw& law, double deepest) {
  const double put_in = law.k1 * deepest * deepest / 2 + law.k2 * deepest * deepest * deepest / 3;
  const double given_back =
      envelope(law, deepest) * (1 - kUnloadStart) * deepest / (kUnloadExponent + 1);
  return put_in - given_back;
}

double stop_energy(const StopLaw& law, double depth, const StopHistory& history) {
  // The history is of the last moment asked for; the joint may have gone deeper since, or touched.
  const double deepest = std::max(history.deepest, depth);
  const double start = kUnloadStart * deepest;
  if (depth <= start) return 0;
  const double range = deepest - start;
  return envelope(law, deepest) * range / (kUnloadExponent + 1) *
         std::pow((depth - start) / range, kUnloadExponent + 1);
}

double ligament_moment(const LigamentLaw& law, double displacement, LigamentHistory& history) {
  const double d = std::abs(displacement);
  if (d > law.failure) history.is_torn = true;
  history.deepest = std::max(history.deepest, d);
  const double side = std::copysign(1.0, displacement);
  if (!history.is_torn) return side * law.moment.value(d);
  const double unloaded = law.moment.value(history.deepest) - law.unloading * (history.deepest - d);
  return side * std::max(0.0, unloaded);
}

double ligament_energy(const LigamentLaw& law, double displacement,
                       const LigamentHistory& history) {
  const double d = std::abs(displacement);
  if (!history.is_torn) return law.moment.integral(d);
  const double deepest = std::max(history.deepest, d);
  const double moment = std::max(0.0, law.moment.value(deepest) - law.unloading * (deepest - d));
  return moment * moment / (2 * law.unloading);
}

double ligament_loss(const LigamentLaw& law, const LigamentHistory& history) {
  if (!history.is_torn) return 0;
  return law.moment.integral(history.deepest) - ligament_energy(law, history.deepest, history);
}

LigamentLaw without_failure(const LigamentLaw& law) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < law.moment.x().size(); ++i) {
    if (law.moment.x()[i] > kIntactLigament * (1 + 1e-9)) break;
    x.push_back(law.moment.x()[i]);
    y.push_back(law.moment.y()[i]);
  }
  x.push_back(2 * kIntactLigament);
  y.push_back(y.back() + law.undamaged * (x.back() - *(x.end() - 2)));
  LigamentLaw out = law;
  out.moment = Curve(x, y, Curve::Outside::LastSlope);
  out.failure = 1e9;
  return out;
}

RestraintMoment restraint_moment(const CoordinateLaw& law, const CoordinateInput& input,
                                 double angle, double rate, CoordinateHistory& history) {
  const CoordinateHistory before = history;
  const double d = angle - input.initial;
  RestraintMoment m;
  m.elastic = -law.k0 * d - stop_moment(law.high, angle - law.max, history.high) +
              stop_moment(law.low, law.min - angle, history.low);
  m.lost = stop_loss(law.high, history.high.deepest) - stop_loss(law.high, before.high.deepest) +
           stop_loss(law.low, history.low.deepest) - stop_loss(law.low, before.low.deepest);
  if (!law.ligament.moment.empty()) {
    m.elastic -= input.ligament_factor * ligament_moment(law.ligament, d, history.ligament);
    m.lost += input.ligament_factor * (ligament_loss(law.ligament, history.ligament) -
                                       ligament_loss(law.ligament, before.ligament));
  }
  m.passive = input.passive;
  m.damping = -law.damping * rate;
  m.friction = -law.friction * std::tanh(rate / kFrictionRate);
  return m;
}

double restraint_energy(const CoordinateLaw& law, const CoordinateInput& input, double angle,
                        const CoordinateHistory& history) {
  const double d = angle - input.initial;
  double energy = 0.5 * law.k0 * d * d + stop_energy(law.high, angle - law.max, history.high) +
                  stop_energy(law.low, law.min - angle, history.low);
  if (!law.ligament.moment.empty()) {
    energy += input.ligament_factor * ligament_energy(law.ligament, d, history.ligament);
  }
  return energy;
}

BoneMoment bone_moment(const BoneLaw& law, const Vec3& angle, const Vec3& rate, bool may_break,
                       BoneHistory& history) {
  const double theta = std::hypot(angle[0], angle[1]);
  BoneMoment m;
  if (may_break && !history.is_broken && law.bending * theta > law.fracture_moment) {
    m.lost = bone_energy(law, angle, history);
    history.is_broken = true;
    m.lost -= bone_energy(law, angle, history);
  }
  double bending = law.bending, torsion = law.torsion;
  m.damping = -Vec3(law.bending_damping * rate[0], law.bending_damping * rate[1],
                    law.torsion_damping * rate[2]);
  if (history.is_broken) {
    bending *= kBrokenBending;
    torsion *= kBrokenTorsion;
    for (int i = 0; i < 2; ++i) {
      m.friction[i] = -kBrokenFriction * std::tanh(rate[i] / kFrictionRate);
    }
    const double depth = theta - kBrokenStopAngle;
    if (depth > 0) m.elastic.head<2>() -= kBrokenStop * depth / theta * angle.head<2>();
  }
  m.elastic -= Vec3(bending * angle[0], bending * angle[1], torsion * angle[2]);
  return m;
}

double bone_energy(const BoneLaw& law, const Vec3& angle, const BoneHistory& history) {
  const double theta = std::hypot(angle[0], angle[1]);
  const double bending = 0.5 * law.bending * theta * theta;
  const double torsion = 0.5 * law.torsion * angle[2] * angle[2];
  if (!history.is_broken) return bending + torsion;
  const double depth = std::max(0.0, theta - kBrokenStopAngle);
  return kBrokenBending * bending + kBrokenTorsion * torsion + 0.5 * kBrokenStop * depth * depth;
}

double passive_hip(double hip_flexion, double knee_flexion) {
  const double h = degrees(hip_flexion, -30, 115), k = degrees(knee_flexion, 0, 140);
  return std::exp(1.4655 - 0.0034 * k - 0.0750 * h) - std::exp(1.3403 - 0.0226 * k + 0.0305 * h) +
         8.072;
}

double passive_knee(double hip_flexion, double knee_flexion, double ankle_dorsiflexion) {
  const double h = degrees(hip_flexion, -30, 115), k = degrees(knee_flexion, 0, 140);
  const double a = degrees(ankle_dorsiflexion, -50, 30);
  return std::exp(1.800 + 0.0460 * a - 0.0352 * k + 0.0217 * h) -
         std::exp(-3.971 + 0.0004 * a + 0.0495 * k - 0.0128 * h) - 4.820 +
         std::exp(2.220 - 0.150 * k);
}

double passive_ankle(double knee_flexion, double ankle_dorsiflexion) {
  const double k = degrees(knee_flexion, 0, 140), a = degrees(ankle_dorsiflexion, -50, 30);
  return std::exp(-7.9763 - 0.1949 * a + 0.0008 * k) - std::exp(2.1016 + 0.0843 * a - 0.0176 * k) +
         1.792;
}

}  // namespace crosswalk::mb
