// From a prepared run folder to the verdict: network, processes, supervision, last words to the
// user. Shared by `crosswalk run` and `crosswalk resume`.
#pragma once

#include <string>

#include "common/error.h"
#include "launcher/plan.h"

namespace crosswalk {

/// A run whose folder holds the merged scenario.
struct PreparedRun {
  Scenario scenario;
  RunDirectory directory;
  std::string run_id;
};

/// The commands for shells on this machine or others, printed; the network is not probed.
ExitCode print_commands(const PreparedRun& run, const RunRequest& request);

/// Brings what runs on other machines into the run folder, and tells which of them did not answer.
void gather_from_hosts(const PreparedRun& run);

/// The table of a finished run and where its files are.
void tell_results(const RunDirectory& directory);

/// Starts every process, here and on other machines, watches them to the end, prints the table or
/// what went wrong.
ExitCode start_run(const PreparedRun& run, const RunRequest& request);

}  // namespace crosswalk
