// The energy books of a finite-element run, J. Kinetic and stored entries belong to the time of the
// last force evaluation; work and dissipation count since the start.
#pragma once

namespace crosswalk::fe {

struct Energies {
  double kinetic = 0;               ///< nodes and free rigid bodies; not the driven blocks
  double internal = 0;              ///< work done on the material, stored or dissipated in it
  double hourglass_stored = 0;      ///< by stiffness control, now
  double hourglass_dissipated = 0;  ///< by viscous control
  double viscous = 0;               ///< dissipated by bulk viscosity and element damping
  double damping = 0;               ///< dissipated by mass damping
  double contact_stored = 0;        ///< in penalty springs, now
  double contact_dissipated = 0;    ///< friction and contact damping
  double external_work = 0;         ///< gravity, nodal loads, prescribed motion
  double interface_work = 0;        ///< done on this model by driven bodies and followers
  double initial = 0;               ///< total() at the start

  double hourglass() const { return hourglass_stored + hourglass_dissipated; }
  double contact() const { return contact_stored + contact_dissipated; }
  double total() const { return kinetic + internal + hourglass() + viscous + damping + contact(); }
  double supplied() const { return initial + external_work + interface_work; }
  /// Energy that came from nowhere (> 0) or got lost (< 0), as a share of the largest entry.
  double balance_error() const;
};

}  // namespace crosswalk::fe
