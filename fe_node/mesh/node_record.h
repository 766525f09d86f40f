// The kinematic state of one node as the kernels read it: one cache line, so that a lane group
// loads eight nodes with eight aligned loads and a transpose. Frame W, SI.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/spatial.h"

namespace crosswalk::fe {

struct alignas(64) NodeRecord {
  double x[3] = {0, 0, 0};     ///< position at t, m
  double inverse_mass = 0;     ///< 1/kg; zero for a node that a constraint moves
  double v[3] = {0, 0, 0};     ///< velocity at t - dt/2 (leap-frog), m/s
  double inverse_inertia = 0;  ///< 1/(kg m2) of a shell's or beam's node; zero likewise

  Vec3 position() const { return {x[0], x[1], x[2]}; }
  Vec3 velocity() const { return {v[0], v[1], v[2]}; }
  void set_position(const Vec3& p) { Eigen::Map<Vec3>{x} = p; }
  void set_velocity(const Vec3& u) { Eigen::Map<Vec3>{v} = u; }
};
static_assert(sizeof(NodeRecord) == 64);

}  // namespace crosswalk::fe
