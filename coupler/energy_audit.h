// The energy and momentum books of the interface, kept in every run.
//
// work_mb + work_fe must vanish: what the multibody side gets through the interface, the
// finite-element side gives. Its sum is the drift, the coupling's own energy error. balance_error
// compares what both sides hold and have lost with what car, gravity and loads have put in.
#pragma once

#include <optional>
#include <string>

#include "coupler/scheme.h"
#include "crosswalk/msg/coupling_audit.hpp"

namespace crosswalk::coupling {

struct AuditLimits {
  double drift_warn = 0.005;  ///< of the peak total energy
  double drift_stop = 0.02;
  double gap_warn_m = 1e-4;
  double gap_warn_rad = 1.745e-3;  ///< 0.1 degree
};

class EnergyAudit {
 public:
  explicit EnergyAudit(AuditLimits limits) : limits_(limits) {}

  /// Books a window. Throws NumericalError when the drift passes its stop limit.
  void book(const WindowResult& result, const CouplingState& after);
  /// A warning that became due by the last window, each kind once.
  std::optional<std::string> new_warning();
  msg::coupling_audit message() const;
  /// The finite-element side's and the multibody side's total balance error, per cent of the peak
  /// energy.
  double balance_percent() const;
  double drift() const { return work_mb_ + work_fe_; }
  double peak_energy() const { return peak_; }

 private:
  void book_interface(const WindowResult& result, const CouplingState& after);

  AuditLimits limits_;
  WindowResult last_;
  bool has_start_ = false;
  double work_mb_ = 0, work_fe_ = 0, exchanged_ = 0;
  double total_ = 0, external_ = 0, start_ = 0, peak_ = 0;
  float gap_position_[8] = {}, gap_rotation_[8] = {}, velocity_mismatch_[8] = {};
  double gap_m_ = 0, gap_rad_ = 0;
  bool warned_drift_ = false, warned_gap_ = false;
};

}  // namespace crosswalk::coupling
