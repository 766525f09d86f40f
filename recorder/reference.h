// What is published about a test (scenarios/reference/<test>/): bands, scores of other models, and
// a user's own digitised curves, which are picked up when they are there.
//
// bands.toml  quantities of the summary with low, high, status and source
// scores.toml total CORA scores of published models
// facts.toml  what else is published, in words
// curves/     <channel>.csv, columns time_ms (or time_s), value[, sigma]; comment lines
//             `# unit: mm`, `# sign: -1`, `# relative_to: buck|ground`, `# source: ...`
// Irregular samples are welcome. Without curves nothing is ever printed as a validation score.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "recorder/channel.h"

namespace crosswalk::recording {

struct Band {
  std::string quantity;  ///< key of the summary, `head_contact_time_ms`
  double low = 0, high = 0;
  std::string status;  ///< "published" or "estimated"
  std::string source;
};

struct PublishedScore {
  std::string signal, model;
  double score = 0;
};

struct ReferenceCurve {
  std::string channel;  ///< of the run, such as `head_cog_y`
  std::string unit;     ///< of the values, converted to the channel's
  Series series;        ///< s after first contact
  std::vector<double> sigma;
  std::string source;
};

/// Something published in words.
struct ReferenceFact {
  std::string name, value, source;
};

struct ReferenceData {
  std::string test;
  std::filesystem::path folder;
  std::vector<Band> bands;
  std::vector<PublishedScore> scores;
  std::string scores_source;
  std::vector<ReferenceFact> facts;
  std::vector<ReferenceCurve> curves;
  std::vector<std::string> faults;  ///< curve files that could not be read, and why
};

/// One weighted signal of a rating set.
struct RatedSignal {
  std::string channel, label;
  double weight = 1;
};

/// The folder `scenarios` this program belongs to: CROSSWALK_SCENARIOS, else the nearest one above
/// the program; empty when there is none.
std::filesystem::path scenarios_folder();

/// Data of the test a scenario is named after (case does not matter); nothing when none is kept.
std::optional<ReferenceData> reference_data(const std::string& scenario_name);

ReferenceData read_reference(const std::filesystem::path& folder);
/// Throws UserError or SignalError naming the file.
ReferenceCurve read_reference_curve(const std::filesystem::path& path);

/// `file` empty: the five head signals of the published table, equal weights.
std::vector<RatedSignal> rating_set(const std::filesystem::path& file);

}  // namespace crosswalk::recording
