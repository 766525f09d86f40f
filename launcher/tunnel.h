// With --tunnel: a broker on this machine that the processes on other machines reach through ssh.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "common/run_directory.h"
#include "launcher/process.h"

namespace crosswalk {

/// The broker and one connection per host, which live as long as this does.
class Tunnel {
 public:
  /// Returns when every host leads `port` of its own 127.0.0.1 to the broker here. Throws UserError
  /// naming the host when that fails.
  Tunnel(int port, const std::set<std::string>& hosts, const RunDirectory& directory);

 private:
  std::vector<Process> processes_;
};

}  // namespace crosswalk
