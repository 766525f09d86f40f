// Everything the messages of one run say, once each and in order of simulated time.
//
// Fed with raw events in any order: re-sends, doubles and reordering change nothing, so a live run,
// its replay by lcm-logplayer and a log from lcm-logger alone give the same record. The run is that
// of the first manifest in the log; messages of other runs are counted and left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/exchange.h"
#include "common/protocol.h"

namespace crosswalk::recording {

struct Manifest {
  std::int64_t scenario_digest = 0;
  std::int64_t window_ns = 0;
  std::int64_t duration_ns = 0;  ///< from first contact of car and pedestrian
  int scheme = 0;
  bool has_fe = false;
  int n_attached = 0;
  std::vector<std::string> bodies;  ///< interface bodies
  std::string run_id, scenario;

  /// True for a head without body: its only partner is the head of another run.
  bool has_head_alone() const { return has_fe && !bodies.empty() && bodies.front() == "head"; }
  /// coupled, multibody, prescribed or impact_only (common/scenario.h).
  std::string mode() const;
  /// mic, implicit or staggered.
  std::string scheme_name() const;
};

struct MbWindow {
  std::int64_t t_ns = 0;
  std::int64_t seq = -1;
  int substeps = 0, work_us = 0, contacts = 0;
  MbEnergies energy;
  std::vector<BodyMotion> bodies;
};

struct FeWindow {
  std::int64_t t_ns = 0;
  std::int64_t seq = -1;
  int substeps = 0, work_us = 0;
  double stable_step = 0;                                                     ///< s
  double kinetic = 0, internal = 0, hourglass = 0, contact = 0, damping = 0;  ///< J
  double external_work = 0, interface_work = 0;                               ///< J
  double added_mass = 0;                                                      ///< kg
  double head_contact_force = 0;                                              ///< N
};

struct AuditWindow {
  std::int64_t t_ns = 0;
  int iterations = 0, resends = 0, wall_us = 0;
  double residual = 0;
  double work_mb = 0, work_fe = 0, exchanged = 0, drift = 0;      ///< J
  double total_energy = 0, external_work = 0, balance_error = 0;  ///< J
  // largest over the bodies
  double gap_position = 0, gap_rotation = 0, velocity_mismatch = 0;  ///< m, rad, m/s
  double owed_force = 0, owed_moment = 0;                            ///< N, N m
};

struct Event {
  Role sender{};
  std::int64_t seq = 0;
  std::int64_t t_ns = 0;
  EventLevel level{};
  int code = 0;
  std::string text;
};

/// A stream of numbered messages: which numbers have come.
class Numbers {
 public:
  /// False when the number has come before.
  bool add(std::int64_t seq);
  /// Numbers 0 .. complete() - 1 have all come.
  std::int64_t complete() const { return complete_; }
  /// Missing numbers below `end`, as at most `most` closed ranges.
  std::vector<std::pair<std::int64_t, std::int64_t>> missing(std::int64_t end,
                                                             std::size_t most) const;

 private:
  std::int64_t complete_ = 0;
  std::map<std::int64_t, bool> ahead_;
};

struct RunRecord {
  std::optional<Manifest> manifest;
  std::map<Role, std::string> description;            ///< JSON text per node, complete ones
  std::map<std::int64_t, HeadSample> head;            ///< by t_ns
  std::map<std::int64_t, std::vector<Pose>> bodies;   ///< by t_ns, complete instants
  std::map<std::int64_t, std::vector<Vec3>> contact;  ///< by t_ns, N, on the pedestrian, W
  std::map<std::int64_t, TissueSample> tissue;        ///< by t_ns
  std::map<std::int64_t, MbWindow> mb;                ///< by window
  std::map<std::int64_t, FeWindow> fe;                ///< by window
  std::map<std::int64_t, AuditWindow> audit;          ///< by window
  std::vector<Event> events;                          ///< by sender and number
  std::optional<std::string> abort_reason;
  bool is_finished = false;                ///< the coupler said Finish or Stop
  std::int64_t first_us = 0, last_us = 0;  ///< arrival times, not repeatable
  std::int64_t messages = 0, doubled = 0, foreign = 0, unreadable = 0;
  std::int64_t lost = 0;  ///< numbered messages that never came
};

class RecordBuilder {
 public:
  RecordBuilder();
  ~RecordBuilder();
  RecordBuilder(RecordBuilder&&) noexcept;
  RecordBuilder& operator=(RecordBuilder&&) noexcept;

  /// One message as it came; anything that is not ours is counted and left out.
  void add(std::span<const std::byte> data, std::int64_t arrival_us);
  /// What has come until now.
  RunRecord record() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads a log file; throws UserError when it cannot be read or holds no Crosswalk run.
RunRecord read_run_record(const std::filesystem::path& log);

}  // namespace crosswalk::recording
