// Runs of the coupler with toy_node as the other programs, started by hand over LCM, and what they
// leave in their last checkpoint.
#pragma once

#include <string>
#include <vector>

#include "coupler/coupler.h"
#include "tests/system/launched.h"

namespace crosswalk::system_test {

/// What the toys consist of: the tables of a scenario but for [run], and how long it lasts.
struct ToyScenario {
  std::string tables;
  std::int64_t window_ns = 20000;
  int windows = 0;           ///< a multiple of checkpoint_every
  int checkpoint_every = 0;  ///< a multiple of kWindowsPerFlush; 0: once, at the end
};

/// The states of the processes after the last window.
struct ToyOutcome {
  std::vector<std::byte> mb, fe;
  coupling::CouplingState coupling;
  coupling::EnergyAudit::Books books;
};

/// Four processes in a run folder, until they have left.
class ToyProcesses {
 public:
  /// With `resume` they continue from the folder's latest checkpoint.
  ToyProcesses(const std::filesystem::path& folder, ToyScenario scenario, bool resume = false);
  /// Fails the test when one of them does not leave in good order.
  ToyOutcome outcome();

 private:
  std::filesystem::path folder_;
  ToyScenario scenario_;
  std::vector<Launched> programs_;
};

/// Runs all, a few at a time, in folders below `folder`; in their order.
std::vector<ToyOutcome> run_toys(const std::filesystem::path& folder,
                                 const std::vector<ToyScenario>& scenarios);

}  // namespace crosswalk::system_test
