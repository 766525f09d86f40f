// The recorder's commands besides `run`, each as the exit code of one call.
//
// Bad input ends with exit 2 and one line: as text on stderr, or with --json as one object
// {"error": "<code>", "message": "..."} on stdout.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "common/error.h"
#include "recorder/channel.h"

namespace crosswalk::recording {

enum class OutputForm { Text, Json };

struct RateRequest {
  std::string method;                        ///< "cora" or "iso18571"
  std::vector<std::filesystem::path> files;  ///< PAIR.csv, or REF.csv SIM.csv
  std::filesystem::path run, reference_run;  ///< runs instead of files
  std::filesystem::path parameters;          ///< JSON with overrides; may be empty
  std::filesystem::path set;                 ///< TOML rating set; empty: the paper's five signals
};

struct InjuryRequest {
  std::filesystem::path source;  ///< CSV of signals, a run folder, an event log, or an ISO-MME test
  bool is_filtered = false;      ///< the signals are filtered already
};

struct AnalyzeRequest {
  std::filesystem::path source;  ///< a run folder, or any LCM event log
  std::filesystem::path out;     ///< empty: the run folder, or <log>.analysis beside the log
};

struct ExportRequest {
  std::filesystem::path run;
  std::string format = "csv";  ///< csv, isomme, bodies, motion or impact_motion
  std::filesystem::path out;   ///< empty: <run>/export
};

struct ReportRequest {
  std::filesystem::path run;                ///< a run folder, or any LCM event log
  std::vector<std::filesystem::path> with;  ///< further runs laid over the charts
  std::filesystem::path out;                ///< empty: report.html in the run folder
};

struct CompareRequest {
  std::vector<std::filesystem::path> runs;
  std::filesystem::path out = "compare.html";
  std::filesystem::path set;         ///< TOML rating set; empty: the paper's five signals
  std::filesystem::path parameters;  ///< JSON of CORA parameters; may be empty
};

struct ViewRequest {
  std::filesystem::path run;
  bool has_frames = true;        ///< still pictures, the only form there is
  std::vector<double> times_ms;  ///< after first contact; empty: every 40 ms to 200 ms
  int height = 480;              ///< px
  std::filesystem::path out;     ///< empty: pictures/ in the run folder
};

struct WatchRequest {
  std::filesystem::path run;
  int port = 8080;
  bool ends_with_run = false;  ///< as `crosswalk run --watch` wants it
};

struct FeedRequest {
  std::filesystem::path run;
  std::string url, run_id;  ///< of the node that is fed
};

struct BenchRequest {
  std::string what;           ///< "rating" or "report"
  std::filesystem::path run;  ///< for "report"
};

ExitCode rate(const RateRequest& request, OutputForm form);
/// Two runs against each other, or a run against its test's curves.
ExitCode rate_runs(const RateRequest& request, const nlohmann::json& overrides, OutputForm form);
ExitCode injury(const InjuryRequest& request, OutputForm form);
ExitCode analyze(const AnalyzeRequest& request, OutputForm form);
ExitCode export_run(const ExportRequest& request);
ExitCode report(const ReportRequest& request);
ExitCode compare(const CompareRequest& request);
ExitCode view(const ViewRequest& request);
ExitCode watch(const WatchRequest& request);
ExitCode feed(const FeedRequest& request);
ExitCode bench(const BenchRequest& request);

/// The JSON object of parameters in a file; an empty one when there is no file. Throws SignalError.
nlohmann::json read_parameters(const std::filesystem::path& path);

/// channels.csv of a run folder, made from its log when it is not there; or the channels of a bare
/// event log, or of an ISO-MME test.
std::vector<Channel> channels_of_run(const std::filesystem::path& run);

/// Runs `command`; SignalError and UserError become the object or line above and exit code 2.
ExitCode reported(OutputForm form, const std::function<ExitCode()>& command);

}  // namespace crosswalk::recording
