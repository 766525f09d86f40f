// Runs whose port a fuzzer disturbs, against the same runs left alone.
#pragma once

#include "tests/system/datagram_fuzzer.h"
#include "tests/system/real_run.h"

namespace crosswalk::system_test {

/// The UDP port of the run in a folder, as the launcher tells `crosswalk spy`; waits for it.
int port_of_run(const std::filesystem::path& run);

class FuzzedRun : public RealRun {
 protected:
  struct Outcome {
    bool is_success = false, has_same_channels = false;
    std::int64_t sent = 0, overheard = 0;
    int refused = 0;  ///< messages that a process dropped and counted, at least
    std::string output;
  };
  /// Runs into out(name) while a fuzzer sends; compares with the run in out(undisturbed).
  Outcome disturbed(const std::string& name, const std::string& undisturbed,
                    const std::vector<std::string>& options, unsigned seed, int per_second);
};

}  // namespace crosswalk::system_test
