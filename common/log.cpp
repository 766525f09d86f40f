#include "common/log.h"

#include <atomic>
#include <cstdio>
#include <memory>
#include <mutex>
#include <set>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

namespace crosswalk {

namespace {

std::atomic<double> log_time_s{0.0};
std::atomic<bool> is_open{false};

/// The pattern flag %*: simulated milliseconds.
class SimulatedTime final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg&, const std::tm&, spdlog::memory_buf_t& out) override {
    fmt::format_to(std::back_inserter(out), "{:9.3f}", 1e3 * log_time_s.load());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<SimulatedTime>();
  }
};

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::Trace:
      return spdlog::level::trace;
    case LogLevel::Debug:
      return spdlog::level::debug;
    case LogLevel::Info:
      return spdlog::level::info;
    case LogLevel::Warning:
      return spdlog::level::warn;
    case LogLevel::Error:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

bool is_console_file(const std::filesystem::path& file) {
  struct stat console {
  }, wanted{};
  return fstat(2, &console) == 0 && stat(file.c_str(), &wanted) == 0 &&
         console.st_dev == wanted.st_dev && console.st_ino == wanted.st_ino;
}

}  // namespace

void open_log(std::string_view node, const std::filesystem::path& file, LogLevel level) {
  std::vector<spdlog::sink_ptr> sinks = {std::make_shared<spdlog::sinks::stderr_color_sink_mt>()};
  if (!file.empty() && !is_console_file(file)) {
    std::filesystem::create_directories(file.parent_path());
    sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string()));
  }
  auto logger = std::make_shared<spdlog::logger>(std::string(node), sinks.begin(), sinks.end());
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<SimulatedTime>('*').set_pattern("[%*] [%n] %^%l%$ %v");
  logger->set_formatter(std::move(formatter));
  logger->set_level(level_of(level));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
  is_open = true;
}

void flush_log() { spdlog::default_logger_raw()->flush(); }

void set_log_time(double simulated_s) { log_time_s.store(simulated_s); }

void log_text(LogLevel level, std::string_view text) {
  if (!is_open) {
    if (level >= LogLevel::Info) fmt::print(stderr, "{}\n", text);
    return;
  }
  spdlog::default_logger_raw()->log(level_of(level),
                                    spdlog::string_view_t(text.data(), text.size()));
}

bool first_time(std::string_view key) {
  static std::mutex mutex;
  static std::set<std::string, std::less<>> seen;
  const std::lock_guard lock(mutex);
  return seen.emplace(key).second;
}

}  // namespace crosswalk
