// The four programs as the user has them, on short runs of the first test scenario.
#include "tests/system/real_run.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/source_folder.h"

namespace crosswalk::system_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

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

TEST_F(RealRun, ReplayIntoAFreshFeNodeGivesTheSameStates) {
  complete("a", {"--until-ms", "0.3"});
  Launched replay = call(
      "crosswalk", {"replay", out("a").string(), "--to", "fe", "--out", out("b").string()}, "fe");
  const auto status = replay.wait(kLong);
  ASSERT_TRUE(status) << replay.output();
  EXPECT_TRUE(status->is_success()) << replay.output();
  EXPECT_THAT(replay.output(), testing::ContainsRegex("[1-9][0-9]+ states compared, all bit-id"));
}

/// A report less what two records of one run may differ in: computing time, number of messages (the
/// stock logger hears some before the recorder has joined), provenance.
std::string page_of(const fs::path& report) {
  std::string text = text_of(report);
  const auto cut = [&text](const std::string& from, const std::string& to) {
    const std::size_t begin = text.find(from), end = text.find(to, begin);
    ASSERT_NE(end, std::string::npos) << from;
    text.erase(begin, end - begin);
  };
  cut("<th scope=\"row\">Computing time", "</tr>");
  cut("Every one of ", "</small>");
  cut("<section id=\"provenance\"", "</section>");
  return text;
}

TEST_F(RealRun, LogOfTheStockLoggerAloneGivesTheSameReport) {
  const std::string url = "udpm://239.255.76.67:19996?ttl=0&recv_buf_size=4194304";
  const fs::path log = folder() / "stock.lcmlog";
  const auto succeeds = [&](std::vector<std::string> arguments, const std::string& name) {
    Launched launched = call("recorder", std::move(arguments), name);
    const auto status = launched.wait(kLong);
    return status && status->is_success();
  };
  const fs::path ours = folder() / "ours.html", stock = folder() / "stock.html";
  // The stock logger asks nobody for what it missed, as on a busy machine it may.
  for (int attempt = 0; attempt < 5; ++attempt) {
    for (const fs::path& old : {out("a"), out("b"), log}) fs::remove_all(old);
    Launched logger("/usr/bin/lcm-logger", {"--quiet", "--lcm-url=" + url, log.string()},
                    folder() / "logger.txt");
    ASSERT_TRUE(wait_for(kLong, [&] { return fs::exists(log); }));
    complete("a", {"--mode", "multibody", "--until-ms", "3", "--lcm-url", url});
    logger.send(SIGINT);
    ASSERT_TRUE(logger.wait(kLong)) << logger.output();
    ASSERT_GT(fs::file_size(log), 100000u) << logger.output();
    ASSERT_TRUE(succeeds({"analyze", log.string(), "--out", out("b").string()}, "analyze"));
    if (text_of(out("b") / "summary.json").find("\"lost\": 0\n") != std::string::npos) break;
  }
  EXPECT_TRUE(channels_of(out("a")) == channels_of(out("b")));
  ASSERT_TRUE(succeeds({"report", out("a").string(), "--out", ours.string()}, "ours"));
  ASSERT_TRUE(succeeds({"report", log.string(), "--out", stock.string()}, "stock"));
  EXPECT_GT(page_of(ours).size(), 10000u);
  EXPECT_TRUE(page_of(ours) == page_of(stock));
}

TEST_F(RealRun, KilledNodeLeavesAReadableLog) {
  // Long enough to be met alive on any machine, however fast.
  Launched launched = run("a", {"--mode", "multibody", "--until-ms", "5000"});
  const std::regex past_10_ms("\n *[1-9][0-9]+\\.[0-9]+ ms of");
  ASSERT_TRUE(wait_for(kLong, [&] { return std::regex_search(launched.output(), past_10_ms); }))
      << launched.output();
  kill(launched.child("mb_node"), SIGKILL);
  const auto status = launched.wait(5);
  ASSERT_TRUE(status) << "still running:\n" << launched.output();
  EXPECT_EQ(status->code, 3) << launched.output();
  EXPECT_THAT(launched.output(), HasSubstr("crosswalk: mb_node failed at "));
  EXPECT_THAT(launched.output(), HasSubstr("kept in " + out("a").string()));
  EXPECT_THAT(launched.output(), HasSubstr("signals.lcmlog ("));
  Launched analyze =
      call("recorder", {"analyze", out("a").string(), "--out", out("b").string()}, "analyze");
  const auto analyzed = analyze.wait(kLong);
  ASSERT_TRUE(analyzed && analyzed->is_success()) << analyze.output();
  EXPECT_GT(channels_of(out("b")).size(), 10000u);
}

TEST_F(RealRun, MissingDeckIsNamedBeforeAnythingStarts) {
  const fs::path bad = folder() / "no_deck.toml";
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
  const fs::path bad = folder() / "bad.toml";
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

TEST_F(RealRun, ModelCommandWritesDecksAndTheirReport) {
  Launched model = call(
      "crosswalk", {"model", "v2370", "--fidelity", "coarse", "--out", out("a").string()}, "model");
  const auto status = model.wait(kLong);
  ASSERT_TRUE(status && status->is_success()) << model.output();
  for (const char* file : {"head_neck.k", "windshield.k"})
    EXPECT_TRUE(fs::exists(out("a") / "model" / file)) << file;
  const std::string report = text_of(out("a") / "model/head_neck.txt");
  EXPECT_THAT(model.output(), HasSubstr(report));
  for (const char* word :
       {"\nassembly ", "[yu2020, Table A1]", " cerebrum_left ", " pia ", " windshield "})
    EXPECT_THAT(report, HasSubstr(word));
}

TEST_F(RealRun, KeyReferenceInTheDocumentsIsCurrent) {
  Launched keys = call("crosswalk", {"keys"}, "keys");
  const auto status = keys.wait(kLong);
  ASSERT_TRUE(status && status->is_success()) << keys.output();
  EXPECT_TRUE(keys.output() == text_of(source_folder() / "docs/scenario_keys.md"))
      << "bring it up to date: ./crosswalk keys > docs/scenario_keys.md";
}

TEST_F(RealRun, CoupledRunsAreBitIdenticalWithOneAndTwoThreads) {
  complete("a", {"--until-ms", "0.5", "--threads", "1"});
  complete("b", {"--until-ms", "0.5", "--threads", "2"});
  EXPECT_TRUE(fs::exists(out("a") / "logs/fe_node.log"));
  EXPECT_TRUE(channels_of(out("a")) == channels_of(out("b")));
}

using Columns = std::map<std::string, std::vector<double>>;

/// The columns of channels.csv; an empty field reads as 0.
Columns columns_of(const fs::path& run) {
  std::istringstream lines(channels_of(run));
  std::string line, field;
  std::getline(lines, line);
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, field, ',');) names.push_back(field);
  Columns columns;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    for (const std::string& name : names) {
      field.clear();
      std::getline(fields, field, ',');
      columns[name].push_back(std::strtod(field.c_str(), nullptr));
    }
  }
  return columns;
}

TEST_F(RealRun, PrescribedHeadFollowsTheHeadOfAnotherRun) {
  complete("a", {"--mode", "multibody", "--until-ms", "3"});
  complete("b", {"--mode", "prescribed", "--from", out("a").string(), "--until-ms", "1"});
  const Columns body = columns_of(out("a")), head = columns_of(out("b"));
  // Time zero of both is the first contact, with which the prescribed run starts.
  const std::vector<double>& time = body.at("time_s");
  const double first = head.at("time_s").front() - 1e-9;
  const auto zero =
      static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), first) - time.begin());
  for (const char* channel : {"head_cog_x_mm", "head_cog_y_mm", "head_cog_z_mm"}) {
    // A gap is closed within milliseconds, not at once.
    for (std::size_t i = 0; i < 15; ++i)
      EXPECT_NEAR(head.at(channel).at(i), body.at(channel).at(zero + i), 2e-4) << channel;
  }
}

TEST_F(RealRun, AnyProcessStoppedForThreeSecondsChangesNothing) {
  const std::vector<std::string> options = {"--until-ms", "2"};
  complete("undisturbed", options);
  Launched stopped = run("stopped", options);
  const fs::path log = out("stopped") / "signals.lcmlog";
  std::uintmax_t size = 0;
  for (const char* victim : {"fe_node", "mb_node", "coupler", "recorder"}) {
    std::error_code none;
    ASSERT_TRUE(wait_for(kLong,
                         [&] {
                           return fs::exists(log) && fs::file_size(log, none) > size &&
                                  stopped.child(victim) > 0;
                         }))
        << victim << '\n'
        << stopped.output();
    const pid_t pid = stopped.child(victim);
    ASSERT_EQ(kill(pid, SIGSTOP), 0);
    std::this_thread::sleep_for(std::chrono::seconds(3));
    size = fs::file_size(log);
    ASSERT_EQ(kill(pid, SIGCONT), 0);
  }
  const auto status = stopped.wait(kLong);
  ASSERT_TRUE(status && status->is_success()) << stopped.output();
  EXPECT_TRUE(channels_of(out("stopped")) == channels_of(out("undisturbed")));
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
