// The finite-element side of a coupled run as one model: head and neck, windshield, contact with
// what the multibody side shows, and the bodies through which both sides act on each other.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fe_node/block_motion.h"
#include "fe_node/boundary.h"
#include "fe_node/fe_config.h"
#include "fe_node/model_builder/model_builder.h"

namespace crosswalk::fe {

struct NodeModel {
  BuiltModel built;  ///< finished
  Boundary boundary;
  Vec3 joint = Vec3::Zero();              ///< point of the head's deck on the multibody C7/T1 joint
  std::vector<int> head_surface;          ///< nodes that may touch something
  std::vector<std::size_t> car_contacts;  ///< indices of the contacts of head and car
  BlockMotionSetup motion;                ///< but for the place at the start
  std::string report;                     ///< masses and mesh of a generated head and neck
};

/// Reads or generates the decks, writes them and the report to `folder`/model (empty: nowhere) and
/// builds the model. Throws UserError.
NodeModel build_node_model(const FeConfig& config, const std::filesystem::path& folder);

/// Index into BuiltModel::part_sets; throws UserError when absent.
int require_part_set(const BuiltModel& built, const std::string& name);

/// True when a node of the head is within `config.wake_distance` of the pane, a body frame of the
/// buck at X_WB.
bool is_near_windshield(const FeConfig& config, const NodeModel& model, const State& state,
                        const Pose& X_WB);
/// Frame B of the windshield's deck in the buck's frame of the multibody side.
Pose windshield_in_buck();

}  // namespace crosswalk::fe
