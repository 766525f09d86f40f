// The tables of a scenario that fe_node owns: [fe] [head_neck] [windshield] [output].
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/body_description.h"
#include "common/contact_shapes.h"
#include "common/scenario.h"
#include "fe_node/element/element_controls.h"
#include "fe_node/generate/head_neck.h"
#include "fe_node/generate/windshield.h"

namespace crosswalk::fe {

/// What the parts of an own deck are: the title of a set, or part numbers and titles.
struct PartNames {
  std::string head, brain, surface, skull;
};

struct HeadNeckConfig {
  bool is_generated = true;
  generate::HeadNeckSpec spec;  ///< when generated

  // An own deck, frame D.
  std::filesystem::path deck;
  UnitSystem units = UnitSystem::Unknown;
  Vec3 joint = Vec3::Zero();        ///< m: stands on the multibody C7/T1 joint
  Quat q_ND = Quat::Identity();     ///< turns the deck's axes to forward, left, up
  std::optional<Vec3> head_centre;  ///< m: reported point; none: the head parts' mass centre
  PartNames names;
};

struct FeConfig {
  bool is_head_alone = false;  ///< the head without its neck (RunMode)
  HeadNeckConfig head_neck;
  std::vector<InterfaceSpec> interfaces;               ///< attached ones first
  std::vector<BodyShapes> partner_shapes;              ///< of the followers
  std::optional<generate::WindshieldSpec> windshield;  ///< none: the car's force curve
  double wake_distance = 0.060;  ///< m: the head this near, the windshield takes part
  BodyDescription body;          ///< for the place of the joint
  double vehicle_friction = 0.3, self_friction = 0.2;
  double gravity = 0;  ///< m/s2, downwards
  double step_scale = 0.9;
  Precision precision = Precision::Single;
  double added_mass_limit = 0.01;  ///< share of head and neck that mass scaling may add
  double field_interval = 1e-3;    ///< s; 0: none
  double tissue_interval = 1e-3;   ///< s between published metrics
  double strain_interval = 2e-4;   ///< s between samples of the strain peaks
  bool logs_block_motion = false;  ///< as a deck, model/driven.k
};

FeConfig read_fe_config(ConfigDocument& document, const Scenario& scenario);

}  // namespace crosswalk::fe
