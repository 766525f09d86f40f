// Parts, sections, hourglass controls and equations of state as a keyword deck gives them.
//
// User ids, user units. A field that the manual says defaults when blank or zero holds the default.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/spatial.h"
#include "fe_node/deck/deck_id.h"

namespace crosswalk::fe {

/// *PART_INERTIA: mass properties given instead of computed (rigid parts)
struct PartInertia {
  Vec3 center = Vec3::Zero();
  double mass = 0;
  int axes_kind = 0;  ///< IRCS 0: global, 1: `axes` below
  DeckId center_node;
  double ixx = 0, ixy = 0, ixz = 0, iyy = 0, iyz = 0, izz = 0;
  Vec3 velocity = Vec3::Zero();                         ///< of the centre
  Vec3 angular_velocity = Vec3::Zero();                 ///< rad per time unit
  Vec3 x_axis = Vec3::Zero(), in_plane = Vec3::Zero();  ///< local axes when axes_kind is 1
  DeckId axes;                                          ///< CID, instead of the two vectors
  bool operator==(const PartInertia&) const = default;
};

/// *PART_CONTACT: contact values of this part; 0: those of the contact
struct PartContact {
  double static_friction = 0, dynamic_friction = 0, decay = 0, viscous = 0;
  double thickness = 0;        ///< OPTT
  double thickness_scale = 0;  ///< SFT
  double stiffness_scale = 0;  ///< SSF
  double damping_percent = 0;  ///< CPARM8
  bool operator==(const PartContact&) const = default;
};

/// One layer of *PART_COMPOSITE, from the bottom
struct CompositeLayer {
  DeckId material;
  double thickness = 0;
  double angle_deg = 0;
  bool operator==(const CompositeLayer&) const = default;
};

/// *PART_COMPOSITE: the layers and the section values given with the part
struct PartComposite {
  int formulation = 2;
  double shear_factor = 1;
  double reference_position = 0;  ///< NLOC: 0 mid, 1 top, -1 bottom
  double area_mass = 0;           ///< MAREA
  DeckId hourglass;
  int adaptive = 0;
  int thick_shell_option = 0;
  std::vector<CompositeLayer> layers;
  bool operator==(const PartComposite&) const = default;
};

/// *PART and its options
struct Part {
  DeckId id;
  std::string title;
  DeckId section, material;
  DeckId equation_of_state, hourglass;
  int gravity_option = 0, adaptive_option = 0;
  DeckId thermal;
  bool is_averaged = false;  ///< *PART_AVERAGED: one strain along a chain of beams
  std::optional<PartInertia> inertia;
  std::optional<PartContact> contact;
  std::optional<PartComposite> composite;  ///< then section and material are 0
  Source source;
  bool operator==(const Part&) const = default;
};

/// *SECTION_SOLID
struct SectionSolid {
  int formulation =
      1;  ///< ELFORM; 1 one-point, 2 selective-reduced, 13 nodal-pressure tet, 10 tet, 16 tet10
  int ambient = 0;  ///< AET
  bool operator==(const SectionSolid&) const = default;
};

/// *SECTION_SHELL
struct SectionShell {
  int formulation = 2;
  double shear_factor = 1;
  int points = 2;  ///< NIP through the thickness
  double print_option = 0;
  double rule =
      0;  ///< QR/IRID: quadrature 0 Gauss, 1 Lobatto/trapezoid; < 0: -*INTEGRATION_SHELL id
  int composite_flag = 0;  ///< ICOMP
  int setting = 1;         ///< SETYP
  std::array<double, 4> thickness{};
  double reference_position = 0;  ///< NLOC
  double area_mass = 0;           ///< MAREA
  double in_plane_rule = 0;       ///< IDOF
  int edge_set = 0;
  std::vector<double> angles_deg;  ///< ICOMP = 1: one per point
  bool operator==(const SectionShell&) const = default;
};

/// *SECTION_TSHELL; read, not computed
struct SectionThickShell {
  int formulation = 1;
  double shear_factor = 1;
  int points = 2;
  double print_option = 0;
  double rule = 0;
  int composite_flag = 0;
  std::vector<double> angles_deg;
  bool operator==(const SectionThickShell&) const = default;
};

/// *SECTION_BEAM; which members hold depends on the formulation
struct SectionBeam {
  int formulation =
      1;  ///< 1 Hughes-Liu, 2 Belytschko-Schwer, 3 truss, 6 discrete/cable, 9 spot weld
  double shear_factor = 1;
  double rule = 0;           ///< QR/IRID
  double cross_section = 0;  ///< CST: 0 rectangular, 1 tubular, 2 user
  double third_node = 0;     ///< SCOOR
  double length_mass = 0;    ///< NSM
  int area_update = 0;
  std::array<double, 2> outer_s{},
      outer_t{};                          ///< 1, 4, 5, 9: TS1 TS2 (outer diameter), TT1 TT2 (inner)
  double location_s = 0, location_t = 0;  ///< NSLOC NTLOC
  double area = 0;                        ///< 2, 3
  double iss = 0, itt = 0, torsion = 0, shear_area = 0, ist = 0;  ///< 2
  double ramp_time = 0, initial_stress = 0;                       ///< 3
  double volume = 0, inertia = 0;                                 ///< 6
  DeckId axes;
  double cable_area = 0, cable_offset = 0;
  std::array<double, 3> axis_control{};  ///< RRCON SRCON TRCON
  std::string shape;                     ///< standard cross section "SECTION_01" ...
  std::array<double, 6> dimensions{};    ///< D1..D6 of that
  bool operator==(const SectionBeam&) const = default;
};

/// *SECTION_DISCRETE
struct SectionDiscrete {
  int is_rotational = 0;                         ///< DRO
  double dynamic_factor = 0, test_velocity = 0;  ///< KD V0
  double clearance = 0, failure_deflection = 0;
  double compression_limit = 0, tension_limit = 0;
  bool operator==(const SectionDiscrete&) const = default;
};

/// *SECTION_SEATBELT
struct SectionSeatbelt {
  double area = 0, thickness = 0;
  bool operator==(const SectionSeatbelt&) const = default;
};

struct Section {
  DeckId id;
  std::string title;
  std::variant<SectionSolid, SectionShell, SectionThickShell, SectionBeam, SectionDiscrete,
               SectionSeatbelt>
      law;
  Source source;
  bool operator==(const Section&) const = default;
};

/// One point of *INTEGRATION_SHELL
struct IntegrationPoint {
  double position = 0;  ///< S in -1..1
  double weight = 0;    ///< share of the thickness
  DeckId part;          ///< whose material this layer has; 0: the part's own
  bool operator==(const IntegrationPoint&) const = default;
};

/// *INTEGRATION_SHELL
struct IntegrationShell {
  DeckId id;
  int points = 0;          ///< NIP
  int equally_spaced = 0;  ///< ESOP 1: `rows` empty
  int failure_option = 0;
  std::vector<IntegrationPoint> rows;
  Source source;
  bool operator==(const IntegrationShell&) const = default;
};

/// *HOURGLASS
struct Hourglass {
  DeckId id;
  std::string title;
  int type = 0;                                     ///< IHQ; 0: that of *CONTROL_HOURGLASS
  double coefficient = 0.1;                         ///< QM
  int bulk_type = 0;                                ///< IBQ
  double quadratic_bulk = 1.5, linear_bulk = 0.06;  ///< Q1 Q2
  double bending = 0, warping = 0;                  ///< QB QW; 0: QM
  Source source;
  bool operator==(const Hourglass&) const = default;
};

/// *EOS_LINEAR_POLYNOMIAL
struct EosLinearPolynomial {
  std::array<double, 7> c{};
  double energy = 0, volume = 1;
  bool operator==(const EosLinearPolynomial&) const = default;
};

/// *EOS_GRUNEISEN
struct EosGruneisen {
  double c = 0, s1 = 0, s2 = 0, s3 = 0, gamma0 = 0, a = 0, energy = 0, volume = 1;
  bool operator==(const EosGruneisen&) const = default;
};

/// *EOS_TABULATED
struct EosTabulated {
  double gamma = 0, energy = 0, volume = 1;
  DeckId c_curve, t_curve;
  std::array<double, 10> strain{}, c{}, t{};  ///< ln volume, pressure, temperature-like factor
  bool operator==(const EosTabulated&) const = default;
};

struct EquationOfState {
  DeckId id;
  std::string title;
  std::variant<EosLinearPolynomial, EosGruneisen, EosTabulated> law;
  Source source;
  bool operator==(const EquationOfState&) const = default;
};

}  // namespace crosswalk::fe
