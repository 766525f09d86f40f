// Rigid motion of a set of nodes (skull) by mass-weighted least squares, in the world frame.
//
// Rotation: Kabsch, H = sum m (P - p)(Q - q)^T, H = U S V^T, R = V diag(1, 1, sign det(V U^T)) U^T
// maps the reference pose to the current one; the sign factor keeps flat node sets proper. Rates:
// with r = x - c and J = sum m (r.r 1 - r r^T), omega = J^-1 sum m r x (v - v_c) and alpha = J^-1
// sum m r x (a - a_c - omega x (omega x r)).
#pragma once

#include <span>

#include "common/spatial.h"

namespace crosswalk::recording {

struct RigidFit {
  Mat3 R = Mat3::Identity();         ///< reference pose to current pose
  Vec3 center = Vec3::Zero();        ///< m, mass centre of the nodes
  Vec3 velocity = Vec3::Zero();      ///< m/s, of the centre
  Vec3 acceleration = Vec3::Zero();  ///< m/s2, of the centre
  Vec3 omega = Vec3::Zero();         ///< rad/s, world axes
  Vec3 alpha = Vec3::Zero();         ///< rad/s2, world axes
  double rms_residual = 0;           ///< m; above 1 mm the set is not rigid
  Vec3 omega_body() const { return R.transpose() * omega; }
  Vec3 alpha_body() const { return R.transpose() * alpha; }
};

struct NodeMotion {
  std::span<const double> mass;
  std::span<const Vec3> reference;
  std::span<const Vec3> position;
  std::span<const Vec3> velocity;
  std::span<const Vec3> acceleration;
};

/// The best proper rotation that maps reference to position (both about their mass centres).
Mat3 fit_rotation(std::span<const double> mass, std::span<const Vec3> reference,
                  std::span<const Vec3> position);

/// Throws too_short below 3 nodes and shape on unequal lengths.
RigidFit fit_rigid(const NodeMotion& nodes);

}  // namespace crosswalk::recording
