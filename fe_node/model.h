// The finite-element model: everything that does not change during a run. SI, frame W after
// placing. Built once by the model builder (or by hand in tests) and completed by finish().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fe_node/constraint/nodal.h"
#include "fe_node/constraint/rigid_body.h"
#include "fe_node/contact/contact.h"
#include "fe_node/element/element_block.h"
#include "fe_node/force_tiles.h"
#include "fe_node/mesh/mesh.h"
#include "fe_node/sleeper.h"
#include "fe_node/stable_step.h"

namespace crosswalk::fe {

struct SolverSettings {
  double step_scale = 0.9;       ///< of the stable step [hallquist2006, 22.1]
  double fixed_step = 0;         ///< s; > 0 overrules the estimate
  Curve step_limit;              ///< s over time: no step is longer; may be empty
  double mass_scaling_step = 0;  ///< s, unscaled; > 0: mass is added so that no node's is less
  double mass_damping = 0;       ///< 1/s, Rayleigh alpha on all nodes
  Vec3 gravity = Vec3::Zero();   ///< m/s2
};

struct StartVelocity {
  std::vector<int> nodes;
  Vec3 velocity = Vec3::Zero();
};

struct Model {
  Mesh mesh;
  std::vector<std::unique_ptr<const ElementBlock>> blocks;
  std::vector<RigidBody> bodies;
  std::vector<std::unique_ptr<const ContactInterface>> contacts;
  std::vector<FixedNode> fixed;
  std::vector<GuidedNodes> guided;
  std::vector<GuidedBody> guided_bodies;
  std::vector<BaseAcceleration> base_accelerations;
  std::vector<TiedNode> tied;
  std::vector<NodalForce> nodal_forces;
  std::vector<PressureLoad> pressures;
  std::vector<StartVelocity> start_velocities;
  std::vector<double> point_mass;  ///< kg per node, from mass elements; may be empty
  SolverSettings settings;
  std::optional<Sleeper> sleeper;  ///< set after finish()

  // Filled by finish().
  ForceTiles tiles;          ///< how corner forces are added up
  std::vector<double> mass;  ///< kg per node, added mass included
  /// kg per node as a contact feels it: nodes of a rigid body share the body's mass.
  std::vector<double> contact_mass;
  std::vector<double> inertia;     ///< kg m2 per node; empty without shells
  NodalMass resisting;             ///< see stable_step.h
  std::vector<int> body_of_node;   ///< index into bodies, or -1
  std::vector<double> added_mass;  ///< kg per part, by mass scaling
  std::vector<double> part_mass;   ///< kg per part, of its elements before that

  /// Lumps masses, adds what the settings ask for, cuts the force tiles. Call once, last.
  void finish();
  double total_mass() const;  ///< kg, added mass and rigid parts included
  bool has_rotations() const { return !inertia.empty(); }
};

}  // namespace crosswalk::fe
