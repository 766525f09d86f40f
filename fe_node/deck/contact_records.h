// *CONTACT_... as a keyword deck gives it: user ids, user units.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fe_node/deck/deck_id.h"
#include "fe_node/deck/material_records.h"

namespace crosswalk::fe {

enum class ContactKind {
  SingleSurface,     ///< AUTOMATIC_SINGLE_SURFACE, SINGLE_SURFACE
  General,           ///< AUTOMATIC_GENERAL
  SurfaceToSurface,  ///< AUTOMATIC_SURFACE_TO_SURFACE
  OneWaySurfaceToSurface,
  NodesToSurface,
  TiedNodesToSurface,
  TiedSurfaceToSurface,
  TiedShellEdgeToSurface,
  ForceTransducer,  ///< measures only
  Unsupported
};

/// What an SSID/MSID number names (SSTYP)
enum class SurfaceKind : int {
  SegmentSet = 0,
  ShellSet = 1,
  PartSet = 2,
  Part = 3,
  NodeSet = 4,
  All = 5,
  ExemptedPartSet = 6
};

struct ContactSide {
  DeckId id;
  SurfaceKind kind = SurfaceKind::SegmentSet;
  DeckId box;
  int print = 0;
  double stiffness_scale = 1;  ///< SFS, SFM
  double thickness = 0;        ///< SST, MST; 0: the elements' own
  double thickness_scale = 1;  ///< SFST, SFMT
  bool operator==(const ContactSide&) const = default;
};

/// Optional card A
struct ContactCardA {
  int soft = 0;  ///< 0 penalty from bulk, 1 soft constraint, 2 segment based
  double soft_scale = 0.1;
  DeckId airbag_curve;
  double segment_extension = 1.025;  ///< MAXPAR
  double segment_option = 2;         ///< SBOPT
  int depth = 2;
  int bucket_steps = 0;  ///< BSORT
  int force_steps = 1;   ///< FRCFRQ
  bool operator==(const ContactCardA&) const = default;
};

/// Optional card B
struct ContactCardB {
  double maximum_penetration = 0;
  int thickness_option = 0;  ///< THKOPT
  int shell_thickness = 0;   ///< SHLTHK
  int shooting_node = 0;     ///< SNLOG
  int symmetry = 0;          ///< ISYM
  int search = 0;            ///< I2D3D
  double solid_thickness = 0, solid_stiffness = 0;
  bool operator==(const ContactCardB&) const = default;
};

/// Optional card C
struct ContactCardC {
  int igap = 1;
  int ignore =
      0;  ///< initial penetrations: 0 move nodes, 1 track and allow, 2 the same with warnings
  double depth_reduction = 0, time_step_stiffness = 0;  ///< DPRFAC DTSTIF
  double edge_scale = 0;                                ///< EDGEK
  double flange_angle = 0;
  DeckId output_axes;  ///< CID_RCF
  bool operator==(const ContactCardC&) const = default;
};

struct Contact {
  std::string keyword;  ///< without *CONTACT_ and without ID, TITLE, MPP: AUTOMATIC_SINGLE_SURFACE
  ContactKind kind = ContactKind::Unsupported;
  bool is_automatic = false, is_eroding = false, is_tiebreak = false, has_offset = false;
  DeckId id;
  std::string title;
  ContactSide slave, master;
  double static_friction = 0, dynamic_friction = 0, decay = 0, viscous_friction = 0;
  double damping_percent = 0;  ///< VDC, of critical
  int penetration_check = 0;
  double birth = 0, death = kNever;
  double friction_scale = 1, viscous_scale = 1;  ///< FSF VSF
  std::array<double, 8> special{};  ///< card 4 of eroding, tiebreak ... kinds, as fields
  std::optional<ContactCardA> card_a;
  std::optional<ContactCardB> card_b;
  std::optional<ContactCardC> card_c;
  std::vector<std::string> mpp_cards;    ///< kept as text
  std::vector<std::string> extra_cards;  ///< optional cards D and later, as text
  Source source;
  bool operator==(const Contact&) const = default;
};

/// A contact of that keyword (without *CONTACT_), its kind and adjectives set, all else default.
Contact contact_named(const std::string& keyword);

}  // namespace crosswalk::fe
