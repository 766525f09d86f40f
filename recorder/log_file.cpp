#include "recorder/log_file.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <unistd.h>

#include "common/error.h"

namespace crosswalk::recording {

namespace {

constexpr std::uint32_t kSync = 0xEDA1DA01U;
constexpr std::size_t kHeaderBytes = 28;
constexpr std::uint32_t kMaxChannelBytes = 4096;      // LCM's own limit is 63
constexpr std::uint32_t kMaxDataBytes = 256U << 20U;  // beyond this a length is damage
constexpr std::size_t kBufferBytes = 1U << 20U;

void put(std::byte* at, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) at[i] = static_cast<std::byte>(value >> (8 * (bytes - 1 - i)));
}

std::uint64_t take(const std::byte* at, int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value = (value << 8U) | static_cast<std::uint64_t>(at[i]);
  return value;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& expected,
                       const std::string& found) {
  Problem problem;
  problem.place.file = path.string();
  problem.what = "message log";
  problem.expected = expected;
  problem.found = found;
  throw UserError(problem);
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Reads the event whose sync word starts at the file position; false when none is whole there.
bool read_event(std::FILE* file, LogEvent& event) {
  std::array<std::byte, kHeaderBytes> header{};
  if (std::fread(header.data(), 1, header.size(), file) != header.size()) return false;
  if (take(header.data(), 4) != kSync) return false;
  const auto channel_bytes = static_cast<std::uint32_t>(take(header.data() + 20, 4));
  const auto data_bytes = static_cast<std::uint32_t>(take(header.data() + 24, 4));
  if (channel_bytes > kMaxChannelBytes || data_bytes > kMaxDataBytes) return false;
  event.number = static_cast<std::int64_t>(take(header.data() + 4, 8));
  event.time_us = static_cast<std::int64_t>(take(header.data() + 12, 8));
  event.channel.resize(channel_bytes);
  event.data.resize(data_bytes);
  return std::fread(event.channel.data(), 1, channel_bytes, file) == channel_bytes &&
         std::fread(event.data.data(), 1, data_bytes, file) == data_bytes;
}

/// Moves to the next sync word at or after `from`; false at the end of the file.
bool seek_sync(std::FILE* file, long from) {
  if (std::fseek(file, from, SEEK_SET) != 0) return false;
  std::uint32_t last = 0;
  long at = from;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) {
    ++at;
    last = (last << 8U) | static_cast<std::uint32_t>(c);
    if (at - from >= 4 && last == kSync) return std::fseek(file, at - 4, SEEK_SET) == 0;
  }
  return false;
}

}  // namespace

LogWriter::LogWriter(const std::filesystem::path& path, const LogExtent& kept)
    : path_(path), next_(kept.events), bytes_(kept.bytes) {
  if (kept.bytes > 0) {
    std::error_code error;
    std::filesystem::resize_file(path, static_cast<std::uintmax_t>(kept.bytes), error);
    if (error) fail(path, "a file that can be cut", error.message());
  }
  file_.reset(std::fopen(path.c_str(), kept.bytes > 0 ? "ab" : "wb"));
  if (!file_) fail(path, "a file that can be written", std::strerror(errno));
  std::setvbuf(file_.get(), nullptr, _IOFBF, kBufferBytes);
}

void LogWriter::write(std::int64_t time_us, const std::string& channel,
                      std::span<const std::byte> data) {
  std::array<std::byte, kHeaderBytes> header{};
  put(header.data(), kSync, 4);
  put(header.data() + 4, static_cast<std::uint64_t>(next_), 8);
  put(header.data() + 12, static_cast<std::uint64_t>(time_us), 8);
  put(header.data() + 20, channel.size(), 4);
  put(header.data() + 24, data.size(), 4);
  const bool is_whole =
      std::fwrite(header.data(), 1, header.size(), file_.get()) == header.size() &&
      std::fwrite(channel.data(), 1, channel.size(), file_.get()) == channel.size() &&
      std::fwrite(data.data(), 1, data.size(), file_.get()) == data.size();
  if (!is_whole) fail(path_, "room on the disk", std::strerror(errno));
  ++next_;
  bytes_ += static_cast<std::int64_t>(kHeaderBytes + channel.size() + data.size());
}

void LogWriter::flush() {
  if (std::fflush(file_.get()) != 0) fail(path_, "room on the disk", std::strerror(errno));
}

void LogFollower::poll(const std::function<void(const LogEvent&)>& handler) {
  const File file(std::fopen(path_.c_str(), "rb"), &std::fclose);
  LogEvent event;
  // From the next sync word on: a resumed run cuts its log back and writes on.
  if (!file || !seek_sync(file.get(), at_)) return;
  while (read_event(file.get(), event)) {
    handler(event);
    at_ = std::ftell(file.get());
  }
}

void LogWriter::sync() {
  flush();
  if (fsync(fileno(file_.get())) != 0) fail(path_, "room on the disk", std::strerror(errno));
}

bool is_event_log(const std::filesystem::path& path) {
  const File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  std::array<std::byte, 4> begin{};
  return file != nullptr && std::fread(begin.data(), 1, begin.size(), file.get()) == begin.size() &&
         take(begin.data(), 4) == kSync;
}

LogExtent read_log(const std::filesystem::path& path,
                   const std::function<void(const LogEvent&)>& handler) {
  const File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file || std::filesystem::is_directory(path)) fail(path, "a readable LCM event log", "none");
  LogExtent extent;
  LogEvent event;
  long at = 0;
  while (seek_sync(file.get(), at)) {
    const long start = std::ftell(file.get());
    if (read_event(file.get(), event)) {
      handler(event);
      ++extent.events;
      at = std::ftell(file.get());
      extent.bytes += at - start;
    } else {
      at = start + 4;
    }
  }
  extent.cut_bytes = static_cast<std::int64_t>(std::filesystem::file_size(path)) - extent.bytes;
  return extent;
}

}  // namespace crosswalk::recording
