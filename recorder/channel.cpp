#include "recorder/channel.h"

#include <cmath>

#include <fmt/format.h>

namespace crosswalk::recording {

std::string_view fault_code(SignalFault fault) {
  switch (fault) {
    case SignalFault::TooShort:
      return "too_short";
    case SignalFault::TimeOrder:
      return "time_order";
    case SignalFault::NotFinite:
      return "not_finite";
    case SignalFault::NoOverlap:
      return "no_overlap";
    case SignalFault::BadParameter:
      return "bad_parameter";
    case SignalFault::Shape:
      return "shape";
  }
  return "shape";
}

SignalError::SignalError(SignalFault fault, const std::string& message)
    : std::runtime_error(message), fault_(fault) {}

void require_valid(std::span<const double> t, std::span<const double> y, std::string_view name,
                   std::size_t min_samples) {
  if (t.size() != y.size()) {
    throw SignalError(SignalFault::Shape,
                      fmt::format("{}: {} times but {} values", name, t.size(), y.size()));
  }
  if (t.size() < min_samples) {
    throw SignalError(SignalFault::TooShort, fmt::format("{}: {} samples, at least {} needed", name,
                                                         t.size(), min_samples));
  }
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t[i]) || !std::isfinite(y[i])) {
      throw SignalError(SignalFault::NotFinite,
                        fmt::format("{}: sample {} (t = {} s) is {}", name, i, t[i], y[i]));
    }
  }
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i] <= t[i - 1]) {
      throw SignalError(SignalFault::TimeOrder,
                        fmt::format("{}: time does not increase at sample {} ({} s after {} s)",
                                    name, i, t[i], t[i - 1]));
    }
  }
}

void require_valid(const Series& series, std::string_view name, std::size_t min_samples) {
  require_valid(series.t, series.y, name, min_samples);
}

Series Channel::series() const {
  Series out;
  out.t.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) out.t.push_back(time(i));
  out.y = samples;
  return out;
}

Series Channel::present() const {
  std::size_t first = 0, end = samples.size();
  while (first < end && !std::isfinite(samples[first])) ++first;
  while (end > first && !std::isfinite(samples[end - 1])) --end;
  Series out;
  for (std::size_t i = first; i < end; ++i) {
    out.t.push_back(time(i));
    out.y.push_back(samples[i]);
  }
  return out;
}

}  // namespace crosswalk::recording
