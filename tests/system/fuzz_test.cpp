// Random and mutated datagrams on the port of a run change nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/system/fuzzed_run.h"

namespace crosswalk::system_test {
namespace {

TEST_F(FuzzedRun, MultibodyRunKeepsItsChannels) {
  lay_over("[coupling]\ncheckpoint_every_ms = 1\n");
  const std::vector<std::string> options = {"--mode", "multibody", "--until-ms", "10"};
  complete("whole", options);
  const Outcome outcome = disturbed("fuzzed", "whole", options, 1, 3000);
  ASSERT_TRUE(outcome.is_success) << outcome.output;
  EXPECT_TRUE(outcome.has_same_channels);
  EXPECT_GT(outcome.sent, 500);
  EXPECT_GT(outcome.overheard, 1000);
  EXPECT_GT(outcome.refused, 10);
}

TEST_F(FuzzedRun, CoupledRunKeepsItsChannels) {
  const std::vector<std::string> options = {"--until-ms", "0.3"};
  complete("whole", options);
  const Outcome outcome = disturbed("fuzzed", "whole", options, 2, 1000);
  ASSERT_TRUE(outcome.is_success) << outcome.output;
  EXPECT_TRUE(outcome.has_same_channels);
  EXPECT_GT(outcome.sent, 500);
}

}  // namespace
}  // namespace crosswalk::system_test
