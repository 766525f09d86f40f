// *CONTROL_ and *DATABASE_ cards a solver acts on, and keywords kept as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fe_node/deck/deck_id.h"

namespace crosswalk::fe {

/// *CONTROL_TIMESTEP
struct TimeStepControl {
  double initial = 0;
  double scale = 0.9;           ///< TSSFAC
  int shell_basis = 0;          ///< ISDO
  double shell_limit = 0;       ///< TSLIMT
  double mass_scaled_step = 0;  ///< DT2MS; < 0: only elements below |DT2MS| get mass
  DeckId limit_curve;
  int erode = 0, mass_scaled_option = 0;
  bool operator==(const TimeStepControl&) const = default;
};

/// *CONTROL_ENERGY
struct EnergyControl {
  int hourglass = 1, rigid_wall = 2, sliding = 1, damping = 1, initial_reference = 2;
  bool operator==(const EnergyControl&) const = default;
};

/// *CONTROL_HOURGLASS
struct HourglassControl {
  int type = 1;
  double coefficient = 0.1;
  bool operator==(const HourglassControl&) const = default;
};

/// *CONTROL_BULK_VISCOSITY
struct BulkViscosityControl {
  double quadratic = 1.5, linear = 0.06;
  int type = 1, beam_type = 0;
  bool operator==(const BulkViscosityControl&) const = default;
};

/// *CONTROL_CONTACT
struct ContactControl {
  double stiffness_scale = 0.1;  ///< SLSFAC
  double wall_penalty = 0;       ///< RWPNAL
  int initial_check = 1, shell_thickness = 0, penalty_option = 1, thickness_change = 0,
      orientation = 1, eroded_mass = 0;
  int user_storage = 0, user_friction = 0, bucket_steps = 0, interference = 0;
  double large_penetration = 0;
  int self_thickness = 0, eroded_step = 0, tied_projection = 0;
  double static_friction = 0, dynamic_friction = 0, decay = 0, viscous = 0, thickness = 0,
         thickness_scale = 0, penalty_scale = 0;
  int ignore = 0, friction_energy = 0;
  std::vector<std::string> more_cards;  ///< later cards as text
  bool operator==(const ContactControl&) const = default;
};

/// *CONTROL_SHELL
struct ShellControl {
  double warp_angle_deg = 20;
  int sort_triangles = 0;    ///< ESORT
  int normal_update = -1;    ///< IRNXX
  int thickness_update = 0;  ///< ISTUPD
  int theory = 2;
  int warping_stiffness = 2, plane_stress = 1, projection = 0;
  std::vector<std::string> more_cards;
  bool operator==(const ShellControl&) const = default;
};

/// *CONTROL_SOLID
struct SolidControl {
  int sort_degenerate = 0;  ///< ESORT
  int matrix_form = 0, tet_points = 4, local_axes = 1, failure_output = 0;
  double tet10_tolerance = 0;
  std::vector<std::string> more_cards;
  bool operator==(const SolidControl&) const = default;
};

/// *CONTROL_ACCURACY
struct AccuracyControl {
  int objective_update = 0, invariant_numbering = 1;
  DeckId part_set;
  bool operator==(const AccuracyControl&) const = default;
};

/// Values of *CONTROL_ cards; an absent card leaves the manual's defaults.
struct Control {
  std::optional<double> end_time;  ///< *CONTROL_TERMINATION ENDTIM
  int end_cycle = 0;
  double minimum_step_ratio = 0, energy_change = 0, mass_change = 0;
  std::optional<TimeStepControl> time_step;
  std::optional<EnergyControl> energy;
  std::optional<HourglassControl> hourglass;
  std::optional<BulkViscosityControl> bulk_viscosity;
  std::optional<ContactControl> contact;
  std::optional<ShellControl> shell;
  std::optional<SolidControl> solid;
  std::optional<AccuracyControl> accuracy;
  bool operator==(const Control&) const = default;
};

/// Output intervals by database name: *DATABASE_GLSTAT ... *DATABASE_BINARY_D3PLOT
struct DatabaseRequest {
  std::string keyword;  ///< "DATABASE_GLSTAT"
  double interval = 0;
  Source source;
  bool operator==(const DatabaseRequest&) const = default;
};

/// *DATABASE_HISTORY_NODE, _SHELL, _SOLID, _BEAM, _DISCRETE with options SET, ID, LOCAL
struct HistoryRequest {
  std::string kind;  ///< "NODE", "SHELL" ...
  bool is_set = false;
  DeckId id;
  std::string title;
  DeckId axes;
  Source source;
  bool operator==(const HistoryRequest&) const = default;
};

/// *DATABASE_CROSS_SECTION_SET: force through a section given by sets
struct CrossSection {
  DeckId id;
  std::string title;
  DeckId nodes, solids, beams, shells, thick_shells, discretes;
  DeckId reference;
  int reference_kind = 0;
  Source source;
  bool operator==(const CrossSection&) const = default;
};

/// What ignoring a keyword does to a run
enum class Effect {
  None,        ///< *KEYWORD, comments
  OutputOnly,  ///< only files another program would write
  Tuning,      ///< solver settings that do not exist here (memory, domain decomposition)
  Physics      ///< the run would not be what the deck says
};

/// A keyword the reader does not interpret, with its cards.
struct UnreadKeyword {
  std::string keyword;  ///< with all options, without the star
  Effect effect = Effect::Physics;
  std::string reason;              ///< why, in words of the report
  std::vector<std::string> cards;  ///< at most kKeptCards of them
  long card_count = 0;
  Source source;
  bool operator==(const UnreadKeyword&) const = default;
};

}  // namespace crosswalk::fe
