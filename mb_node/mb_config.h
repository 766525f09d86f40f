// The tables of a scenario that mb_node owns: [subject] [posture] [vehicle] [multibody]
// [environment].
#pragma once

#include "common/body_description.h"
#include "common/scenario.h"
#include "mb_node/ode_world.h"
#include "mb_node/posture.h"
#include "mb_node/vehicle.h"

namespace crosswalk::mb {

struct MultibodySettings {
  double substep = 1e-5;  ///< s, largest
  Stepper stepper = Stepper::Direct;
  int quick_iterations = OdeWorld::kQuickIterations;
  bool fracture = true;      ///< long bones may break
  bool knee_failure = true;  ///< knee ligaments may tear
  bool self_contact = true;
  bool replaces_t1_t3 = true;  ///< the attached block of torso_up is part of its mass already
  double tie_stiffness = 0, tie_damping = 0;  ///< N/m, N s/m: bound wrists
  Vec3 gravity = Vec3::Zero();
};

struct MbConfig {
  BodyDescription body;  ///< as the run needs it: with or without head and neck
  PostureSettings posture;
  Vehicle vehicle;
  MultibodySettings multibody;
  std::vector<InterfaceSpec> interfaces;
};

MbConfig read_mb_config(ConfigDocument& document, const Scenario& scenario);

}  // namespace crosswalk::mb
