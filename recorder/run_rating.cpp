#include "recorder/run_rating.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "recorder/scoring/score_json.h"

namespace crosswalk::recording {

namespace {

const Channel* find(const std::vector<Channel>& channels, const std::string& name) {
  for (const Channel& channel : channels) {
    if (channel.name == name) return &channel;
  }
  return nullptr;
}

/// The name in a rating set: displacements relative to the buck count as displacements.
std::string set_name(std::string channel) {
  constexpr std::string_view kRelative = "head_cog_relative_";
  if (channel.starts_with(kRelative)) channel.replace(0, kRelative.size(), "head_cog_");
  return channel;
}

SignalRating rate_signal(const RatedSignal& signal, const std::string& reference_name,
                         const Series& reference, const std::string& reference_unit,
                         const std::vector<double>& sigma, const Channel& channel,
                         const RatingParameters& parameters) {
  SignalRating rating{signal, reference_name, {}, {}, {}};
  try {
    if (reference_unit != channel.unit) {
      throw SignalError(SignalFault::BadParameter, fmt::format("reference in {}, channel in {}",
                                                               reference_unit, channel.unit));
    }
    Series simulation = channel.present();
    rating.cora = cora(reference, simulation, parameters.cora, sigma);
    Series aligned = reference;
    align_grids(aligned, simulation);
    rating.iso = iso18571(aligned, simulation, parameters.iso);
  } catch (const SignalError& error) {
    rating.fault = error.what();
  }
  return rating;
}

bool is_of(const ReferenceCurve& curve, const RatedSignal& signal) {
  return curve.channel == signal.channel || set_name(curve.channel) == signal.channel;
}

}  // namespace

std::vector<RatedSignal> with_further_curves(std::vector<RatedSignal> set,
                                             const std::vector<ReferenceCurve>& curves) {
  for (const ReferenceCurve& curve : curves) {
    const auto is_like = [&curve](const RatedSignal& signal) { return is_of(curve, signal); };
    if (std::any_of(set.begin(), set.end(), is_like)) continue;
    std::string label = curve.channel;
    std::replace(label.begin(), label.end(), '_', ' ');
    set.push_back({curve.channel, label, 0});
  }
  return set;
}

std::vector<SignalRating> rate_against_curves(const std::vector<RatedSignal>& set,
                                              const std::vector<Channel>& run,
                                              const std::vector<ReferenceCurve>& curves,
                                              const RatingParameters& parameters) {
  std::vector<SignalRating> ratings;
  for (const RatedSignal& signal : set) {
    for (const ReferenceCurve& curve : curves) {
      const Channel* channel = find(run, curve.channel);
      if (channel == nullptr || !is_of(curve, signal)) continue;
      ratings.push_back(rate_signal(signal, curve.source, curve.series, curve.unit, curve.sigma,
                                    *channel, parameters));
    }
  }
  return ratings;
}

std::vector<SignalRating> rate_against_run(const std::vector<RatedSignal>& set,
                                           const std::vector<Channel>& run,
                                           const std::vector<Channel>& reference,
                                           const std::string& reference_name,
                                           const RatingParameters& parameters) {
  std::vector<SignalRating> ratings;
  for (const RatedSignal& signal : set) {
    const Channel* mine = find(run, signal.channel);
    const Channel* other = find(reference, signal.channel);
    if (mine == nullptr || other == nullptr) {
      ratings.push_back(
          {signal, reference_name, {}, {}, "the channel is missing in one of the runs"});
      continue;
    }
    ratings.push_back(
        rate_signal(signal, reference_name, other->present(), other->unit, {}, *mine, parameters));
  }
  return ratings;
}

std::optional<double> weighted_mean(const std::vector<SignalRating>& ratings, RatingMethod method) {
  double sum = 0, weights = 0;
  for (const SignalRating& r : ratings) {
    const bool is_rated = method == RatingMethod::Cora ? r.cora.has_value() : r.iso.has_value();
    if (!is_rated) continue;
    sum += r.signal.weight * (method == RatingMethod::Cora ? r.cora->C : r.iso->R);
    weights += r.signal.weight;
  }
  if (weights <= 0) return std::nullopt;
  return sum / weights;
}

MeanDeviation mean_deviation(const std::vector<double>& values) {
  MeanDeviation out;
  if (values.empty()) return out;
  for (const double value : values) out.mean += value;
  out.mean /= static_cast<double>(values.size());
  for (const double value : values) out.deviation += std::pow(value - out.mean, 2);
  out.deviation = std::sqrt(out.deviation / static_cast<double>(values.size()));
  return out;
}

nlohmann::ordered_json to_json(const std::vector<SignalRating>& ratings) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const SignalRating& r : ratings) {
    nlohmann::ordered_json entry = {{"channel", r.signal.channel},
                                    {"label", r.signal.label},
                                    {"weight", r.signal.weight},
                                    {"reference", r.reference}};
    if (r.cora) entry["cora"] = to_json(*r.cora);
    if (r.iso) entry["iso18571"] = to_json(*r.iso);
    if (!r.fault.empty()) entry["fault"] = r.fault;
    out.push_back(entry);
  }
  return out;
}

}  // namespace crosswalk::recording
