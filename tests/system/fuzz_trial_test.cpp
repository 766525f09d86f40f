// Ten minutes of disturbed runs, one after the other; best with the asan preset. CROSSWALK_FUZZ_S
// changes the time.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/system/fuzzed_run.h"

namespace crosswalk::system_test {
namespace {

namespace fs = std::filesystem;

TEST_F(FuzzedRun, TenMinutes) {
  const char* asked = std::getenv("CROSSWALK_FUZZ_S");
  const double duration_s = asked != nullptr ? std::atof(asked) : 600;
  lay_over("[coupling]\ncheckpoint_every_ms = 1\n");
  const std::vector<std::string> multibody = {"--mode", "multibody", "--until-ms", "30"};
  const std::vector<std::string> coupled = {"--until-ms", "0.5"};
  complete("multibody", multibody);
  complete("coupled", coupled);
  const auto begin = std::chrono::steady_clock::now();
  double fuzzed_s = 0;
  std::int64_t sent = 0;
  unsigned trial = 0;
  for (; fuzzed_s < duration_s; ++trial) {
    const auto start = std::chrono::steady_clock::now();
    const bool is_coupled = trial % 4 == 3;
    const Outcome outcome = disturbed("fuzzed", is_coupled ? "coupled" : "multibody",
                                      is_coupled ? coupled : multibody, trial, 2000);
    ASSERT_TRUE(outcome.is_success) << "trial " << trial << ":\n" << outcome.output;
    ASSERT_TRUE(outcome.has_same_channels) << "trial " << trial;
    fs::remove_all(out("fuzzed"));
    sent += outcome.sent;
    const auto now = std::chrono::steady_clock::now();
    fuzzed_s += std::chrono::duration<double>(now - start).count();
    fmt::print(
        "{:>6.0f} s  trial {} ({}): {} datagrams sent, {} overheard, {} refused, same channels\n",
        std::chrono::duration<double>(now - begin).count(), trial,
        is_coupled ? "coupled" : "multibody", outcome.sent, outcome.overheard, outcome.refused);
    std::fflush(stdout);
  }
  fmt::print("{} runs, {} datagrams in {:.0f} s: all channels bit-identical\n", trial, sent,
             fuzzed_s);
}

}  // namespace
}  // namespace crosswalk::system_test
