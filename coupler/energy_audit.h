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
  double drift() const { return books_.work_mb + books_.work_fe; }
  double peak_energy() const { return books_.peak; }

  /// Everything the audit remembers; plain data for checkpoints.
  struct Books {
    std::int64_t window = -1, t_ns = 0;
    int iterations = 0;
    double residual = 0;
    bool has_start = false, warned_drift = false, warned_gap = false;
    double work_mb = 0, work_fe = 0, exchanged = 0;
    double total = 0, external = 0, start = 0, peak = 0;
    double largest_gap_m = 0, largest_gap_rad = 0;
    float gap_position[8] = {}, gap_rotation[8] = {}, velocity_mismatch[8] = {};
    float owed_force[8] = {}, owed_moment[8] = {};
  };
  const Books& books() const { return books_; }
  void continue_from(const Books& books) { books_ = books; }

 private:
  void book_interface(const WindowResult& result, const CouplingState& after);

  AuditLimits limits_;
  Books books_;
};

}  // namespace crosswalk::coupling
