// Runs across machines: network namespaces joined by virtual Ethernet pairs stand for them.
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/source_folder.h"
#include "tests/system/real_run.h"

namespace crosswalk::system_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Hosts : public RealRun {
 protected:
  /// Runs a command on the first of `count` hosts.
  Launched on_hosts(const std::string& name, int count, const std::string& faults,
                    const std::vector<std::string>& command, bool has_sshd = false) {
    std::vector<std::string> words = {(source_folder() / "tests/system/hosts.sh").string()};
    if (has_sshd) words.push_back("--sshd");
    words.insert(words.end(), {(kPrograms / "faulty_hub").string(), std::to_string(count), faults});
    words.insert(words.end(), command.begin(), command.end());
    return Launched("/bin/sh", words, folder() / (name + ".txt"));
  }
  std::vector<std::string> run_command(const std::string& name,
                                       const std::vector<std::string>& options) {
    std::vector<std::string> command = {(kPrograms / "crosswalk").string(), "run",
                                        scenario().string(), "--out", out(name).string()};
    command.insert(command.end(), options.begin(), options.end());
    return command;
  }
  /// Runs on several hosts to the end; false when namespaces are not allowed here.
  bool completes(const std::string& name, int count, const std::string& faults,
                 const std::vector<std::string>& options) {
    Launched launched = on_hosts(name, count, faults, run_command(name, options));
    const auto status = launched.wait(kLong);
    if (status && status->code == 77) return false;
    EXPECT_TRUE(status && status->is_success()) << launched.output();
    EXPECT_THAT(launched.output(), HasSubstr("results: " + out(name).string()));
    return true;
  }
};

constexpr const char* kBadNetwork = "loss=0.05 duplicate=0.02 reorder=0.02 jitter_ms=20";

TEST_F(Hosts, MultibodyRunOnTwoHasTheSameChannels) {
  const std::vector<std::string> options = {"--mode", "multibody", "--until-ms", "5"};
  complete("here", options);
  std::vector<std::string> apart = options;
  apart.insert(apart.end(), {"--on", "mb=host2"});
  if (!completes("apart", 2, "", apart)) GTEST_SKIP() << "no network namespaces here";
  EXPECT_GT(channels_of(out("here")).size(), 10000u);
  EXPECT_TRUE(channels_of(out("apart")) == channels_of(out("here")));
  EXPECT_THAT(text_of(out("apart") / "logs/host2/mb_node.log"), HasSubstr("[mb_node] info"));
  EXPECT_THAT(text_of(out("apart") / "provenance-host2.json"), HasSubstr("\"host\": \"host2\""));
}

TEST_F(Hosts, CoupledRunOnThreeWithFaultsHasTheSameChannels) {
  const std::vector<std::string> options = {"--until-ms", "0.2"};
  complete("here", options);
  std::vector<std::string> apart = options;
  apart.insert(apart.end(), {"--on", "mb=host2,fe=host3,recorder=host3"});
  if (!completes("apart", 3, kBadNetwork, apart)) GTEST_SKIP() << "no network namespaces here";
  EXPECT_TRUE(channels_of(out("apart")) == channels_of(out("here")));
  EXPECT_TRUE(fs::exists(out("apart") / "fields/fields.pvd"));
}

TEST_F(Hosts, BrokerReplacesMulticast) {
  const std::vector<std::string> options = {"--mode", "multibody", "--until-ms", "5"};
  complete("here", options);
  const std::string script =
      "\"$0\" broker --listen 10.0.0.1:7700 & broker=$!; "
      "status=0; \"$0\" \"$@\" || status=$?; kill $broker; exit $status";
  std::vector<std::string> command = run_command("apart", options);
  command.insert(command.begin(), {"sh", "-c", script});
  command.insert(command.end(), {"--on", "mb=host2", "--lcm-url", "tcpq://10.0.0.1:7700"});
  Launched launched = on_hosts("apart", 2, "", command);
  const auto status = launched.wait(kLong);
  if (status && status->code == 77) GTEST_SKIP() << "no network namespaces here";
  ASSERT_TRUE(status && status->is_success()) << launched.output();
  EXPECT_TRUE(channels_of(out("apart")) == channels_of(out("here")));
}

TEST_F(Hosts, SshAndItsTunnelHaveTheSameChannels) {
  const std::vector<std::string> options = {"--mode", "multibody", "--until-ms", "5"};
  complete("here", options);
  for (const std::string way : {"multicast", "tunnel"}) {
    std::vector<std::string> command = run_command(way, options);
    command.insert(command.end(), {"--on", "mb=host2,recorder=host2"});
    if (way == "tunnel") command.push_back("--tunnel");
    Launched launched = on_hosts(way, 2, "", command, true);
    const auto status = launched.wait(kLong);
    if (status && status->code == 77) GTEST_SKIP() << launched.output();
    ASSERT_TRUE(status && status->is_success()) << launched.output();
    EXPECT_TRUE(channels_of(out(way)) == channels_of(out("here"))) << way;
    EXPECT_EQ(fs::exists(out(way) / "logs/tunnel-host2.log"), way == "tunnel");
  }
}

TEST_F(Hosts, NodeKilledElsewhereEndsTheRunEverywhere) {
  Launched launched =
      on_hosts("a", 2, "",
               run_command("a", {"--mode", "multibody", "--until-ms", "150", "--on", "mb=host2"}));
  if (!wait_for(kLong,
                [&] { return launched.has_said(" elapsed") || launched.has_said("here"); }) ||
      launched.has_said("no network namespaces"))
    GTEST_SKIP() << launched.output();
  const auto nodes = [&] { return processes_called("mb_node", provenance_of(out("a"), "run_id")); };
  ASSERT_EQ(nodes().size(), 1u);
  kill(nodes().front(), SIGKILL);
  const auto status = launched.wait(10);
  ASSERT_TRUE(status) << launched.output();
  EXPECT_EQ(status->code, 3) << launched.output();
  EXPECT_THAT(launched.output(), HasSubstr("crosswalk: mb_node failed at "));
  EXPECT_THAT(launched.output(), HasSubstr("killed by signal 9"));
  EXPECT_TRUE(processes_with(provenance_of(out("a"), "run_id")).empty());
}

TEST_F(Hosts, KilledLauncherLeavesNobodyElsewhere) {
  Launched launched =
      on_hosts("a", 2, "",
               run_command("a", {"--mode", "multibody", "--until-ms", "150", "--on", "mb=host2"}));
  if (!wait_for(kLong,
                [&] { return launched.has_said(" elapsed") || launched.has_said("here"); }) ||
      launched.has_said("no network namespaces"))
    GTEST_SKIP() << launched.output();
  const std::string run_id = provenance_of(out("a"), "run_id");
  const std::vector<pid_t> launchers = processes_called("crosswalk", out("a").string());
  ASSERT_EQ(launchers.size(), 1u);
  kill(launchers.front(), SIGKILL);
  EXPECT_TRUE(wait_for(10, [&] { return processes_with(run_id).empty(); }));
}

}  // namespace
}  // namespace crosswalk::system_test
