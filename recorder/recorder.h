// Writes every message of a run to its log and knows what is still missing.
//
// Fed with raw messages, free of any network. Records of one sender are numbered 0, 1, 2 ... across
// kinds; done messages are numbered by grant; the senders tell how many records there are
// (docs/messages.md). A window is acknowledged when its done messages, its audit and the records
// they count are all in the log.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/protocol.h"
#include "crosswalk/msg/header.hpp"
#include "recorder/log_file.h"
#include "recorder/run_record.h"

namespace crosswalk::recording {

/// Numbered messages to ask for again; kind 0 means the sender's records.
struct Gap {
  Role role{};
  int kind = 0;
  std::int64_t first = 0, last = 0;
};

class Recorder {
 public:
  /// `kept`: the part of an earlier log, up to a checkpoint, from which the run continues. Throws
  /// UserError when `log` holds messages that nobody asked to continue: a record is not
  /// overwritten.
  Recorder(const std::filesystem::path& log, std::int64_t run, const LogExtent& kept = {});

  /// Every message of the run's channels, as it came.
  void add(const std::string& channel, std::span<const std::byte> data, std::int64_t arrival_us);

  /// Windows 0 .. complete_window() have arrived whole; -1 at first.
  std::int64_t complete_window() const { return complete_window_; }
  /// What to ask for again, at most `most` ranges.
  std::vector<Gap> gaps(std::size_t most = 8) const;
  /// True once Finish has come, all nodes are done and nothing is missing.
  bool is_complete() const;
  bool has_finish() const { return last_window_ >= -1; }
  /// Hands the log to the operating system.
  void flush() { log_.flush(); }
  /// And to the disk, to outlive the machine.
  void sync() { log_.sync(); }
  LogExtent extent() const { return {log_.events(), log_.bytes(), 0}; }
  std::int64_t messages() const { return log_.events(); }
  std::int64_t bytes() const { return log_.bytes(); }

 private:
  struct Done {
    std::int64_t seq = -1, records = 0;
  };
  /// What is known of one sender.
  struct Sender {
    Numbers records, done;
    std::int64_t announced = 0;            ///< records it says it has published
    std::int64_t granted = 0;              ///< done numbers known to exist: largest seen plus one
    std::map<std::int64_t, Done> windows;  ///< not yet acknowledged
    bool is_done = false;
  };

  void book(const msg::header& h, std::span<const std::byte> data);
  void book_done(Role role, const msg::header& h, std::int64_t window, std::int64_t records);
  void advance();
  bool has_whole(const Sender& sender, std::int64_t window) const;
  std::vector<Role> solvers() const;

  LogWriter log_;
  std::int64_t run_;
  bool has_manifest_ = false, has_fe_ = false;
  std::map<Role, Sender> senders_;
  std::map<std::int64_t, bool> audited_;  ///< windows not yet acknowledged
  std::int64_t last_audit_ = -1;
  std::int64_t complete_window_ = -1;
  std::int64_t last_window_ = -2;  ///< told by Finish
};

}  // namespace crosswalk::recording
