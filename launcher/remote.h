// Processes of a run on other machines, by ssh.
//
// Each of them gets the run's folder there, .crosswalk/<run id> in the login folder, with the
// merged scenario; it is gathered into the run folder here in the end. The remote shell watches its
// standard input, which we hold open: it passes on the signals we write there, and ends the node
// when we are gone. CROSSWALK_SSH names another program than ssh, with options, called as `PROGRAM
// HOST COMMAND`.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/run_directory.h"
#include "common/scenario.h"
#include "launcher/process.h"

namespace crosswalk {

/// Lays "fe=hostA,mb=hostB" over the hosts of [nodes]; throws UserError.
void place_nodes(Scenario& scenario, const std::string& placement);
/// The hosts named for programs the run has; empty when all run here.
std::set<std::string> hosts_of(const Scenario& scenario);

/// The run's folder on other machines, relative to the login folder.
std::filesystem::path remote_folder(const std::string& run_id);

/// The process with the paths of the run folder relative to it.
ProcessSpec in_remote_folder(ProcessSpec spec, const RunDirectory& directory);

/// The connection that leads `port` of 127.0.0.1 there to the same port here while it lives; it
/// says "ready" on its output once it does.
ProcessSpec forwarded_port(const std::string& host, int port);

/// How to reach the other machines.
struct Remote {
  std::string run_id;

  /// The process wrapped for its host.
  ProcessSpec over_ssh(const ProcessSpec& planned, const RunDirectory& directory) const;
  /// Makes the folder on `host` and puts the scenario there, and the checkpoints when resuming.
  /// Throws UserError when the host cannot be reached.
  void send(const std::string& host, const RunDirectory& directory, bool is_resumed) const;
  /// Brings what the processes there have written into the run folder; logs go to logs/<host>/.
  /// Empty on success, else why not.
  std::string gather(const std::string& host, const RunDirectory& directory) const;
};

}  // namespace crosswalk
