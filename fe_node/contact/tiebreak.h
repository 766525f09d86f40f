// Ties that break: (f_n / limit_n)^a + (f_s / limit_s)^b >= 1, f_n the pull along the facet's
// normal (pressing never breaks), f_s the shear, as forces of a node or as stresses over its share
// of its surface [lstc2014, *CONTACT_TIEBREAK]. What the spring held when it breaks is dissipated.
#pragma once

#include <vector>

#include "fe_node/contact/contact.h"
#include "fe_node/contact/tie.h"

namespace crosswalk::fe {

struct TiebreakLimits {
  double normal = 0, shear = 0;  ///< Pa or N; 0: never breaks that way
  double normal_exponent = 2, shear_exponent = 2;
  bool is_stress = true;
  double tolerance = 0;  ///< m; which nodes are tied at the start, see tie_tolerance()

  /// `area` in m2, of stresses only.
  bool are_reached(const TieLoad& load, double area) const;
};

/// The ties of the nodes of one surface to the facets of another. What changes is kept by the
/// caller, kSlots doubles a node.
class BreakingTies {
 public:
  enum Slot { kTied = 0, kFacet, kSector, kWeight, kOffset = kWeight + 4, kArea, kSlots };

  /// `nodes` and `facets` make up the first surface.
  BreakingTies(const TiebreakLimits& limits, double nominal_step, std::vector<ContactNode> nodes,
               std::vector<ContactFacet> facets);

  const TiebreakLimits& limits() const { return limits_; }
  /// Ties the near nodes of `pass`, the first surface against the second, that are near enough.
  /// `slots` are those of the first node, `stride` doubles apart.
  void tie(const ContactPass& pass, const CandidateList& list, std::span<const NodeRecord> places,
           double* slots, int stride) const;

  struct Answer {
    bool holds = false;
    int facet = -1;
    PairForces forces;
    double stored = 0, omega2 = 0;
    double lost = 0;  ///< J, when it has broken in this step
  };
  /// The force of a tied node, or the end of its tie.
  Answer hold(const ContactPass& pass, int node, const ContactContext& context,
              double* slots) const;
  /// Whether any node of that facet of the first surface is tied.
  bool hold_facet(int facet, const double* slots, int stride) const;

 private:
  void share_area(std::span<const NodeRecord> places, double* slots, int stride) const;

  TiebreakLimits limits_;
  double step_;
  std::vector<ContactNode> nodes_;
  std::vector<ContactFacet> facets_;
  std::vector<std::array<int, 4>> entries_;  ///< of nodes_, per facet
};

}  // namespace crosswalk::fe
