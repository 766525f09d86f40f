// Window arithmetic in integer nanoseconds: window k covers [k, k+1] * window_ns, exactly.
#pragma once

#include <cstdint>

namespace crosswalk {

class Schedule {
 public:
  explicit Schedule(std::int64_t window_ns) : window_ns_(window_ns) {}
  std::int64_t window_ns() const { return window_ns_; }
  double window_s() const { return 1e-9 * static_cast<double>(window_ns_); }
  std::int64_t begin_ns(std::int64_t window) const { return window * window_ns_; }
  std::int64_t end_ns(std::int64_t window) const { return (window + 1) * window_ns_; }
  double begin_s(std::int64_t window) const { return 1e-9 * static_cast<double>(begin_ns(window)); }
  /// Windows needed to reach at least `t_ns`.
  std::int64_t windows_until(std::int64_t t_ns) const {
    return (t_ns + window_ns_ - 1) / window_ns_;
  }

 private:
  std::int64_t window_ns_;
};

/// Equal substeps of at most `stable_step_s` that land on the window edge; at least one.
int substep_count(double window_s, double stable_step_s);

}  // namespace crosswalk
