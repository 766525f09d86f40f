// The windshield as a shell model on a rigid frame that follows the buck.
//
// Frame B of the buck: x rearward from its foremost point, z up from the ground, y to complete (car
// drives along -x); metres. The pane is bonded to the frame by a soft bead, so that its edge is
// held across but free to turn. panel: the elasto-plastic sheet of the test buck [yu2020, App. A];
// its curve is not published, a mild steel sheet stands in [E]. laminated: two glass plies and PVB.
#pragma once

#include <string>

#include "common/spatial.h"
#include "fe_node/deck/deck.h"
#include "fe_node/generate/part_spec.h"

namespace crosswalk::fe::generate {

enum class WindshieldKind { Panel, Laminated };

struct WindshieldSpec {
  WindshieldKind kind = WindshieldKind::Panel;
  double cell = 0.010;                                       ///< m; 5 mm as in [yu2020, App. A]
  double lower_x = 1.070, lower_z = 0.990;                   ///< middle of the lower edge, B [E]
  double upper_x = 1.840, upper_z = 1.430;                   ///< of the upper edge [E]
  double width = 1.400;                                      ///< m [E]
  double sagitta = 0;                                        ///< bulge of the middle outwards, m
  double panel_thickness = 0.7e-3;                           ///< m [E], see docs/validation.md
  double glass_thickness = 2.1e-3, pvb_thickness = 0.76e-3;  ///< m per ply, of the interlayer
  UnitSystem units = UnitSystem::MmTonneS;
};

ModelDraft build_windshield(const WindshieldSpec& spec);
/// Height of the pane along its slope, m.
double pane_height(const WindshieldSpec& spec);
/// Frame P of the pane in B: origin in the middle of the lower edge, x up along the pane, y across,
/// z outwards.
Pose pane_frame(const WindshieldSpec& spec);

/// The deck alone; numbers start at a million (sections and sets at 8001), clear of the generated
/// head's.
Deck generate_windshield(const WindshieldSpec& spec);

/// Titles in the joined deck.
inline constexpr const char* kWindshieldFrame = "block_buck";
inline constexpr const char* kWindshieldParts = "windshield_all";
inline constexpr const char* kWindshieldContact = "head and windshield";

/// Adds the windshield to a deck with a head, renumbered clear of it, and a surface contact of the
/// two. Its nodes come last, in frame B. `head_surface`: title of the head's part set.
void join_windshield(Deck& deck, const WindshieldSpec& spec, const std::string& head_surface,
                     double friction);

}  // namespace crosswalk::fe::generate
