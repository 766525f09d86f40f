// A run's channels rated signal by signal, against a test's curves or another run, and the weighted
// mean of a set.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "recorder/reference.h"
#include "recorder/scoring/cora.h"
#include "recorder/scoring/iso18571.h"

namespace crosswalk::recording {

enum class RatingMethod { Cora, Iso18571 };

/// One signal against its reference; either rating, or the fault that prevented it.
struct SignalRating {
  RatedSignal signal;
  std::string reference;  ///< what it was rated against
  std::optional<CoraResult> cora;
  std::optional<Iso18571Result> iso;
  std::string fault;
};

struct RatingParameters {
  CoraParameters cora;
  Iso18571Parameters iso;
};

/// The set and, with weight 0, every channel that has a curve but is not in it: rated, but no part
/// of the mean.
std::vector<RatedSignal> with_further_curves(std::vector<RatedSignal> set,
                                             const std::vector<ReferenceCurve>& curves);
/// Every signal of the set for which both sides have data.
std::vector<SignalRating> rate_against_curves(const std::vector<RatedSignal>& set,
                                              const std::vector<Channel>& run,
                                              const std::vector<ReferenceCurve>& curves,
                                              const RatingParameters& parameters = {});
std::vector<SignalRating> rate_against_run(const std::vector<RatedSignal>& set,
                                           const std::vector<Channel>& run,
                                           const std::vector<Channel>& reference,
                                           const std::string& reference_name,
                                           const RatingParameters& parameters = {});

/// Weighted mean over the rated signals, weights normalised; nothing when none is rated.
std::optional<double> weighted_mean(const std::vector<SignalRating>& ratings, RatingMethod method);

/// Mean and population standard deviation, the form the published table uses.
struct MeanDeviation {
  double mean = 0, deviation = 0;
};
MeanDeviation mean_deviation(const std::vector<double>& values);

nlohmann::ordered_json to_json(const std::vector<SignalRating>& ratings);

}  // namespace crosswalk::recording
