// The launcher and the coupler with small stand-ins for the other programs, as real processes.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/source_folder.h"
#include "tests/system/launched.h"

namespace crosswalk::system_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kLong = 60;  // s; far beyond what anything here takes

const fs::path kPrograms = build_folder() / "toy_bin";
const fs::path kScenario = source_folder() / "tests/system/toy.toml";

class ToyRun : public testing::Test {
 protected:
  /// Starts `crosswalk run` with a run folder `name`.
  Launched start(const std::string& name, std::vector<std::string> options = {}) {
    std::vector<std::string> arguments = {"run", kScenario.string(), "--out", out(name).string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return Launched(kPrograms / "crosswalk", arguments, folder_.path() / (name + ".txt"));
  }
  fs::path out(const std::string& name) const { return folder_.path() / name; }
  /// A run of many seconds, returned when its first windows are done.
  Launched start_long(const std::string& name) {
    setenv("CROSSWALK_TOY_STEP_US", "2000", 1);
    Launched run = start(name, {"--until-ms", "5000"});
    unsetenv("CROSSWALK_TOY_STEP_US");
    EXPECT_TRUE(wait_for(kLong, [&] { return run.has_said(" elapsed"); })) << run.output();
    return run;
  }
  TemporaryFolder folder_;
};

TEST_F(ToyRun, GoesToItsEnd) {
  Launched run = start("a");
  const auto status = run.wait(kLong);
  ASSERT_TRUE(status) << run.output();
  EXPECT_TRUE(status->is_success()) << run.output();
  EXPECT_THAT(run.output(), HasSubstr(" ms of 10 ms  100 %"));
  EXPECT_THAT(run.output(), HasSubstr("results: " + out("a").string()));
  for (const char* file : {"scenario.toml", "provenance.json", "logs/coupler.log",
                           "logs/mb_node.log", "logs/fe_node.log", "logs/recorder.log"})
    EXPECT_TRUE(fs::exists(out("a") / file)) << file;
  EXPECT_FALSE(fs::exists(out("a") / "running"));
}

TEST_F(ToyRun, TwoAtOnceDoNotMix) {
  Launched first = start("a"), second = start("b");
  const auto first_status = first.wait(kLong), second_status = second.wait(kLong);
  ASSERT_TRUE(first_status && second_status);
  EXPECT_TRUE(first_status->is_success()) << first.output();
  EXPECT_TRUE(second_status->is_success()) << second.output();
}

TEST_F(ToyRun, TwoOnOnePortDoNotMix) {
  const std::string url = "udpm://239.255.76.67:19999?ttl=0&recv_buf_size=4194304";
  setenv("CROSSWALK_TOY_STEP_US", "1000", 1);
  Launched first = start("a", {"--lcm-url", url});
  ASSERT_TRUE(wait_for(kLong, [&] { return first.has_said(" elapsed"); })) << first.output();
  Launched second = start("b", {"--lcm-url", url});
  unsetenv("CROSSWALK_TOY_STEP_US");
  const auto first_status = first.wait(kLong), second_status = second.wait(kLong);
  ASSERT_TRUE(first_status && second_status);
  EXPECT_TRUE(first_status->is_success()) << first.output();
  EXPECT_TRUE(second_status->is_success()) << second.output();
  EXPECT_THAT(second.output(), HasSubstr("port 19999 is in use"));
}

class KilledProcess : public ToyRun, public testing::WithParamInterface<const char*> {};

TEST_P(KilledProcess, EndsTheRunWithinFiveSecondsByName) {
  const std::string name = GetParam();
  Launched run = start_long("a");
  const pid_t victim = run.child(name);
  ASSERT_GT(victim, 0);
  kill(victim, SIGKILL);
  const auto status = run.wait(5);
  ASSERT_TRUE(status) << "still running:\n" << run.output();
  EXPECT_EQ(status->code, 3) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("crosswalk: " + name + " failed at "));
  EXPECT_THAT(run.output(), HasSubstr("killed by signal 9"));
  EXPECT_THAT(run.output(), HasSubstr("kept in "));
  EXPECT_TRUE(processes_with(out("a").string()).empty());
}

INSTANTIATE_TEST_SUITE_P(Each, KilledProcess,
                         testing::Values("coupler", "mb_node", "fe_node", "recorder"),
                         [](const auto& test) { return std::string(test.param); });

TEST_F(ToyRun, InterruptEndsItInGoodOrder) {
  Launched run = start_long("a");
  run.send(SIGINT);
  const auto status = run.wait(1.9);  // less than the grace after which all are told to leave
  ASSERT_TRUE(status) << run.output();
  EXPECT_EQ(status->code, 130) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("crosswalk: interrupted at "));
  EXPECT_THAT(
      text_of(out("a") / "logs/coupler.log"),
      testing::ContainsRegex("\\[ *[0-9]+\\.[0-9]{3}\\] \\[coupler\\] error stopped on request"));
  EXPECT_THAT(run.output(), HasSubstr("kept in " + out("a").string()));
  EXPECT_TRUE(processes_with(out("a").string()).empty());
}

TEST_F(ToyRun, KilledLauncherLeavesNobodyBehind) {
  Launched run = start_long("a");
  ASSERT_GT(run.child("fe_node"), 0);
  run.send(SIGKILL);
  run.wait(kLong);
  EXPECT_TRUE(wait_for(10, [&] { return processes_with(out("a").string()).empty(); }));
}

TEST_F(ToyRun, ProcessesStartedByHandInAnyOrderFindEachOther) {
  std::array<std::string, 4> order = {"recorder", "mb_node", "coupler", "fe_node"};
  for (int round = 0; round < 3; ++round, std::next_permutation(order.begin(), order.end())) {
    const std::string run_id = "by-hand-" + std::to_string(getpid()) + "-" + std::to_string(round);
    std::vector<Launched> programs;
    for (const std::string& name : order)
      programs.emplace_back(
          kPrograms / name,
          std::vector<std::string>{"run", "--scenario", kScenario.string(), "--run-id", run_id,
                                   "--out", out(run_id).string(), "--wait-s", "30"},
          folder_.path() / (run_id + "-" + name + ".txt"));
    for (Launched& program : programs) {
      const auto status = program.wait(kLong);
      ASSERT_TRUE(status) << program.output();
      EXPECT_TRUE(status->is_success()) << program.output();
    }
  }
}

TEST_F(ToyRun, SecondCouplerAndSecondNodeAreRefused) {
  Launched run = start_long("a");
  const std::string id = text_of(out("a") / "provenance.json");
  const std::size_t begin = id.find("\"run_id\": \"") + 11;
  const std::string run_id = id.substr(begin, id.find('"', begin) - begin);
  const std::string mark = text_of(out("a") / "running");
  const std::string url = mark.substr(mark.find("udpm"), mark.find('\n') - mark.find("udpm"));
  for (const auto& [name, code] : {std::pair{"coupler", 12}, std::pair{"mb_node", 13}}) {
    Launched second(kPrograms / name,
                    {"run", "--scenario", (out("a") / "scenario.toml").string(), "--run-id", run_id,
                     "--url", url, "--out", out("second").string()},
                    folder_.path() / "second.txt");
    const auto status = second.wait(kLong);
    ASSERT_TRUE(status) << second.output();
    EXPECT_EQ(status->code, code) << second.output();
  }
  run.send(SIGINT);
  EXPECT_EQ(run.wait(kLong)->code, 130);
}

TEST_F(ToyRun, PrivateNetworkOnRequest) {
  Launched run = start("a", {"--isolate"});
  const auto status = run.wait(kLong);
  ASSERT_TRUE(status) << run.output();
  if (status->code == 10) {  // kernels may forbid it; then the cure is told
    EXPECT_THAT(run.output(), HasSubstr("ip route add 224.0.0.0/4"));
    GTEST_SKIP() << "no network namespaces here";
  }
  EXPECT_TRUE(status->is_success()) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("private network"));
}

/// A toy run on a machine of its own whose multicast leaves through a real interface, after
/// `preparation` there; empty where namespaces are not allowed.
class OnAMachineWithNetwork : public ToyRun {
 protected:
  std::optional<Launched> start_there(const std::string& preparation,
                                      const std::vector<std::string>& options) {
    const std::string script =
        "ip link set lo up && ip link add real0 type veth peer name real1 && "
        "ip addr add 10.1.1.1/24 dev real0 && ip link set real0 up && ip link set real1 up && "
        "ip route add 224.0.0.0/4 dev real0 || exit 77; " +
        preparation + "exec \"$0\" \"$@\"";
    std::vector<std::string> words = {"-rn",
                                      "sh",
                                      "-c",
                                      script,
                                      (kPrograms / "crosswalk").string(),
                                      "run",
                                      kScenario.string(),
                                      "--out",
                                      out("a").string()};
    words.insert(words.end(), options.begin(), options.end());
    Launched run("/usr/bin/unshare", words, folder_.path() / "a.txt");
    if (!wait_for(kLong, [&] { return run.has_said(" ms of ") || run.wait(0); }) ||
        (run.wait(0) && (run.wait(0)->code == 77 || run.has_said("unshare failed"))))
      return std::nullopt;
    return run;
  }
};

TEST_F(OnAMachineWithNetwork, IsolatedRunsAreFoundBySpy) {
  setenv("CROSSWALK_TOY_STEP_US", "2000", 1);
  std::optional<Launched> run = start_there("", {"--isolate", "--until-ms", "5000"});
  unsetenv("CROSSWALK_TOY_STEP_US");
  if (!run) GTEST_SKIP() << "no network namespaces here";
  EXPECT_THAT(run->output(), HasSubstr("in a private network (as asked)"));
  // In the place of lcm-spy, a `java` that tells where it is.
  const fs::path java = folder_.path() / "java";
  std::ofstream(java) << "#!/bin/sh\nreadlink /proc/self/ns/net\necho $LCM_DEFAULT_URL\n";
  fs::permissions(java, fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder_.path().string() + ":" + path).c_str(), 1);
  Launched spy(kPrograms / "crosswalk", {"spy", out("a").string()}, folder_.path() / "spy.txt");
  const auto status = spy.wait(kLong);
  setenv("PATH", path.c_str(), 1);
  ASSERT_TRUE(status && status->is_success()) << spy.output();
  const pid_t launcher = processes_called("crosswalk", out("a").string()).at(0);
  const std::string network =
      fs::read_symlink("/proc/" + std::to_string(launcher) + "/ns/net").string();
  EXPECT_NE(network, fs::read_symlink("/proc/self/ns/net").string());
  EXPECT_THAT(spy.output(), HasSubstr(network));
  EXPECT_THAT(spy.output(), HasSubstr("udpm://239.255.76.67:"));
  run->send(SIGINT);
  EXPECT_EQ(run->wait(kLong)->code, 130) << run->output();
}

TEST_F(OnAMachineWithNetwork, ItsMulticastServesWhereItWorks) {
  std::optional<Launched> run = start_there("", {});
  if (!run) GTEST_SKIP() << "no network namespaces here";
  const auto status = run->wait(kLong);
  EXPECT_TRUE(status && status->is_success()) << run->output();
  EXPECT_THAT(run->output(), HasSubstr("messages by multicast of this machine (real0,"));
}

TEST_F(OnAMachineWithNetwork, GivenUrlIsTakenAsItIs) {
  std::optional<Launched> run =
      start_there("", {"--lcm-url", "udpm://239.255.76.67:19990?ttl=0&recv_buf_size=4194304"});
  if (!run) GTEST_SKIP() << "no network namespaces here";
  const auto status = run->wait(kLong);
  EXPECT_TRUE(status && status->is_success()) << run->output();
  EXPECT_THAT(run->output(), testing::Not(HasSubstr("private network")));
}

TEST_F(ToyRun, MistakesEndItBeforeAnythingStarts) {
  const fs::path bad = folder_.path() / "bad.toml";
  std::ofstream(bad) << "[run]\nname = \"bad\"\nduration_ms = \"long\"\n[[interfaces]]\nbody = "
                        "\"block\"\n[coupling]\nwindow_s = 20\n";
  Launched run(kPrograms / "crosswalk", {"run", bad.string(), "--out", out("a").string()},
               folder_.path() / "a.txt");
  EXPECT_EQ(run.wait(kLong)->code, 2);
  EXPECT_THAT(run.output(), HasSubstr("bad.toml:3:15: run.duration_ms: expected "));
  EXPECT_FALSE(fs::exists(out("a")));
  Launched check(kPrograms / "crosswalk", {"check", kScenario.string()}, folder_.path() / "c.txt");
  EXPECT_TRUE(check.wait(kLong)->is_success()) << check.output();
}

}  // namespace
}  // namespace crosswalk::system_test
