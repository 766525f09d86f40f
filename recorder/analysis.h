// From a log to the files of a run folder: channels.csv, summary.json, summary.txt.
#pragma once

#include <filesystem>

#include "common/run_directory.h"
#include "recorder/summary.h"

namespace crosswalk::recording {

struct Analysis {
  RunChannels channels;
  Summary summary;
};

/// Everything from the log alone.
Analysis analyze_log(const std::filesystem::path& log);

/// The same from messages that are already read.
Analysis analyze_record(const RunRecord& record);

/// Writes the three files.
void write_results(const Analysis& analysis, const RunDirectory& directory);

}  // namespace crosswalk::recording
