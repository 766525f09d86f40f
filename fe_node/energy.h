// The energy books of a finite-element run, J. Work counts are since the start.
#pragma once

namespace crosswalk::fe {

struct Energies {
  double kinetic = 0;         ///< nodes and free rigid bodies; not the driven blocks
  double internal = 0;        ///< work done on the material, stored or dissipated in it
  double hourglass = 0;       ///< stored by stiffness control plus dissipated by viscous control
  double bulk_viscosity = 0;  ///< dissipated
  double damping = 0;         ///< dissipated by mass damping
  double contact_stored = 0;  ///< in penalty springs, now
  double contact_dissipated = 0;  ///< friction and contact damping
  double external_work = 0;       ///< gravity, nodal loads, prescribed motion
  double interface_work = 0;      ///< done on this model by driven bodies and followers
  double initial = 0;             ///< kinetic and internal energy at the start

  double total() const {
    return kinetic + internal + hourglass + bulk_viscosity + damping + contact_stored +
           contact_dissipated;
  }
  double supplied() const { return initial + external_work + interface_work; }
  /// Energy that came from nowhere (> 0) or got lost (< 0), as a share of the largest book entry.
  double balance_error() const;
};

}  // namespace crosswalk::fe
