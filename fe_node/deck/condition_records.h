// Boundary and initial conditions, loads, damping and constraints as a keyword deck gives them.
//
// Times, lengths and forces in user units. `kNever` (1e20) where the manual has an open end.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "common/spatial.h"
#include "fe_node/deck/deck_id.h"
#include "fe_node/deck/material_records.h"
#include "fe_node/deck/part_records.h"

namespace crosswalk::fe {

/// Does a condition name one node, or a node set?
enum class NodeTarget { Node, Set };

/// *BOUNDARY_SPC_NODE, _SET (option BIRTH_DEATH)
struct Spc {
  NodeTarget kind = NodeTarget::Node;
  DeckId id;  ///< of the condition (option ID)
  std::string title;
  DeckId target, axes;
  std::array<int, 6> fixed{};  ///< x y z, rx ry rz
  double birth = 0, death = kNever;
  Source source;
  bool operator==(const Spc&) const = default;
};

enum class MotionTarget { Node, NodeSet, Rigid, RigidLocal };

/// *BOUNDARY_PRESCRIBED_MOTION_NODE, _SET, _RIGID, _RIGID_LOCAL
struct PrescribedMotion {
  MotionTarget kind = MotionTarget::Node;
  DeckId id;
  std::string title;
  DeckId target;
  int dof = 0;  ///< 1 2 3 x y z; 5 6 7 about x y z; +-4, +-8: along/about vector; 9..11 rotation
                ///< about an axis
  int quantity = 0;  ///< VAD 0 velocity, 1 acceleration, 2 displacement, 3 velocity vs
                     ///< displacement, 4 relative displacement
  DeckId curve;
  double scale = 1;
  DeckId vector;
  double death = 1e28, birth = 0;
  double offset_1 = 0, offset_2 = 0;  ///< dof 9..11 or VAD 4: second card
  int master_part = 0;
  std::array<DeckId, 2> master_nodes;
  Source source;
  bool operator==(const PrescribedMotion&) const = default;
};

/// *INITIAL_VELOCITY: a node set (0: all nodes) except another
struct InitialVelocity {
  DeckId set, excepted_set, box;
  int rigid_option = 0;  ///< IRIGID
  DeckId axes;
  Vec3 velocity = Vec3::Zero(), angular = Vec3::Zero();
  Vec3 excepted_velocity = Vec3::Zero(), excepted_angular = Vec3::Zero();
  Source source;
  bool operator==(const InitialVelocity&) const = default;
};

/// *INITIAL_VELOCITY_NODE, *INITIAL_VELOCITY_RIGID_BODY
struct InitialVelocityOf {
  DeckId target;  ///< node or rigid part
  Vec3 velocity = Vec3::Zero(), angular = Vec3::Zero();
  DeckId axes;
  Source source;
  bool operator==(const InitialVelocityOf&) const = default;
};

/// *INITIAL_VELOCITY_GENERATION
struct InitialVelocityGeneration {
  DeckId target;
  int target_kind = 0;  ///< STYP 1 part set, 2 part, 3 node set; id 0: everything
  double omega = 0;     ///< rad per time
  Vec3 velocity = Vec3::Zero();
  int velocity_given = 0;  ///< IVATN
  DeckId axes;
  Vec3 center = Vec3::Zero(), axis = Vec3::Zero();
  int phase = 0, rigid_option = 0;
  Source source;
  bool operator==(const InitialVelocityGeneration&) const = default;
};

/// *LOAD_NODE_POINT, _SET
struct LoadNode {
  NodeTarget kind = NodeTarget::Node;
  DeckId target;
  int dof = 0;  ///< 1 2 3 force, 5 6 7 moment, 4 8 follower
  DeckId curve;
  double scale = 1;
  DeckId axes;
  std::array<DeckId, 3> follower_nodes;
  Source source;
  bool operator==(const LoadNode&) const = default;
};

/// *LOAD_RIGID_BODY
struct LoadRigidBody {
  DeckId part;
  int dof = 0;
  DeckId curve;
  double scale = 1;
  DeckId axes;
  std::array<DeckId, 3> follower_nodes;
  Source source;
  bool operator==(const LoadRigidBody&) const = default;
};

/// *LOAD_SEGMENT (nodes) and *LOAD_SEGMENT_SET, *LOAD_SHELL_SET / _ELEMENT: pressure
struct LoadPressure {
  enum class Target { Segment, SegmentSet, Shell, ShellSet };
  Target kind = Target::Segment;
  DeckId target;                ///< set or element; not used for a segment
  std::array<DeckId, 4> nodes;  ///< of a segment
  DeckId curve;
  double scale = 1;
  double arrival = 0;
  Source source;
  bool operator==(const LoadPressure&) const = default;
};

/// *LOAD_BODY_X, _Y, _Z (and _RX, _RY, _RZ): base acceleration; positive acts along -axis on the
/// mass
struct LoadBody {
  int axis = 0;  ///< 0 1 2 translation, 3 4 5 rotation
  DeckId curve;
  double scale = 1;
  DeckId dynamic_relaxation_curve;
  Vec3 center = Vec3::Zero();
  DeckId axes;
  Source source;
  bool operator==(const LoadBody&) const = default;
};

/// *LOAD_BODY_PARTS: the body loads act on this part set only
struct LoadBodyParts {
  DeckId part_set;
  Source source;
  bool operator==(const LoadBodyParts&) const = default;
};

/// *DAMPING_GLOBAL, *DAMPING_PART_MASS[_SET], *DAMPING_PART_STIFFNESS[_SET]
struct Damping {
  enum class Kind { Global, PartMass, PartStiffness };
  Kind kind = Kind::Global;
  bool is_part_set = false;
  DeckId target;  ///< part or part set
  DeckId curve;
  double value = 0;                 ///< constant (global), scale (mass) or coefficient (stiffness)
  std::array<double, 6> factors{};  ///< STX STY STZ SRX SRY SRZ
  int has_factors = 0;              ///< FLAG of *DAMPING_PART_MASS
  Source source;
  bool operator==(const Damping&) const = default;
};

/// *CONSTRAINED_RIGID_BODIES: the second part joins the first
struct MergedRigidBodies {
  DeckId lead, follower;
  int flag = 0;
  Source source;
  bool operator==(const MergedRigidBodies&) const = default;
};

/// *CONSTRAINED_EXTRA_NODES_NODE, _SET
struct ExtraNodes {
  NodeTarget kind = NodeTarget::Node;
  DeckId part, target;
  int flag = 0;
  Source source;
  bool operator==(const ExtraNodes&) const = default;
};

/// *CONSTRAINED_NODAL_RIGID_BODY, option INERTIA, SPC
struct NodalRigidBody {
  DeckId id;
  std::string title;
  DeckId axes, node_set, center_node;
  int print = 0, released_translation = 0, released_rotation = 0;
  bool has_inertia = false;
  PartInertia inertia;  ///< as *PART_INERTIA
  bool has_spc = false;
  std::array<double, 3> spc{};  ///< CMO CON1 CON2
  Source source;
  bool operator==(const NodalRigidBody&) const = default;
};

enum class JointKind {
  Spherical,
  Revolute,
  Cylindrical,
  Planar,
  Universal,
  Translational,
  Locking
};

/// *CONSTRAINED_JOINT_...: node pairs of two rigid bodies
struct Joint {
  JointKind kind = JointKind::Spherical;
  DeckId id;
  std::string title;
  std::array<DeckId, 6> nodes;
  double penalty_scale = 1;  ///< RPS
  double damping = 1;        ///< DAMP
  bool is_local = false;     ///< option LOCAL: `axes` card
  DeckId accelerometer;
  int axes_option = 0;
  Source source;
  bool operator==(const Joint&) const = default;
};

/// *CONSTRAINED_JOINT_STIFFNESS_GENERALIZED (rotations phi theta psi), _TRANSLATIONAL (x y z)
struct JointStiffness {
  bool is_translational = false;
  DeckId id;
  std::string title;
  std::array<DeckId, 2> parts;
  std::array<DeckId, 2> axes;  ///< CIDA CIDB
  DeckId joint;
  std::array<DeckId, 3> stiffness_curves, damping_curves;
  std::array<double, 3> friction_stiffness{}, friction_limit{};
  std::array<double, 3> stop_negative{}, stop_positive{};  ///< degrees, or lengths
  Source source;
  bool operator==(const JointStiffness&) const = default;
};

/// *CONSTRAINED_SPOTWELD, *CONSTRAINED_GENERALIZED_WELD_SPOT, *CONSTRAINED_NODE_SET (dof only),
/// *CONSTRAINED_TIED_NODES_FAILURE (strain only)
struct NodeTie {
  enum class Kind { Spotweld, GeneralizedSpot, NodeSet, TiedNodesFailure };
  Kind kind = Kind::Spotweld;
  DeckId id;
  std::string title;
  std::array<DeckId, 2> nodes;               ///< spot weld
  DeckId node_set, axes;                     ///< the others
  int dof = 0;                               ///< node set: 1..7 x y z xy yz zx xyz
  double normal_force = 0, shear_force = 0;  ///< failure SN SS; 0: never
  double normal_exponent = 0, shear_exponent = 0;
  double failure_time = kNever;
  double failure_strain = 0;  ///< EP, 0 or 1e20: never
  int filter = 0, print = 0;
  double window = 0;
  int print_type = 0;
  Source source;
  bool operator==(const NodeTie&) const = default;
};

/// One independent node of *CONSTRAINED_INTERPOLATION
struct InterpolationNode {
  DeckId node;
  int dofs = 123456;  ///< digits 1..6
  double weight = 1;  ///< x; the other five as in the manual equal it when 0
  std::array<double, 5> more_weights{};
  bool operator==(const InterpolationNode&) const = default;
};

/// *CONSTRAINED_INTERPOLATION: the dependent node follows the weighted mean motion
struct Interpolation {
  DeckId id, dependent;
  int dofs = 123456;
  DeckId axes;
  int independent_kind = 0;  ///< ITYP 0 nodes, 1 node sets
  int set_option = 0;
  std::vector<InterpolationNode> nodes;
  Source source;
  bool operator==(const Interpolation&) const = default;
};

/// *RIGIDWALL_PLANAR (FINITE, MOVING, FORCES), *RIGIDWALL_GEOMETRIC_FLAT/PRISM/CYLINDER/SPHERE
/// (MOTION)
struct RigidWall {
  enum class Shape { Plane, Flat, Prism, Cylinder, Sphere };
  Shape shape = Shape::Plane;
  DeckId id;
  std::string title;
  DeckId node_set, excepted_set, box;  ///< node set 0: all nodes
  double offset = 0, birth = 0, death = kNever, stiffness = 0;
  Vec3 tail = Vec3::Zero(), head = Vec3::Zero();  ///< outward normal, or axis
  double friction = 0, critical_speed = 0;
  Vec3 edge_head = Vec3::Zero();  ///< finite plane, flat, prism
  double length_l = 0, length_m = 0, length_n = 0;
  double radius = 0, cylinder_length = 0;  ///< length 0: infinite
  bool is_finite = false, is_moving = false, has_display = false, has_forces = false;
  double mass = 0, initial_speed = 0;  ///< moving plane
  DeckId motion_curve;                 ///< geometric with MOTION
  int motion_option = 0;
  Vec3 motion_direction = Vec3::Zero();
  std::array<double, 8> display{};  ///< DISPLAY card: PID RO E PR
  std::array<double, 8> forces{};   ///< FORCES card: SOFT SSID N1..N4
  Source source;
  bool operator==(const RigidWall&) const = default;
};

}  // namespace crosswalk::fe
