// A run that died goes on from its latest checkpoint to the result of an uninterrupted one.
#include <fstream>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/real_run.h"

namespace crosswalk::system_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ResumedRun : public RealRun {
 protected:
  /// `crosswalk resume` of the run in out("a").
  Launched resume(const std::string& name) {
    return call("crosswalk", {"resume", out("a").string()}, "resume_" + name);
  }
};

TEST_F(ResumedRun, ByHandHasTheChannelsOfAnUninterruptedRun) {
  const std::vector<std::string> options = {"--mode", "multibody", "--until-ms", "30"};
  complete("whole", options);
  Launched first = run("a", options);
  ASSERT_TRUE(wait_for(kLong, [&] { return fs::exists(out("a") / "checkpoints/latest.json"); }))
      << first.output();
  kill(first.child("mb_node"), SIGKILL);
  ASSERT_TRUE(first.wait(kLong)) << first.output();

  const auto start_again = [&](const std::string& program, std::vector<std::string> further) {
    std::vector<std::string> arguments = {"run",
                                          "--scenario",
                                          (out("a") / "scenario.toml").string(),
                                          "--run-id",
                                          provenance_of(out("a"), "run_id"),
                                          "--out",
                                          out("a").string()};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return call(program, arguments, program + "_again");
  };
  // Without --resume the log of the first part must not be overwritten.
  Launched careless = start_again("recorder", {});
  const auto refused = careless.wait(kLong);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->code, 2) << careless.output();
  EXPECT_THAT(careless.output(), HasSubstr("signals.lcmlog"));

  Launched recorder = start_again("recorder", {"--resume"});
  Launched solver = start_again("mb_node", {});
  Launched coupler = start_again("coupler", {"--resume"});
  for (Launched* node : {&coupler, &solver, &recorder}) {
    const auto status = node->wait(kLong);
    ASSERT_TRUE(status) << node->output();
    EXPECT_TRUE(status->is_success()) << node->output();
  }
  EXPECT_TRUE(channels_of(out("a")) == channels_of(out("whole")));
}

TEST_F(ResumedRun, SurvivesTheDeathOfEachProcessInTurn) {
  lay_over("[coupling]\ncheckpoint_every_ms = 0.5\n[output]\nfield_interval_ms = 1\n");
  const std::vector<std::string> options = {"--until-ms", "6"};
  complete("whole", options);
  std::mt19937 random(1);
  std::string seen;  // the checkpoint before
  Launched first = run("a", options);
  Launched* running = &first;
  std::vector<std::unique_ptr<Launched>> resumed;
  for (const char* victim : {"mb_node", "fe_node", "coupler", "recorder"}) {
    ASSERT_TRUE(wait_for(kLong, [&] {
      const std::string now = text_of(out("a") / "checkpoints/latest.json");
      return !now.empty() && now != seen && running->child(victim) > 0;
    })) << running->output();
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 100));
    kill(running->child(victim), SIGKILL);
    const auto status = running->wait(5);
    ASSERT_TRUE(status) << "still running:\n" << running->output();
    EXPECT_EQ(status->code, 3) << running->output();
    EXPECT_THAT(running->output(), HasSubstr(std::string("crosswalk: ") + victim + " failed at "));
    seen = text_of(out("a") / "checkpoints/latest.json");
    resumed.push_back(std::make_unique<Launched>(resume(victim)));
    running = resumed.back().get();
  }
  const auto status = running->wait(kLong);
  ASSERT_TRUE(status && status->is_success()) << running->output();
  EXPECT_THAT(running->output(), HasSubstr("from the checkpoint of window "));
  EXPECT_TRUE(channels_of(out("a")) == channels_of(out("whole")));
  EXPECT_GT(channels_of(out("a")).size(), 10000u);
  EXPECT_EQ(text_of(out("a") / "fields/fields.pvd"), text_of(out("whole") / "fields/fields.pvd"));

  Launched again = resume("finished");
  EXPECT_EQ(again.wait(kLong)->code, 0);
  EXPECT_THAT(again.output(), HasSubstr(" is finished, nothing is left to do"));
  EXPECT_THAT(again.output(), HasSubstr("results: " + out("a").string()));
}

TEST_F(ResumedRun, BeforeTheFirstCheckpointStartsFromTheBeginning) {
  const std::vector<std::string> options = {"--mode", "multibody", "--until-ms", "15"};
  complete("whole", options);
  Launched first = run("a", options);
  ASSERT_TRUE(wait_for(kLong, [&] { return first.has_said(" elapsed"); })) << first.output();
  first.send(SIGINT);
  EXPECT_EQ(first.wait(kLong)->code, 130) << first.output();
  ASSERT_FALSE(fs::exists(out("a") / "checkpoints/latest.json"));
  Launched second = resume("again");
  const auto status = second.wait(kLong);
  ASSERT_TRUE(status && status->is_success()) << second.output();
  EXPECT_THAT(second.output(), HasSubstr("starts from the beginning"));
  EXPECT_TRUE(fs::exists(out("a") / "signals.1.lcmlog"));
  EXPECT_TRUE(channels_of(out("a")) == channels_of(out("whole")));
}

TEST_F(ResumedRun, RefusesWhatCannotBeContinued) {
  const auto refusal = [&](int code) {
    Launched attempt = resume("attempt");
    const auto status = attempt.wait(kLong);
    EXPECT_TRUE(status && status->code == code) << attempt.output();
    return attempt.output();
  };
  EXPECT_THAT(refusal(2), HasSubstr("expected the folder of a run"));
  Launched first = run("a", {"--mode", "multibody", "--until-ms", "100"});
  ASSERT_TRUE(wait_for(kLong, [&] { return fs::exists(out("a") / "checkpoints/latest.json"); }))
      << first.output();
  EXPECT_THAT(refusal(2), HasSubstr("found one that is running"));
  first.send(SIGINT);
  ASSERT_TRUE(first.wait(kLong)) << first.output();

  fs::path part;
  for (const auto& entry : fs::recursive_directory_iterator(out("a") / "checkpoints"))
    if (entry.path().filename() == "mb_node.state") part = entry.path();
  const std::string sound = text_of(part);
  std::ofstream(part) << sound.substr(0, sound.size() - 1);
  EXPECT_THAT(refusal(7), HasSubstr("mb_node.state: truncated"));
  std::string damaged = sound;
  damaged.back() = static_cast<char>(damaged.back() ^ 1);
  std::ofstream(part) << damaged;
  EXPECT_THAT(refusal(7), HasSubstr("mb_node.state: damaged"));
  fs::remove(part);
  EXPECT_THAT(refusal(7), HasSubstr("mb_node.state: no such checkpoint file"));
  std::ofstream(part) << sound;
  const std::string scenario = text_of(out("a") / "scenario.toml");
  std::string changed = scenario;
  changed.replace(changed.find("duration_"), 0, "fidelity = \"fine\"\n");
  if (scenario.find("fidelity") != std::string::npos) changed = scenario + "\n[recorder]\n";
  std::ofstream(out("a") / "scenario.toml") << changed;
  EXPECT_THAT(refusal(2), HasSubstr("the scenario the run was started with (digest "));
}

}  // namespace
}  // namespace crosswalk::system_test
