// Nodes and elements as a keyword deck gives them: user ids, user units.
//
// Node lists keep the order and the repeated nodes of the card; solid_shape() and is_triangle()
// tell what degenerate cards mean. An id of 0 in a node list is an unused slot.
#pragma once

#include <array>
#include <span>

#include "common/spatial.h"
#include "fe_node/deck/deck_id.h"

namespace crosswalk::fe {

/// *NODE
struct DeckNode {
  DeckId id;
  Vec3 position = Vec3::Zero();
  int fixed_translation = 0;  ///< TC 0..7: none, x, y, z, xy, yz, zx, xyz
  int fixed_rotation = 0;     ///< RC likewise
  Source source;
  bool operator==(const DeckNode&) const = default;
};

enum class SolidShape { Hex8, Penta6, Pyramid5, Tet4, Tet10, Other };
const char* solid_shape_name(SolidShape shape);

/// *ELEMENT_SOLID (one line, or two lines with up to ten nodes)
struct SolidElement {
  DeckId id, part;
  std::array<DeckId, 10> nodes;  ///< as on the card; slots 8 and 9 only for tet10
  Source source;
  bool operator==(const SolidElement&) const = default;
};

/// What a solid card describes, with its distinct nodes in the usual order of that shape: hex8 and
/// tet10 as on the card; penta6 two triangles, the normal of the first towards the second; pyramid5
/// four base nodes, then the apex; tet4 three base nodes, then the apex. Other: repeated nodes that
/// make none of these.
struct ShapedSolid {
  SolidShape shape = SolidShape::Other;
  std::array<DeckId, 10> nodes;
  int count = 0;
};
ShapedSolid solid_shape(const SolidElement& element);

/// *ELEMENT_SHELL with the options THICKNESS, BETA, OFFSET, COMPOSITE
struct ShellElement {
  DeckId id, part;
  std::array<DeckId, 8> nodes;        ///< slots 4..7: mid-side nodes of quadratic shells
  std::array<double, 4> thickness{};  ///< at the corners; 0: from the section
  double material_angle_deg = 0;      ///< BETA or MCID given as an angle
  double offset = 0;                  ///< of the mid-surface along the normal
  Source source;
  bool operator==(const ShellElement&) const = default;
};
bool is_triangle(const ShellElement& element);

/// *ELEMENT_TSHELL: thick shells; read and counted, not computed.
struct ThickShellElement {
  DeckId id, part;
  std::array<DeckId, 8> nodes;
  Source source;
  bool operator==(const ThickShellElement&) const = default;
};

/// *ELEMENT_BEAM (also truss, cable and discrete beams: the section's formulation says which)
struct BeamElement {
  DeckId id, part;
  std::array<DeckId, 3> nodes;        ///< ends, orientation node (may be 0)
  std::array<int, 4> released{};      ///< RT1 RR1 RT2 RR2
  int local = 2;                      ///< 1: releases in global axes
  std::array<double, 5> thickness{};  ///< *ELEMENT_BEAM_THICKNESS PARM1..5; 0: from the section
  Vec3 orientation = Vec3::Zero();    ///< *ELEMENT_BEAM_ORIENTATION; zero: from the third node
  Source source;
  bool operator==(const BeamElement&) const = default;
};

/// *ELEMENT_DISCRETE: spring or damper
struct DiscreteElement {
  DeckId id, part;
  std::array<DeckId, 2> nodes;  ///< second may be 0: to ground
  DeckId orientation;           ///< VID
  double scale = 1;             ///< S, on the force
  int print = 0;                ///< PF
  double offset = 0;            ///< initial elongation
  Source source;
  bool operator==(const DiscreteElement&) const = default;
};

/// *ELEMENT_SEATBELT
struct SeatbeltElement {
  DeckId id, part;
  std::array<DeckId, 2> nodes;
  DeckId retractor;
  double slack_length = 0;
  Source source;
  bool operator==(const SeatbeltElement&) const = default;
};

enum class MassTarget { Node, NodeSet, Part, PartSet };

/// *ELEMENT_MASS, _NODE_SET, _PART, _PART_SET
struct MassElement {
  MassTarget kind = MassTarget::Node;
  DeckId id;              ///< element; 0 for the part forms
  DeckId target;          ///< node, node set, part or part set
  double mass = 0;        ///< added (per node for a node set: the total spread evenly)
  double final_mass = 0;  ///< part forms: total wanted instead, when > 0
  DeckId part;
  Source source;
  bool operator==(const MassElement&) const = default;
};

/// *ELEMENT_INERTIA
struct InertiaElement {
  DeckId id, node, axes;
  double ixx = 0, ixy = 0, ixz = 0, iyy = 0, iyz = 0, izz = 0, mass = 0;
  Source source;
  bool operator==(const InertiaElement&) const = default;
};

/// *ELEMENT_SEATBELT_ACCELEROMETER: a sensor on three nodes of a rigid body
struct AccelerometerElement {
  DeckId id;
  std::array<DeckId, 3> nodes;
  int gravity_removed = 0;
  int interval_option = 0;
  double mass = 0;
  Source source;
  bool operator==(const AccelerometerElement&) const = default;
};

}  // namespace crosswalk::fe
