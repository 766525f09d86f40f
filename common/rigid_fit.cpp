#include "common/rigid_fit.h"

#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

namespace crosswalk {
namespace {

/// The turning w with J w = sum m r x u, zero about an axis on which all points lie.
Vec3 turning(std::span<const Vec3> x, std::span<const Vec3> u, std::span<const double> weight) {
  const Vec3 centre = weighted_mean(x, weight), mean = weighted_mean(u, weight);
  Mat3 inertia = Mat3::Zero();
  Vec3 momentum = Vec3::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 r = x[i] - centre;
    inertia += weight[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    momentum += weight[i] * r.cross(u[i] - mean);
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  Vec3 w = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (solver.eigenvalues()[k] > 1e-12 * solver.eigenvalues()[2])
      w += solver.eigenvectors().col(k).dot(momentum) / solver.eigenvalues()[k] *
           solver.eigenvectors().col(k);
  return w;
}

}  // namespace

Vec3 weighted_mean(std::span<const Vec3> x, std::span<const double> weight) {
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += weight[i] * x[i];
    total += weight[i];
  }
  return sum / total;
}

Pose fit_pose(std::span<const Vec3> reference, std::span<const Vec3> present,
              std::span<const double> weight) {
  const Vec3 a = weighted_mean(reference, weight), b = weighted_mean(present, weight);
  Mat3 M = Mat3::Zero();
  for (std::size_t i = 0; i < reference.size(); ++i)
    M += weight[i] * (reference[i] - a) * (present[i] - b).transpose();
  // The wanted quaternion is the eigenvector of the largest eigenvalue of Horn's 4 x 4 matrix.
  Eigen::Matrix4d N;
  const double trace = M.trace();
  const Vec3 d(M(1, 2) - M(2, 1), M(2, 0) - M(0, 2), M(0, 1) - M(1, 0));
  N(0, 0) = trace;
  N.block<1, 3>(0, 1) = d.transpose();
  N.block<3, 1>(1, 0) = d;
  N.block<3, 3>(1, 1) = M + M.transpose() - trace * Mat3::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(N);
  const Eigen::Vector4d q = solver.eigenvectors().col(3);
  Pose X;
  X.q = Quat(q[0], q[1], q[2], q[3]).normalized();
  if (X.q.w() < 0) X.q.coeffs() *= -1;
  X.p = b - X.q * a;
  return X;
}

double fit_residual(std::span<const Vec3> reference, std::span<const Vec3> present,
                    std::span<const double> weight, const Pose& X) {
  double squares = 0, total = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    squares += weight[i] * (present[i] - X * reference[i]).squaredNorm();
    total += weight[i];
  }
  return std::sqrt(squares / total);
}

Twist fit_twist(std::span<const Vec3> x, std::span<const Vec3> v, std::span<const double> weight,
                const Vec3& about) {
  const Twist at_centre{weighted_mean(v, weight), turning(x, v, weight)};
  return at_centre.shifted(about - weighted_mean(x, weight));
}

Vec3 fit_angular_acceleration(std::span<const Vec3> x, std::span<const Vec3> a,
                              std::span<const double> weight, const Vec3& omega) {
  const Vec3 centre = weighted_mean(x, weight);
  std::vector<Vec3> tangential;
  for (std::size_t i = 0; i < x.size(); ++i)
    tangential.push_back(a[i] - omega.cross(omega.cross(x[i] - centre)));
  return turning(x, tangential, weight);
}

}  // namespace crosswalk
