// From what the user asked for to what will be started: scenario, run folder, LCM URL, processes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config.h"
#include "common/run_directory.h"
#include "common/scenario.h"
#include "launcher/process.h"

namespace crosswalk {

struct RunRequest {
  std::string scenario;            ///< a name under scenarios/tests/, or a path
  std::string mode, fidelity;      ///< empty: as the scenario says
  std::filesystem::path from;      ///< run whose head a head alone follows; empty: none
  std::optional<double> until_ms;  ///< simulated, from first contact; replaces the duration
  std::filesystem::path out;       ///< empty: runs/<name>-<time>
  int threads = 0;                 ///< of fe_node; 0: all
  std::string url;                 ///< empty: one UDP port per run
  double wait_s = 300;             ///< patience until every process has joined
  bool is_isolated = false;        ///< private network asked for
  bool is_watched = false;         ///< live page asked for
  bool is_printed_only = false;    ///< show the commands instead of starting them
  std::string on;                  ///< "fe=hostA,mb=hostB": over the hosts of [nodes]
  std::string remote_programs;     ///< folder of the programs on other hosts; empty: as here
  int ttl = 1;                     ///< of multicast between hosts
  bool is_tunnelled = false;       ///< messages through ssh, by a broker here
  bool is_resumed = false;         ///< continue from the latest checkpoint in the run folder
};

/// The scenario file a user means: an existing path, or a name under scenarios/tests/ here or in
/// the tree this program was built from, upper or lower case. Throws UserError with a suggestion.
std::filesystem::path find_scenario(const std::string& name_or_path);

/// Reads the scenario, lays the request's options over it and checks the shared tables.
ConfigDocument load_scenario(const std::filesystem::path& file, const RunRequest& request,
                             Scenario& scenario);

/// Makes the run folder: the asked one, which must not hold a run yet, or a new one under runs/.
RunDirectory make_run_directory(const std::filesystem::path& out, const std::string& name);

/// The commands for copy and paste into shells, on this machine or on the ones [nodes] names.
std::string commands_text(const std::vector<ProcessSpec>& specs, const RunDirectory& directory,
                          const std::string& run_id);

/// The programs a run needs, coupler first.
std::vector<std::string> programs_of(const Scenario& scenario);

/// The command lines of all processes. They read the merged scenario in the run folder. Those of
/// other hosts have the host's name, but are not yet wrapped in ssh.
std::vector<ProcessSpec> process_specs(const Scenario& scenario, const RunRequest& request,
                                       const RunDirectory& directory, const std::string& run_id,
                                       const std::string& url);

}  // namespace crosswalk
