// LCM event logs, the format of lcm-logger and lcm-logplayer, without the LCM library.
//
// An event is, all big-endian: sync 0xEDA1DA01 (u32), number (i64), arrival time in us since 1970
// (i64), channel length (u32), data length (u32), channel bytes, data. No file header. A reader
// stops at the last whole event, so a log cut by a crash is read as far as it goes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace crosswalk::recording {

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t time_us = 0;  ///< arrival, us since 1970
  std::string channel;
  std::vector<std::byte> data;
};

/// What a pass over a log found besides its events.
struct LogExtent {
  std::int64_t events = 0;
  std::int64_t bytes = 0;      ///< in whole events
  std::int64_t cut_bytes = 0;  ///< left over behind the last whole event
};

/// Appends events to a new file, or to the first `kept` of one that is there; the rest is cut off.
/// Throws UserError when the file cannot be made, and on a full disk.
class LogWriter {
 public:
  explicit LogWriter(const std::filesystem::path& path, const LogExtent& kept = {});
  void write(std::int64_t time_us, const std::string& channel, std::span<const std::byte> data);
  /// Hands everything written so far to the operating system.
  void flush();
  /// And to the disk, to outlive the machine.
  void sync();
  std::int64_t events() const { return next_; }
  std::int64_t bytes() const { return bytes_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::int64_t next_ = 0;
  std::int64_t bytes_ = 0;
};

/// Reads a log that another process is still writing.
class LogFollower {
 public:
  explicit LogFollower(std::filesystem::path path) : path_(std::move(path)) {}
  /// Calls `handler` for every whole event added since the last call; the file need not exist yet.
  void poll(const std::function<void(const LogEvent&)>& handler);

 private:
  std::filesystem::path path_;
  long at_ = 0;
};

/// Whether a file starts as an event log does; false for folders and what cannot be read.
bool is_event_log(const std::filesystem::path& path);

/// Calls `handler` for every whole event, in file order; damaged stretches are skipped to the next
/// sync word and counted as cut. Throws UserError when the file cannot be read.
LogExtent read_log(const std::filesystem::path& path,
                   const std::function<void(const LogEvent&)>& handler);

}  // namespace crosswalk::recording
