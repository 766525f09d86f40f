#include "recorder/path_gap.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace crosswalk::recording {
namespace {

/// Value at a time, linear between samples; nothing outside.
std::optional<double> value_at(const Channel& channel, double t) {
  constexpr double kRoundOff = 1e-6;
  const double place = (t - channel.t0) / channel.dt;
  const double last = static_cast<double>(channel.samples.size()) - 1;
  if (!(place >= -kRoundOff) || place > last + kRoundOff) return std::nullopt;
  const auto i = static_cast<std::size_t>(std::clamp(place, 0.0, last - 1));
  const double share = place - static_cast<double>(i);
  return (1 - share) * channel.samples[i] + share * channel.samples[i + 1];
}

}  // namespace

std::optional<PathGap> path_gap(const Analysis& a, const Analysis& b, PathSpan span) {
  std::vector<std::pair<const Channel*, const Channel*>> axes;
  for (const char* name : {"head_cog_x", "head_cog_y", "head_cog_z"}) {
    axes.emplace_back(a.channels.find(name), b.channels.find(name));
    const auto& [x, y] = axes.back();
    if (x == nullptr || y == nullptr || x->samples.size() < 2 || y->samples.size() < 2)
      return std::nullopt;
  }
  const auto end_of = [span](const Analysis& run, const Channel& channel) {
    const double last = channel.time(channel.samples.size() - 1);
    const bool ends_early = span == PathSpan::BeforeHeadContact && run.summary.head_contact;
    return ends_early ? std::min(last, run.summary.head_contact->time) : last;
  };
  PathGap gap;
  gap.until = std::min(end_of(a, *axes[0].first), end_of(b, *axes[0].second));
  for (std::size_t i = 0; i < axes[0].first->samples.size(); ++i) {
    const double t = axes[0].first->time(i);
    if (t < 0 || t > gap.until) continue;
    double squared = 0;
    for (const auto& [x, y] : axes) {
      const std::optional<double> other = value_at(*y, t);
      if (!other) return std::nullopt;
      squared += std::pow(*other - x->samples[i], 2);
    }
    if (!(std::sqrt(squared) > gap.largest_mm)) continue;  // a gap in the record is no distance
    gap.largest_mm = std::sqrt(squared);
    gap.time = t;
  }
  return gap;
}

}  // namespace crosswalk::recording
