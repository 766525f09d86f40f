// The hub of a coupled run: windows in lockstep, from the first to the end of the wanted duration.
#pragma once

#include <functional>

#include "common/record_stream.h"
#include "coupler/energy_audit.h"
#include "coupler/scheme.h"

namespace crosswalk::coupling {

struct CouplerSettings {
  SchemeSettings scheme;
  AuditLimits limits;
  std::int64_t window_ns = 20000;
  std::int64_t duration_ns = 200'000'000;       ///< after the first contact of car and pedestrian
  std::int64_t first_contact_ns = 150'000'000;  ///< it must come before
  bool has_fe = true;
};

/// How a run stands, after each window.
struct Progress {
  std::int64_t window = 0;
  std::int64_t t_ns = 0;
  std::int64_t end_ns = 0;  ///< an estimate before the first contact
  double balance_percent = 0;
  bool head_contact = false;
};

/// What the loop needs from its surroundings; a test fills in less.
struct CouplerHooks {
  std::function<void(std::int64_t window)> before_window = [](std::int64_t) {};
  /// After a window is done and booked, with the number of the next.
  std::function<void(std::int64_t next)> after_window = [](std::int64_t) {};
  std::function<void(const Progress&)> progress = [](const Progress&) {};
  std::function<void(EventLevel, const std::string&)> tell = [](EventLevel, const std::string&) {};
  std::function<int()> resends = [] { return 0; };
};

class Coupler {
 public:
  Coupler(CouplerSettings settings, MbLink& mb, FeLink* fe, RecordStream* records,
          CouplerHooks hooks);

  /// Runs to the end, from the bodies' start or from where load() has put it. Returns the number of
  /// windows done.
  std::int64_t run(const std::vector<InterfaceBody>& bodies);
  void save(ByteWriter& out) const;
  void load(ByteReader& in);
  /// One window; false when the run's duration is over.
  bool advance();

  const CouplingState& state() const { return state_; }
  const EnergyAudit& audit() const { return audit_; }

 private:
  void publish_audit(double wall_s);
  void note_events(const WindowResult& result);
  std::int64_t end_ns() const;

  CouplerSettings settings_;
  MbLink& mb_;
  FeLink* fe_;
  RecordStream* records_;
  CouplerHooks hooks_;
  CouplingState state_;
  EnergyAudit audit_;
  struct Seen {
    std::int64_t contact_ns = -1;  ///< end of the window of first contact
    bool head_contact = false;
    int not_converged = 0, in_parts = 0;
  } seen_;
};

}  // namespace crosswalk::coupling
