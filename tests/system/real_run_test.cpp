// The four programs as the user has them, on short runs of the first test scenario.
#include <chrono>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/launched.h"

namespace crosswalk::system_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kLong = 300;  // s; far beyond what anything here takes

const fs::path kPrograms = fs::path(CW_BINARY_DIR) / "bin";
const fs::path kScenarios = fs::path(CW_SOURCE_DIR) / "scenarios/tests";

/// Everything below the comment lines, which name the scenario.
std::string channels_of(const fs::path& run) { return text_of(run / "channels.csv"); }

class RealRun : public testing::Test {
 protected:
  Launched call(const std::string& program, std::vector<std::string> arguments,
                const std::string& name) {
    return Launched(kPrograms / program, std::move(arguments), folder_.path() / (name + ".txt"));
  }
  Launched run(const std::string& name, std::vector<std::string> options) {
    std::vector<std::string> arguments = {"run", (kScenarios / "v2370.toml").string(), "--out",
                                          out(name).string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return call("crosswalk", arguments, name);
  }
  /// Runs to the end and expects success.
  void complete(const std::string& name, std::vector<std::string> options) {
    Launched launched = run(name, std::move(options));
    const auto status = launched.wait(kLong);
    ASSERT_TRUE(status) << "still running:\n" << launched.output();
    ASSERT_TRUE(status->is_success()) << launched.output();
    EXPECT_THAT(launched.output(), HasSubstr("results: " + out(name).string()));
    for (const char* file : {"scenario.toml", "provenance.json", "signals.lcmlog", "channels.csv",
                             "summary.json", "summary.txt", "logs/coupler.log"})
      EXPECT_TRUE(fs::exists(out(name) / file)) << file;
  }
  fs::path out(const std::string& name) const { return folder_.path() / name; }
  std::string provenance(const std::string& name, const std::string& key) const {
    const std::string text = text_of(out(name) / "provenance.json");
    const std::size_t begin = text.find("\"" + key + "\": \"") + key.size() + 5;
    return text.substr(begin, text.find('"', begin) - begin);
  }
  TemporaryFolder folder_;
};

TEST_F(RealRun, MultibodyRunsAreBitIdentical) {
  complete("a", {"--mode", "multibody", "--until-ms", "5"});
  complete("b", {"--mode", "multibody", "--until-ms", "5"});
  EXPECT_GT(channels_of(out("a")).size(), 10000u);
  EXPECT_TRUE(channels_of(out("a")) == channels_of(out("b")));
}

TEST_F(RealRun, ReplayIntoAFreshRecorderGivesTheSameChannels) {
  complete("a", {"--mode", "multibody", "--until-ms", "3"});
  Launched replay = call(
      "crosswalk",
      {"replay", out("a").string(), "--to", "recorder", "--isolate", "--out", out("b").string()},
      "replay");
  const auto status = replay.wait(kLong);
  ASSERT_TRUE(status) << replay.output();
  EXPECT_TRUE(status->is_success()) << replay.output();
  EXPECT_TRUE(channels_of(out("a")) == channels_of(out("b")));
}

TEST_F(RealRun, ResumesAfterAKillWithTheChannelsOfAnUninterruptedRun) {
  const std::vector<std::string> options = {"--mode", "multibody", "--until-ms", "30"};
  complete("whole", options);
  Launched first = run("a", options);
  ASSERT_TRUE(wait_for(kLong, [&] { return fs::exists(out("a") / "checkpoints/latest.json"); }))
      << first.output();
  kill(first.child("mb_node"), SIGKILL);
  ASSERT_TRUE(first.wait(kLong)) << first.output();

  const auto resume = [&](const std::string& program, std::vector<std::string> further) {
    std::vector<std::string> arguments = {"run",
                                          "--scenario",
                                          (out("a") / "scenario.toml").string(),
                                          "--run-id",
                                          provenance("a", "run_id"),
                                          "--out",
                                          out("a").string()};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return call(program, arguments, program + "_again");
  };
  // Without --resume the log of the first part must not be overwritten.
  Launched careless = resume("recorder", {});
  const auto refused = careless.wait(kLong);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->code, 2) << careless.output();
  EXPECT_THAT(careless.output(), HasSubstr("signals.lcmlog"));

  Launched recorder = resume("recorder", {"--resume"});
  Launched solver = resume("mb_node", {});
  Launched coupler = resume("coupler", {"--resume"});
  for (Launched* node : {&coupler, &solver, &recorder}) {
    const auto status = node->wait(kLong);
    ASSERT_TRUE(status) << node->output();
    EXPECT_TRUE(status->is_success()) << node->output();
  }
  EXPECT_TRUE(channels_of(out("a")) == channels_of(out("whole")));
}

TEST_F(RealRun, KilledNodeLeavesAReadableLog) {
  Launched launched = run("a", {"--mode", "multibody", "--until-ms", "150"});
  ASSERT_TRUE(wait_for(kLong, [&] { return launched.has_said("  10."); })) << launched.output();
  kill(launched.child("mb_node"), SIGKILL);
  const auto status = launched.wait(5);
  ASSERT_TRUE(status) << "still running:\n" << launched.output();
  EXPECT_EQ(status->code, 3) << launched.output();
  EXPECT_THAT(launched.output(), HasSubstr("crosswalk: mb_node failed at 1"));
  EXPECT_THAT(launched.output(), HasSubstr("kept in " + out("a").string()));
  EXPECT_THAT(launched.output(), HasSubstr("signals.lcmlog ("));
  Launched analyze =
      call("recorder", {"analyze", out("a").string(), "--out", out("b").string()}, "analyze");
  const auto analyzed = analyze.wait(kLong);
  ASSERT_TRUE(analyzed && analyzed->is_success()) << analyze.output();
  EXPECT_GT(channels_of(out("b")).size(), 10000u);
}

TEST_F(RealRun, MissingDeckIsNamedBeforeAnythingStarts) {
  const fs::path bad = folder_.path() / "no_deck.toml";
  std::ofstream(bad) << "base = \"" << (kScenarios / "v2370.toml").string()
                     << "\"\n[head_neck]\ndeck = \"no_such_head.k\"\n";
  Launched launched =
      call("crosswalk", {"run", bad.string(), "--out", out("a").string()}, "no_deck");
  const auto status = launched.wait(kLong);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, 2) << launched.output();
  EXPECT_THAT(launched.output(), HasSubstr("no_deck.toml:3:8: head_neck.deck: expected an existing "
                                           "file, found \"no_such_head.k\""));
  EXPECT_FALSE(fs::exists(out("a")));
}

TEST_F(RealRun, MistakesOfEveryProgramComeWithTheirPlaces) {
  std::ifstream in(kScenarios / "v2370.toml");
  const fs::path bad = folder_.path() / "bad.toml";
  std::ofstream(bad)
      << "base = \"" << (kScenarios / "v2370.toml").string()
      << "\"\n[vehicle]\nspeed_m_s = 4000\n[coupling]\nsilent_after_m = 1\n[posture]\n"
         "right_hip_flexoin_deg = 5\n";
  Launched check = call("crosswalk", {"check", bad.string()}, "check");
  const auto status = check.wait(kLong);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, 2);
  EXPECT_THAT(check.output(), HasSubstr("bad.toml:3:13: vehicle.speed_m_s: expected"));
  EXPECT_THAT(check.output(), HasSubstr("bad.toml:5:1: coupling.silent_after_m: expected a time"));
  EXPECT_THAT(check.output(), HasSubstr("did you mean `right_hip_flexion_deg`?"));
}

TEST_F(RealRun, EveryScenarioHasNoMistakes) {
  for (const auto& entry : fs::directory_iterator(kScenarios)) {
    if (entry.path().extension() != ".toml") continue;
    Launched check = call("crosswalk", {"check", entry.path().string()}, "check");
    const auto status = check.wait(kLong);
    ASSERT_TRUE(status);
    EXPECT_TRUE(status->is_success()) << check.output();
  }
}

TEST_F(RealRun, KeyReferenceInTheDocumentsIsCurrent) {
  Launched keys = call("crosswalk", {"keys"}, "keys");
  const auto status = keys.wait(kLong);
  ASSERT_TRUE(status && status->is_success()) << keys.output();
  EXPECT_TRUE(keys.output() == text_of(fs::path(CW_SOURCE_DIR) / "docs/scenario_keys.md"))
      << "bring it up to date: ./crosswalk keys > docs/scenario_keys.md";
}

TEST_F(RealRun, CoupledRunsAreBitIdenticalWithOneAndTwoThreads) {
  complete("a", {"--until-ms", "0.5", "--threads", "1"});
  complete("b", {"--until-ms", "0.5", "--threads", "2"});
  EXPECT_TRUE(fs::exists(out("a") / "logs/fe_node.log"));
  EXPECT_TRUE(channels_of(out("a")) == channels_of(out("b")));
}

TEST_F(RealRun, KilledFeNodeEndsACoupledRunByName) {
  Launched launched = run("a", {"--until-ms", "100"});
  ASSERT_TRUE(wait_for(kLong, [&] { return launched.has_said(" elapsed"); })) << launched.output();
  kill(launched.child("fe_node"), SIGKILL);
  const auto status = launched.wait(5);
  ASSERT_TRUE(status) << "still running:\n" << launched.output();
  EXPECT_EQ(status->code, 3) << launched.output();
  EXPECT_THAT(launched.output(), HasSubstr("crosswalk: fe_node failed at "));
}

}  // namespace
}  // namespace crosswalk::system_test
