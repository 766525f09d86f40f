// Rigid bodies of the finite-element model: parts with a rigid law and nodal rigid bodies.
//
// Free      moves by its own inertia; origin B at the centre of mass; the state carries the spatial
//           angular momentum, so that it is conserved to round-off when no moment acts.
// Driven    follows a body of the multibody side that carries its mass (coupling blocks).
// Follower  a body of the multibody side that only lends its contact surfaces; has no nodes.
// Prescribed follows curves given by the user.
// Nodes sit at fixed places in B: x = p_WB + R_WB p_BN.
#pragma once

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
  std::vector<Vec3> p_BN;  ///< of each node, axes of B
  Inertia inertia;         ///< about B's origin frame, axes of B; com is zero for a free body
};

struct BodyState {
  Pose X_WB;                             ///< at t
  Twist V_WB;                            ///< of the origin, at t - dt/2
  Vec3 angular_momentum = Vec3::Zero();  ///< about the centre of mass, W axes; free bodies only
};

}  // namespace crosswalk::fe
