// Everything that changes during a run, as a plain value: save is copy, restore is assign.
#pragma once

#include <cstdint>
#include <vector>

#include "fe_node/constraint/rigid_body.h"
#include "fe_node/contact/contact.h"
#include "fe_node/energy.h"
#include "fe_node/material/lanes.h"
#include "fe_node/mesh/node_record.h"
#include "fe_node/sleeper.h"

namespace crosswalk::fe {

/// Doubles aligned for lane loads.
using LaneVector = std::vector<double, Eigen::aligned_allocator<double>>;

struct StepReport {
  double stable_step = 0;  ///< s, smallest over nodes and contacts, unscaled
  /// Block and block-local element with the smallest step of its own; -1: a contact's is smaller.
  int critical_block = -1, critical_element = -1;
};

struct State {
  double time = 0;           ///< s
  std::int64_t step = 0;     ///< steps done
  double last_dt = 0;        ///< s, of the step that led here
  double stable_step = 0;    ///< s, unscaled, of the last force evaluation; 0 before the first
  StepReport element_limit;  ///< what the elements allow, found anew every few steps
  std::int64_t awake_from = kAsleep;  ///< step at which a sleeper woke
  std::vector<NodeRecord> nodes;
  std::vector<Vec3> spin;           ///< nodal angular velocity at t - dt/2; empty without shells
  std::vector<BodyState> bodies;    ///< like Model::bodies
  std::vector<LaneVector> history;  ///< per block
  std::vector<ContactHistory> contacts;
  Energies energies;
};

struct Model;

/// Stress-free state with the deck's frame D placed at X_WD and moving with V_WD (of D's origin).
State initial_state(const Model& model, const Pose& X_WD = {}, const Twist& V_WD = {});

}  // namespace crosswalk::fe
