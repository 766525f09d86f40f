// One body ellipsoid on the car's front: how deep each part of the front is pressed in, and where
// the energy goes when the ellipsoid passes from one part to the next.
//
// The front is one surface cut into panels: facets of one chain and one component. Within a panel
// the overlap d is continuous and its rate is the approach along the normal, so a force that
// depends on d does work F d'. At a joint of two panels an overlap is there at once that no motion
// has pressed in. Let x = d - unpressed be the depth pressed in; the force belongs to x:
// - what the ellipsoid left behind in the panel it came from, its stored energy U, is handed to the
//   panel it came to: pressed in as deep as the overlap, but no deeper than U can hold;
// - the rest of U is lost; x grows from there with the motion along the normal alone.
// So a passage never adds energy. A panel that was pressed in before keeps its dent (`deepest`).
#pragma once

#include <span>
#include <vector>

#include "common/vehicle_front.h"
#include "mb_node/contact_law.h"
#include "mb_node/surface_contact.h"

namespace crosswalk::mb {

/// Panels numbered along the profile.
struct FrontPanels {
  std::vector<int> of_facet;   ///< by facet
  std::vector<int> component;  ///< by panel
  int count() const { return static_cast<int>(component.size()); }
};
FrontPanels front_panels(const VehicleFront& front, const std::vector<FrontChain>& chains);

/// History of one ellipsoid on one panel.
struct PanelContact {
  double deepest = 0;    ///< m, largest depth pressed in: the dent
  double pressed = 0;    ///< m, pressed in now
  double unpressed = 0;  ///< m of the overlap that no motion has pressed in
  bool is_touching = false;
};

/// An overlap of the ellipsoid with a panel in this substep.
struct PanelTouch {
  int panel = -1;
  double depth = 0;     ///< m, overlap
  double approach = 0;  ///< m/s along the normal, towards each other
};

struct FrontLosses {
  double hysteresis = 0;  ///< J, by dents that grew
  double left = 0;        ///< J, stored where the ellipsoid left and held by no other panel
};

/// Brings the histories of one ellipsoid (by panel) up to its touches (at most one per panel).
/// `laws` by panel; dt is the substep that led here.
FrontLosses press_in(std::span<const PanelTouch> touches, std::span<const ContactLaw* const> laws,
                     double dt, std::span<PanelContact> contacts);

}  // namespace crosswalk::mb
