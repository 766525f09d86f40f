// Contact of finite-element nodes with analytic surfaces of a rigid body.
//
// A patch is a set of shapes that share one law. Penalty: every node has its own spring of
// k = scale m / dt0^2 (soft constraint: stable for any material pair) and a damper. Characteristic:
// the whole patch follows one measured force-penetration curve F(d) of the deepest node, as
// multibody codes state it; the force is spread over the nodes in proportion to their depth.
// Unloading from (d_max, F_max) is F = F_max ((d - d_p)/(d_max - d_p))^n with d_p the permanent
// part. Coulomb friction, capped so that it can at most halve a node's sliding speed in a step.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "common/curve.h"
#include "fe_node/contact/contact.h"
#include "fe_node/contact/rigid_shape.h"

namespace crosswalk::fe {

struct PenaltyLaw {
  double scale = 0.1;  ///< of m / dt0^2; below 0.25 the nodal oscillation is stable at dt0
  double reference_step = 1e-6;  ///< dt0, s
  double damping_ratio = 0.1;    ///< of critical, per node
};

struct CharacteristicLaw {
  Curve loading;                  ///< m -> N
  double permanent_fraction = 0;  ///< d_p / d_max
  double unloading_exponent = 1;
  double rate = 0;  ///< s/m: F (1 + rate v), v the approach speed within -3 .. 6 m/s
};

struct RigidPatch {
  std::string name;
  std::vector<RigidShape> shapes;
  std::variant<PenaltyLaw, CharacteristicLaw> law;
};

struct RigidSurfaceSpec {
  std::string name;
  int body = 0;            ///< index into Model::bodies
  std::vector<int> nodes;  ///< candidates, for example of an outer surface
  std::vector<RigidPatch> patches;
  double friction = 0;
  /// Search margin is this speed times the steps between searches, m/s.
  double fastest = 60;
};

std::unique_ptr<ContactInterface> make_rigid_surface_contact(RigidSurfaceSpec spec);

}  // namespace crosswalk::fe
