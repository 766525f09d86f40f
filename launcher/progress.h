// What the coupler tells on its standard output, and how a user sees it.
//
//   @progress <t_ms> <t_end_ms> <energy_balance_percent> <head_contact 0|1>     at most 10 per
//   second
//   @event <info|warning|error> <text>
// On a terminal one line is kept up to date; elsewhere there is a plain line per 10 ms simulated.
#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace crosswalk {

struct Progress {
  double t_ms = 0;
  double t_end_ms = 0;
  double energy_balance_percent = 0;
  bool has_head_contact = false;
};

std::optional<Progress> parse_progress(std::string_view line);

struct CouplerEvent {
  std::string level;
  std::string text;
};
std::optional<CouplerEvent> parse_event(std::string_view line);

/// "1:05" or "2:03:07".
std::string clock_text(double seconds);
/// " 56.20 ms of 200 ms  28 %  0:41 elapsed  1:45 left  energy +0.31 %  head contact"
std::string progress_text(const Progress& progress, double elapsed_s, std::optional<double> left_s);

class ProgressDisplay {
 public:
  enum class Style { Live, Plain };
  ProgressDisplay(std::FILE* out, Style style);

  void show(const Progress& progress);
  /// A line that stays, above the live one.
  void say(std::string_view text);
  /// Leaves the live line standing.
  void finish();
  const std::optional<Progress>& last() const { return last_; }

 private:
  std::optional<double> seconds_left(const Progress& progress) const;

  using Clock = std::chrono::steady_clock;
  std::FILE* out_;
  Style style_;
  Clock::time_point started_ = Clock::now();
  std::optional<Clock::time_point> first_progress_;
  double first_t_ms_ = 0;
  double next_plain_ms_ = 0;
  bool has_live_line_ = false;
  std::optional<Progress> last_;
};

}  // namespace crosswalk
