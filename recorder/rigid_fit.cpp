#include "recorder/rigid_fit.h"

#include <cmath>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "recorder/channel.h"

namespace crosswalk::recording {

namespace {

Vec3 mass_centre(std::span<const double> mass, std::span<const Vec3> x) {
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += mass[i] * x[i];
    total += mass[i];
  }
  return sum / total;
}

}  // namespace

Mat3 fit_rotation(std::span<const double> mass, std::span<const Vec3> reference,
                  std::span<const Vec3> position) {
  if (mass.size() != reference.size() || mass.size() != position.size()) {
    throw SignalError(SignalFault::Shape, "rigid fit: masses and nodes differ in number");
  }
  if (mass.size() < 3) throw SignalError(SignalFault::TooShort, "rigid fit: fewer than 3 nodes");
  const Vec3 p = mass_centre(mass, reference);
  const Vec3 q = mass_centre(mass, position);
  Mat3 H = Mat3::Zero();
  for (std::size_t i = 0; i < mass.size(); ++i) {
    H += mass[i] * (reference[i] - p) * (position[i] - q).transpose();
  }
  const Eigen::JacobiSVD<Mat3> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Mat3& U = svd.matrixU();
  const Mat3& V = svd.matrixV();
  const double sign = (V * U.transpose()).determinant() < 0 ? -1.0 : 1.0;
  return V * Vec3(1, 1, sign).asDiagonal() * U.transpose();
}

RigidFit fit_rigid(const NodeMotion& nodes) {
  RigidFit fit;
  fit.R = fit_rotation(nodes.mass, nodes.reference, nodes.position);
  const std::size_t n = nodes.mass.size();
  if (nodes.velocity.size() != n || nodes.acceleration.size() != n) {
    throw SignalError(SignalFault::Shape, "rigid fit: velocities or accelerations are missing");
  }
  const Vec3 p = mass_centre(nodes.mass, nodes.reference);
  fit.center = mass_centre(nodes.mass, nodes.position);
  fit.velocity = mass_centre(nodes.mass, nodes.velocity);
  fit.acceleration = mass_centre(nodes.mass, nodes.acceleration);
  Mat3 J = Mat3::Zero();
  Vec3 momentum = Vec3::Zero();
  double squares = 0;
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double m = nodes.mass[i];
    const Vec3 r = nodes.position[i] - fit.center;
    J += m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    momentum += m * r.cross(nodes.velocity[i] - fit.velocity);
    squares += m * (r - fit.R * (nodes.reference[i] - p)).squaredNorm();
    total += m;
  }
  const Mat3 J_inverse = J.inverse();
  fit.omega = J_inverse * momentum;
  Vec3 torque = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 r = nodes.position[i] - fit.center;
    const Vec3 centripetal = fit.omega.cross(fit.omega.cross(r));
    torque += nodes.mass[i] * r.cross(nodes.acceleration[i] - fit.acceleration - centripetal);
  }
  fit.alpha = J_inverse * torque;
  fit.rms_residual = std::sqrt(squares / total);
  return fit;
}

}  // namespace crosswalk::recording
