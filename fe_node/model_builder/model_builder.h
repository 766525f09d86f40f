// From a keyword deck to a model: units are converted once, here; everything that cannot be run is
// reported with its place, all at once.
#pragma once

#include <string>
#include <vector>

#include "fe_node/contact/joint.h"
#include "fe_node/contact/joint_stiffness.h"
#include "fe_node/contact/mesh_contact.h"
#include "fe_node/contact/rigid_surface.h"
#include "fe_node/deck/deck.h"
#include "fe_node/element/element_controls.h"
#include "fe_node/history_requests.h"
#include "fe_node/model.h"

namespace crosswalk::fe {

struct BuildOptions {
  UnitSystem units = UnitSystem::Unknown;  ///< overrules what the deck states
  /// Rigid parts, by name, that follow bodies of the multibody side.
  std::vector<std::string> driven_parts;
  /// Added after the deck's own bodies, in this order: bodies that only lend contact surfaces.
  std::vector<std::string> followers;
  /// s, unscaled; > 0: nodes get mass added until none needs a smaller step. Negative: as the deck
  /// says (*CONTROL_TIMESTEP DT2MS, which includes the safety factor).
  double mass_scaling_step = -1;
  Precision precision = Precision::Double;
  /// Nodes of this id and above come behind all others in the mesh (a part that may sleep);
  /// 0: no such.
  int last_nodes_from = 0;
};

struct BuiltModel {
  Model model;                                      ///< complete but for finish()
  double end_time = 0;                              ///< s, of *CONTROL_TERMINATION; 0: none
  double field_interval = 0, history_interval = 0;  ///< s, of *DATABASE cards; 0: none
  HistoryRequests histories;
  std::vector<std::string> notes;  ///< choices the user should know of
  /// Sets of parts by title: indices into Mesh::parts.
  std::vector<std::pair<std::string, std::vector<int>>> part_sets;
  int part_set(std::string_view name) const;  ///< index, or -1
  /// Rigid walls, added to the model by finish_model() when the stable step is known.
  std::vector<RigidSurfaceSpec> walls;
  std::vector<MeshContactSpec> mesh_contacts;         ///< likewise
  std::vector<JointSpec> joints;                      ///< likewise; the last contacts of the model
  std::vector<JointStiffnessSpec> joint_stiffnesses;  ///< likewise, behind the joints
};

/// Calls Model::finish(), then adds the walls, contacts and joints.
void finish_model(BuiltModel& built);

/// Throws UserError.
BuiltModel build_model(const Deck& deck, const BuildOptions& options);

}  // namespace crosswalk::fe
