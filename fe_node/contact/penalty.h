// Penalty contact between meshed surfaces: nodes against facets, one way, both ways or a surface
// against itself. Friction by Coulomb with an elastic stick, soft-constraint stiffness, damping.
//
// A node touches at most one facet, the nearest. Its force and the facet's nodal forces are in
// balance exactly: the normal force runs along the line from the closest point to the node, and
// friction, which acts across the distance of the two thicknesses, comes with the couple that the
// facet's nodes must carry (forces u (d grad N_i . f_t) along the normal u). Slip is measured
// against the facet's material carried out to the node, so a rigid rotation slips nothing.
//
// Stiffness k = s min(k_node, k_facet), or at least 1/2 s_soft m*/dt^2 (soft constraint)
// [hallquist2006, 26.6-26.7], and at most m*/(4 dt^2): elements stepped at 0.9 of their limit leave
// 4 - 3.24 = 0.76 of omega^2 dt^2 to contact, two opposed contacts take 2/4. m* = 1 / (1/m_node +
// largest 1/m of the facet's nodes); nodes that a constraint moves count as infinitely heavy, and
// by their shares of their bodies' masses where both sides are such.
//
// With a tiebreak (tiebreak.h) nodes begin tied; a tied node, and a facet with a tied node, take
// no part in contact until the tie has broken.
//
// Which pairs are looked at, and surfaces that erode: candidates.h.
#pragma once

#include <memory>
#include <optional>

#include "fe_node/contact/contact.h"
#include "fe_node/contact/surface.h"
#include "fe_node/contact/tiebreak.h"

namespace crosswalk::fe {

enum class InitialPenetration {
  Accepted,  ///< what overlaps at the start only pushes when it goes deeper
  PushedOut  ///< is pushed out by its full penetration
};

struct PenaltySettings {
  double static_friction = 0;
  double dynamic_friction = 0;
  double friction_decay = 0;     ///< s/m: mu = mu_d + (mu_s - mu_d) exp(-decay |slip rate|)
  double stiffness_scale = 0.1;  ///< s
  double soft_scale = 0;         ///< s_soft; 0: no soft constraint; 0.1 is usual
  double damping_ratio = 0;      ///< of critical, on the normal motion
  double nominal_step = 0;       ///< s; the solver's step that soft constraint and cap refer to
  double thickness_scale = 1;
  double search_margin = 0;  ///< m; 0: half the mean facet edge
  InitialPenetration initial = InitialPenetration::Accepted;
  double birth = 0, death = 1e300;  ///< s
  /// Nodes of the first surface that lie at the second when the run starts are tied to it until
  /// these limits; not of a single surface.
  std::optional<TiebreakLimits> tiebreak;
};

/// Nodes of `nodes` against facets of `facets`.
std::unique_ptr<ContactInterface> make_node_contact(std::string name, ContactSurface nodes,
                                                    ContactSurface facets,
                                                    const PenaltySettings& settings);
/// Both ways.
std::unique_ptr<ContactInterface> make_surface_contact(std::string name, ContactSurface first,
                                                       ContactSurface second,
                                                       const PenaltySettings& settings);
/// A surface against itself; a node never meets the facets next to its own.
std::unique_ptr<ContactInterface> make_single_surface_contact(std::string name,
                                                              ContactSurface surface,
                                                              const PenaltySettings& settings);

}  // namespace crosswalk::fe
