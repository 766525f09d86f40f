// Constraints on single nodes: fixed or prescribed directions, and nodes tied to a facet.
#pragma once

#include <array>
#include <vector>

#include "common/curve.h"
#include "common/spatial.h"

namespace crosswalk::fe {

/// Translations (and, for shells, rotations) along global axes that may not move.
struct FixedNode {
  int node = 0;
  std::array<bool, 3> translation{};
  std::array<bool, 3> rotation{};
};

enum class MotionKind { Velocity, Acceleration, Displacement };

/// One global direction of some nodes follows scale * curve(t).
struct GuidedNodes {
  std::vector<int> nodes;
  Vec3 direction = Vec3::UnitX();  ///< unit
  MotionKind kind = MotionKind::Velocity;
  Curve curve;  ///< of time, SI
  double scale = 1;
};

/// One degree of freedom of a rigid body (0..2 along, 3..5 about the global axes) follows a curve.
struct GuidedBody {
  int body = 0;
  int axis = 0;
  MotionKind kind = MotionKind::Velocity;
  Curve curve;
  double scale = 1;
};

/// An acceleration that every mass feels: scale * curve(t) along a direction, m/s2.
struct BaseAcceleration {
  Vec3 direction = Vec3::UnitZ();
  Curve curve;
  double scale = 1;
};

/// A node that moves with the interpolated motion of up to four others (weights sum to 1).
struct TiedNode {
  int node = 0;
  int count = 0;
  std::array<int, 4> master{};
  std::array<double, 4> weight{};
};

/// A pressure that stays normal to its facets and pushes against their normals (corners
/// anticlockwise seen from outside; a triangle repeats its last corner), Pa.
struct PressureLoad {
  std::vector<std::array<int, 4>> facets;
  Curve curve;
  double scale = 1;
};

/// Force curve on nodes, N each.
struct NodalForce {
  std::vector<int> nodes;
  Vec3 direction = Vec3::UnitX();
  Curve curve;
  double scale = 1;
};

}  // namespace crosswalk::fe
