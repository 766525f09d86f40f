#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/run_directory.h"
#include "recorder/analysis.h"
#include "recorder/commands/commands.h"
#include "recorder/csv_table.h"
#include "recorder/export_csv.h"
#include "recorder/isomme.h"
#include "recorder/log_file.h"
#include "recorder/run_rating.h"
#include "recorder/scoring/score_json.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

namespace {

std::string scenario_of(const fs::path& run) {
  const RunDirectory directory(run);
  if (!fs::exists(directory.channels())) {
    const RunRecord record = read_run_record(is_event_log(run) ? run : directory.signals());
    return record.manifest ? record.manifest->scenario : "";
  }
  const CsvTable table = read_csv(directory.channels());
  const auto found = table.comments.find("scenario");
  return found == table.comments.end() ? std::string{} : found->second;
}

/// Against the curves of the test the run is named after; says what to do when there are none.
std::vector<SignalRating> against_test(const RateRequest& request,
                                       const std::vector<RatedSignal>& set,
                                       const std::vector<Channel>& channels,
                                       const RatingParameters& parameters) {
  const std::string scenario = scenario_of(request.run);
  const auto reference = reference_data(scenario);
  if (reference && !reference->faults.empty())
    throw SignalError(SignalFault::BadParameter, "curve of the test: " + reference->faults.front());
  if (!reference || reference->curves.empty()) {
    Problem problem;
    problem.place.file = request.run.string();
    problem.what = "rate";
    problem.expected = "measured curves of test '" + scenario + "'";
    problem.found = "none";
    problem.hint =
        "put digitised curves into scenarios/reference/<test>/curves, or give --reference-run";
    throw UserError(problem);
  }
  return rate_against_curves(set, channels, reference->curves, parameters);
}

void print_table(const std::vector<SignalRating>& ratings, RatingMethod method) {
  const bool is_cora = method == RatingMethod::Cora;
  fmt::print("{:<28}{:>8}   {}\n", "signal", is_cora ? "C" : "R",
             is_cora ? "C1     C2     V      G      P      delta ms"
                     : "Z      EP     EM     ES     grade");
  for (const SignalRating& r : ratings) {
    if (!r.fault.empty()) {
      fmt::print("{:<28}{:>8}   {}\n", r.signal.label, "-", r.fault);
    } else if (is_cora) {
      const CoraResult& c = *r.cora;
      fmt::print("{:<28}{:>8.3f}   {:.3f}  {:.3f}  {:.3f}  {:.3f}  {:.3f}  {:+.2f}\n",
                 r.signal.label, c.C, c.C1, c.C2, c.V, c.G, c.P, 1e3 * c.delta);
    } else {
      const Iso18571Result& i = *r.iso;
      fmt::print("{:<28}{:>8.3f}   {:.3f}  {:.3f}  {:.3f}  {:.3f}  {}\n", r.signal.label, i.R, i.Z,
                 i.EP, i.EM, i.ES, i.grade);
    }
  }
  if (const auto mean = weighted_mean(ratings, method))
    fmt::print("{:<28}{:>8.3f}   weighted mean\n", "all", *mean);
}

}  // namespace

std::vector<Channel> channels_of_run(const fs::path& run) {
  if (is_isomme(run)) return channels_of(read_isomme(run));
  if (is_event_log(run)) return analyze_log(run).channels.channels;
  const RunDirectory directory(run);
  if (fs::exists(directory.channels())) return read_channels_csv(directory.channels());
  return analyze_log(directory.signals()).channels.channels;
}

ExitCode rate_runs(const RateRequest& request, const nlohmann::json& overrides, OutputForm form) {
  const RatingMethod method =
      request.method == "cora" ? RatingMethod::Cora : RatingMethod::Iso18571;
  RatingParameters parameters;
  if (method == RatingMethod::Cora) {
    parameters.cora = cora_parameters(overrides);
  } else {
    parameters.iso = iso18571_parameters(overrides);
  }
  const std::vector<RatedSignal> set = rating_set(request.set);
  const std::vector<Channel> channels = channels_of_run(request.run);
  const std::vector<SignalRating> ratings =
      request.reference_run.empty()
          ? against_test(request, set, channels, parameters)
          : rate_against_run(set, channels, channels_of_run(request.reference_run),
                             request.reference_run.string(), parameters);
  if (form == OutputForm::Json) {
    nlohmann::ordered_json out;
    out["run"] = request.run.string();
    out["signals"] = to_json(ratings);
    const auto mean = weighted_mean(ratings, method);
    out[method == RatingMethod::Cora ? "C" : "R"] =
        mean ? nlohmann::ordered_json(*mean) : nlohmann::ordered_json(nullptr);
    out["parameters"] =
        method == RatingMethod::Cora ? to_json(parameters.cora) : to_json(parameters.iso);
    fmt::print("{}\n", out.dump(1));
  } else {
    print_table(ratings, method);
  }
  return ExitCode::Done;
}

}  // namespace crosswalk::recording
