// Everything constant of a multibody run, and everything that changes, apart from each other.
//
// MbModel is built once (world_builder); MbState is a value: copying it saves the run. Bodies keep
// two points apart: the reference point (centre of mass of the description, the one reports speak
// of) and the engine's centre of mass, which finite-element block masses may have shifted.
#pragma once

#include <array>
#include <vector>

#include "common/energy_books.h"
#include "mb_node/contact_law.h"
#include "mb_node/front_contact.h"
#include "mb_node/joint_law.h"
#include "mb_node/mb_config.h"
#include "mb_node/ode_world.h"

namespace crosswalk::mb {

/// Tension-only spring between the bound ends of the arms.
struct WristTie {
  BodyPoint left, right;  ///< from the reference points
  double rest = 0;        ///< m
};

/// Ellipsoid of the body surface as the contacts need it.
struct SurfacePart {
  int segment = -1;
  int region = -1;
  Vec3 p_B = Vec3::Zero();  ///< centre from the reference point, body axes
  Vec3 semi_axes = Vec3::Zero();
  double reach = 0;  ///< largest semi-axis
  double ground_stiffness = 0;
};

struct SelfContactPair {
  int first = -1, second = -1;  ///< surface parts
  int law = -1;
  double initial_depth = 0;  ///< overlap of the start, which carries no force
};

struct JointInitial {
  Vec3 angle = Vec3::Zero();
  double passive = 0;
};

struct MbModel {
  MbConfig config;
  std::vector<Pose> X_WB0;             ///< of the reference points at t = 0
  std::vector<Vec3> reference_offset;  ///< reference point from the engine's COM, body axes
  std::vector<JointInitial> initial;   ///< by segment
  std::vector<int> bone_of;            ///< by segment: index of its bone, -1: no bone joint
  int bone_count = 0;
  struct PassiveLinks {
    int hip = -1, knee = -1, ankle = -1;  ///< child segments of the leg's joints
  };
  std::vector<PassiveLinks> passive;  ///< by segment: the leg a passive coordinate belongs to
  std::vector<SurfacePart> parts;
  std::vector<FrontChain> chains;
  FrontPanels panels;
  std::vector<ContactLaw> car_laws;  ///< [region * components + component]
  std::vector<ContactLaw> self_laws;
  std::vector<SelfContactPair> self_pairs;
  std::vector<Vec3> bushing_home;  ///< scapula reference point in torso_up axes at the start
  std::vector<WristTie> ties;
  int head = -1;  ///< segment, -1 in a coupled run

  int components() const { return static_cast<int>(config.vehicle.front.components.size()); }
};

struct JointHistory {
  std::array<CoordinateHistory, 3> coordinate;
  BoneHistory bone;
};

struct Energies {
  double joint_work = 0;          ///< done by restraints on the bodies
  double contact_work = 0;        ///< done by all contacts on the bodies
  double car_work = 0;            ///< done by the moving car on its contacts
  double interface_work = 0;      ///< done by the finite-element side on the bodies
  double car_interface_work = 0;  ///< and on the car
  LossBooks lost;
};

struct MbState {
  WorldState world;
  VehicleState vehicle;
  std::vector<JointHistory> joints;        ///< by segment
  std::vector<PanelContact> car_contacts;  ///< [part * panels + panel]
  std::vector<double> self_deepest;        ///< by self-contact pair
  std::vector<char> bone_broken;           ///< by bone
  Energies energy;
  std::uint64_t contact_set = 0;  ///< hash of the pairs in touch in the last substep
  std::int64_t substeps = 0;
  double time = 0;
  double first_contact_time = -1;  ///< s; -1: not yet
};

}  // namespace crosswalk::mb
