// The judgement of one run: what summary.json and the table at the end of `crosswalk run` say.
// Schema: docs/summary_schema.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "recorder/aftermath.h"
#include "recorder/extract.h"
#include "recorder/reference.h"
#include "recorder/run_rating.h"

namespace crosswalk::recording {

/// Books of the finite-element side over the run.
struct FiniteElementBalance {
  double peak_energy = 0;        ///< J, largest total
  double balance_percent = 0;    ///< largest error against what was supplied, of the peak
  double hourglass_percent = 0;  ///< at the end, of the internal energy
  double added_mass = 0;         ///< kg, by mass scaling
  std::optional<double> added_mass_percent;  ///< when the description tells the mass
};

/// Books of the multibody side over the run.
struct MultibodyBalance {
  double start = 0;  ///< J, held at the start
  MbEnergies end;
  double balance_percent = 0;  ///< largest error against what was supplied, of the peak kinetic
};

struct CouplingQuality {
  double drift = 0, exchanged = 0;  ///< J, at the end
  double drift_percent = 0;         ///< largest |drift| of the energy exchanged at the end
  double balance_percent = 0;       ///< both sides, largest, of the peak total
  double gap_mm = 0;                ///< largest distance between a body and its block
  double owed_force = 0;            ///< N, largest that a body had not yet got at a window's end
  double owed_moment = 0;           ///< N m, likewise
  int resends = 0;
  double iterations = 0;  ///< mean per window
};

struct RegionPeak {
  std::string region;
  double mps_max = 0, mps_95 = 0, mps_95_time = 0;  ///< largest value of any instant; s after t0
  double mps_95_so_far = 0;                         ///< 95th percentile of the element maxima
  double csdm_15 = 0, csdm_25 = 0, von_mises_95 = 0, pressure_max = 0, pressure_min = 0;
  double inside_out = 0;  ///< largest volume share of bricks with a corner inside out
};

/// Percent of a region's volume: a fifth of what its 95th percentile leaves above it.
inline constexpr double kInsideOutLimitPercent = 1;

struct Timing {
  double wall = 0, windows = 0, mb = 0, fe = 0;  ///< s; differ from run to run
  double exchange = 0;  ///< s of the windows in which neither solver computed
};

struct BandVerdict {
  Band band;
  std::optional<double> value;  ///< absent when the run does not give the quantity
  bool is_inside = false;
};

struct Summary {
  Manifest manifest;
  std::int64_t windows = 0;
  double simulated = 0;  ///< s
  bool is_complete = false;
  std::string outcome;  ///< "complete", or what is missing
  std::int64_t messages = 0, doubled = 0, lost = 0;
  double t0 = 0;
  bool has_first_contact = false;
  std::optional<double> initial_buck_speed;
  std::optional<HeadContact> head_contact;
  Aftermath after;
  ScoreCard card;
  std::vector<RegionPeak> tissue;
  std::optional<MultibodyBalance> mb;  ///< absent when no body moves by itself
  std::optional<FiniteElementBalance> fe;
  std::optional<CouplingQuality> coupling;
  Timing timing;
  std::vector<BandVerdict> bands;
  std::vector<SignalRating> ratings;
  std::vector<PublishedScore> published;
  std::string published_source;
  std::vector<std::string> warnings;
  std::vector<std::string> statements;  ///< what is estimated, what was not compared
};

Summary summarize(const RunRecord& record, const RunChannels& channels,
                  const std::optional<ReferenceData>& reference);

/// The value a band's quantity has in this run.
std::optional<double> summary_quantity(const Summary& summary, const std::string& quantity);

nlohmann::ordered_json to_json(const Summary& summary);

/// The table a newcomer reads.
std::string to_text(const Summary& summary);

}  // namespace crosswalk::recording
