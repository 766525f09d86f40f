// Rigid bodies of the finite-element model: parts with a rigid law and nodal rigid bodies.
//
// Free      moves by its own inertia; origin B at the centre of mass; the state carries the spatial
//           angular momentum, so that it is conserved to round-off when no moment acts.
// Driven    follows a body of the multibody side that carries its mass (coupling blocks).
// Follower  a body of the multibody side that only lends its contact surfaces; has no nodes.
// Prescribed follows curves given by the user.
// Nodes sit at fixed places in B: x = p_WB + R_WB p_BN.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/spatial.h"

namespace crosswalk::fe {

enum class BodyRole { Free, Driven, Follower, Prescribed };

struct RigidBody {
  std::string name;
  BodyRole role = BodyRole::Free;
  std::vector<int> parts;  ///< mesh parts that move with it
  std::vector<int> nodes;
  /// Of the rigid material alone, in the deck's frame; deformable neighbours' nodal masses come on
  /// top in Model::finish().
  Inertia own;
  std::array<bool, 6> locked{};  ///< translations and rotations along global axes; free bodies

  // Filled by Model::finish(), deck frame.
  Vec3 origin = Vec3::Zero();  ///< of B; the centre of mass for a free body
  std::vector<Vec3> p_BN;      ///< of each node, axes of B (those of the deck unless re-based)
  Inertia inertia;             ///< own and nodal masses, in B
};

struct BodyState {
  Pose X_WB;                             ///< at t
  Twist V_WB;                            ///< of the origin, at t - dt/2
  Vec3 angular_momentum = Vec3::Zero();  ///< about the centre of mass, W axes; free bodies only
};

/// Moves a free body by one step: kick with the wrench about its origin (N, N m), then drift.
/// The rotation uses the angular velocity at the middle of the drift (implicit midpoint), so the
/// spatial angular momentum is exactly that of the kicks.
void move_free_body(const RigidBody& body, const Wrench& wrench, const Vec3& gravity, double kick,
                    double dt, BodyState& state);
/// Moves a body by a given twist of its origin.
void move_with_twist(const Twist& V, double dt, BodyState& state);
/// R I R^T omega, the angular momentum about the centre of mass.
Vec3 angular_momentum(const RigidBody& body, const Pose& X_WB, const Vec3& omega);

}  // namespace crosswalk::fe
