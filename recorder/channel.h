// Signals as the ratings and metrics see them (Series: any strictly increasing time) and as the
// recorder keeps them (Channel: uniform time, name and unit), with the one error type of signal
// work.
//
// Inside, everything is SI; a channel's unit is what its samples are in, its name carries it at
// file edges (`head_cog_y_mm`).
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace crosswalk::recording {

enum class SignalFault { TooShort, TimeOrder, NotFinite, NoOverlap, BadParameter, Shape };

/// "too_short", "time_order", "not_finite", "no_overlap", "bad_parameter", "shape".
std::string_view fault_code(SignalFault fault);

/// Input that no metric may be computed from. Nothing is ever skipped or repaired silently.
class SignalError : public std::runtime_error {
 public:
  SignalError(SignalFault fault, const std::string& message);
  SignalFault fault() const { return fault_; }
  std::string_view code() const { return fault_code(fault_); }

 private:
  SignalFault fault_;
};

/// A sampled signal y(t) with time in s; sampling may be irregular.
struct Series {
  std::vector<double> t;
  std::vector<double> y;
  std::size_t size() const { return t.size(); }
};

/// Throws SignalError unless time strictly increases, everything is finite and there are at least
/// `min_samples`. `name` stands in the message.
void require_valid(std::span<const double> t, std::span<const double> y, std::string_view name,
                   std::size_t min_samples = 2);
void require_valid(const Series& series, std::string_view name, std::size_t min_samples = 2);

/// A recorded signal: sample i is at t0 + i * dt.
struct Channel {
  std::string name;         ///< stem without unit, e.g. `head_cog_y`
  std::string unit;         ///< `m`, `m/s`, `m/s2`, `rad/s`, `rad/s2`, `N`, `J`, `kg`, `1`
  std::string description;  ///< one line: what, which frame, which filter
  double t0 = 0;            ///< s
  double dt = 0;            ///< s
  std::vector<double> samples;
  double time(std::size_t i) const { return t0 + static_cast<double>(i) * dt; }
  Series series() const;
  /// From the first sample that is there to the last; one missing in between stays NaN, so that
  /// every metric refuses it.
  Series present() const;
};

}  // namespace crosswalk::recording
