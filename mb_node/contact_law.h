// Contact force against total penetration when two sides deform in series at equal force.
//
// Loading: the combined curve, tabulated once: d(F) = d_first(F) + d_second(F). Where one side
// softens (breaking glass) the force drops at constant penetration. Unloading from the deepest
// point (d_m, F_m), with f = F/F_m: each side returns by (1 - r) d_side,m f^(1/e) (permanent
// fraction r, exponent e), so d(f) = sum r d_side,m + sum (1 - r) d_side,m f^(1/e); reloading the
// same way. SI.
#pragma once

#include "common/contact_shapes.h"
#include "common/curve.h"

namespace crosswalk::mb {

class ContactLaw {
 public:
  /// One deformable side against a rigid one.
  explicit ContactLaw(const Characteristic& side);
  /// `first` must rise without end; `second` may soften.
  ContactLaw(const Characteristic& first, const Characteristic& second);

  /// Force at penetration d when the deepest so far (including d) is `deepest`.
  double force(double d, double deepest) const;
  /// Energy put in by loading to `deepest`, and what unloading from there to d = 0 gives back.
  double loading_energy(double deepest) const { return loading_.integral(deepest); }
  double recoverable_energy(double deepest) const;
  /// What unloading from d, after `deepest`, would give back.
  double stored_energy(double d, double deepest) const;
  /// Lost for good once unloaded from `deepest`: loading less recoverable energy.
  double lost_energy(double deepest) const {
    return loading_energy(deepest) - recoverable_energy(deepest);
  }
  /// Penetration below which the force is zero after `deepest`.
  double permanent(double deepest) const;
  /// Largest penetration up to `limit` that, after `deepest`, stores no more than `energy`.
  double penetration_holding(double energy, double deepest, double limit) const;

 private:
  struct Side {
    double permanent_fraction = 0;
    double exponent = 1;
    Curve depth;  ///< share of the total penetration
  };
  /// Share F / F_m of the deepest force on the unloading path, d above the permanent penetration.
  double force_share(double d, double deepest) const;

  Curve loading_;
  Side first_, second_;
};

}  // namespace crosswalk::mb
