#include "launcher/progress.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace crosswalk {

namespace {
constexpr double kPlainLineMs = 10;  // simulated time between lines on a pipe
}

std::optional<Progress> parse_progress(std::string_view line) {
  if (!line.starts_with("@progress ")) return std::nullopt;
  std::istringstream in{std::string(line.substr(10))};
  Progress progress;
  int contact = 0;
  if (!(in >> progress.t_ms >> progress.t_end_ms >> progress.energy_balance_percent >> contact))
    return std::nullopt;
  progress.has_head_contact = contact != 0;
  return progress;
}

std::optional<CouplerEvent> parse_event(std::string_view line) {
  if (!line.starts_with("@event ")) return std::nullopt;
  line.remove_prefix(7);
  const std::size_t blank = std::min(line.find(' '), line.size());
  const std::string_view text = line.substr(std::min(blank + 1, line.size()));
  return CouplerEvent{std::string(line.substr(0, blank)), std::string(text)};
}

std::string clock_text(double seconds) {
  const auto total = static_cast<long>(std::lround(std::max(seconds, 0.0)));
  const long hours = total / 3600, minutes = total / 60 % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, total % 60);
  return fmt::format("{}:{:02}", minutes, total % 60);
}

std::string progress_text(const Progress& p, double elapsed_s, std::optional<double> left_s) {
  const double part = p.t_end_ms > 0 ? std::clamp(p.t_ms / p.t_end_ms, 0.0, 1.0) : 0.0;
  std::string text = fmt::format("{:7.2f} ms of {:.0f} ms  {:3.0f} %  {} elapsed", p.t_ms,
                                 p.t_end_ms, std::floor(100 * part), clock_text(elapsed_s));
  if (left_s) text += fmt::format("  {} left", clock_text(*left_s));
  text += fmt::format("  energy {:+.2f} %", p.energy_balance_percent);
  if (p.has_head_contact) text += "  head contact";
  return text;
}

ProgressDisplay::ProgressDisplay(std::FILE* out, Style style) : out_(out), style_(style) {}

std::optional<double> ProgressDisplay::seconds_left(const Progress& progress) const {
  if (!first_progress_ || progress.t_ms <= first_t_ms_) return std::nullopt;
  const double spent = std::chrono::duration<double>(Clock::now() - *first_progress_).count();
  return spent * (progress.t_end_ms - progress.t_ms) / (progress.t_ms - first_t_ms_);
}

void ProgressDisplay::show(const Progress& progress) {
  if (!first_progress_) {
    first_progress_ = Clock::now();
    first_t_ms_ = progress.t_ms;
  }
  last_ = progress;
  const double elapsed = std::chrono::duration<double>(Clock::now() - started_).count();
  const std::string text = progress_text(progress, elapsed, seconds_left(progress));
  if (style_ == Style::Live) {
    fmt::print(out_, "\r\033[K{}", text);
    has_live_line_ = true;
  } else if (progress.t_ms >= next_plain_ms_) {
    fmt::print(out_, "{}\n", text);
    next_plain_ms_ = (std::floor(progress.t_ms / kPlainLineMs) + 1) * kPlainLineMs;
  }
  std::fflush(out_);
}

void ProgressDisplay::say(std::string_view text) {
  fmt::print(out_, "{}{}\n", has_live_line_ ? "\r\033[K" : "", text);
  has_live_line_ = false;
  if (style_ == Style::Live && last_) show(*last_);
  std::fflush(out_);
}

void ProgressDisplay::finish() {
  if (has_live_line_) fmt::print(out_, "\n");
  has_live_line_ = false;
  std::fflush(out_);
}

}  // namespace crosswalk
