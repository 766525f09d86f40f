// The log of a process: `[sim ms] [node] level message` on the console (stderr) and in a file.
//
// error: the run ends. warn: the result is suspect. info: start, end and a line per 10 ms
// simulated. debug: per window. trace: per step. Never inside element loops. Before open_log()
// messages go to the console only. Any thread may log.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace crosswalk {

enum class LogLevel { Trace, Debug, Info, Warning, Error };

/// Opens the log of this process. `file` may be empty, and is left alone when the console already
/// goes there (the launcher redirects it).
void open_log(std::string_view node, const std::filesystem::path& file,
              LogLevel level = LogLevel::Info);
/// Writes everything out; call before leaving.
void flush_log();
/// The time stamp of what follows.
void set_log_time(double simulated_s);
void log_text(LogLevel level, std::string_view text);
/// True the first time it is called with this key; for warnings that would repeat every step.
bool first_time(std::string_view key);

template <class... Args>
void log_debug(fmt::format_string<Args...> text, Args&&... args) {
  log_text(LogLevel::Debug, fmt::format(text, std::forward<Args>(args)...));
}
template <class... Args>
void log_info(fmt::format_string<Args...> text, Args&&... args) {
  log_text(LogLevel::Info, fmt::format(text, std::forward<Args>(args)...));
}
template <class... Args>
void log_warning(fmt::format_string<Args...> text, Args&&... args) {
  log_text(LogLevel::Warning, fmt::format(text, std::forward<Args>(args)...));
}
template <class... Args>
void log_error(fmt::format_string<Args...> text, Args&&... args) {
  log_text(LogLevel::Error, fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace crosswalk
