#include <cstdio>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "recorder/analysis.h"
#include "recorder/commands/commands.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

ExitCode analyze(const AnalyzeRequest& request, OutputForm form) {
  const bool is_run = fs::is_directory(request.source);
  const fs::path log = is_run ? RunDirectory(request.source).signals() : request.source;
  const Analysis analysis = analyze_log(log);
  fs::path out = request.out;
  if (out.empty()) out = is_run ? request.source : fs::path(log).replace_extension("analysis");
  const RunDirectory directory(out);
  write_results(analysis, directory);
  if (form == OutputForm::Json) {
    fmt::print("{}\n", to_json(analysis.summary).dump(1));
  } else {
    fmt::print("{}\nwritten: {}, {}, {}\n", to_text(analysis.summary),
               directory.channels().string(), directory.summary().string(),
               directory.summary_text().string());
  }
  return ExitCode::Done;
}

}  // namespace crosswalk::recording
