// The tables of a scenario that fe_node owns: [fe] [head_neck] [windshield] [output].
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/body_description.h"
#include "common/contact_shapes.h"
#include "common/scenario.h"
#include "fe_node/generate/head_neck.h"

namespace crosswalk::fe {

struct HeadNeckConfig {
  bool is_generated = true;
  std::filesystem::path deck;  ///< when not generated
  UnitSystem units = UnitSystem::Unknown;
  generate::HeadNeckSpec spec;
  /// Point of the deck that stands on the multibody C7/T1 joint, m, deck frame.
  Vec3 joint = Vec3::Zero();
  std::string skull_set, head_parts, brain_parts, surface_parts;  ///< names in the deck
};

struct FeConfig {
  HeadNeckConfig head_neck;
  std::vector<InterfaceSpec> interfaces;   ///< attached ones first
  std::vector<BodyShapes> partner_shapes;  ///< of the followers
  BodyDescription body;                    ///< for the place of the joint
  double vehicle_friction = 0.3, self_friction = 0.2;
  double gravity = 0;  ///< m/s2, downwards
  double step_scale = 0.9;
  double added_mass_limit = 0.01;  ///< share of the whole mass that mass scaling may add
  double field_interval = 1e-3;    ///< s; 0: none
  double tissue_interval = 1e-3;   ///< s between published metrics
  double strain_interval = 2e-4;   ///< s between samples of the strain peaks
};

FeConfig read_fe_config(ConfigDocument& document, const Scenario& scenario);

}  // namespace crosswalk::fe
