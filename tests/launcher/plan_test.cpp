#include "launcher/plan.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "launcher/remote.h"

namespace crosswalk {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Plan : public testing::Test {
 protected:
  void SetUp() override {
    old_ = fs::current_path();
    folder_ = fs::path(testing::TempDir()) / ("plan_test_" + std::to_string(getpid()));
    fs::create_directories(folder_ / "scenarios/tests");
    fs::current_path(folder_);
    std::ofstream("scenarios/tests/Zebra.toml")
        << "[run]\nname = \"Zebra 1\"\nduration_ms = 200.0\n[[interfaces]]\nbody = \"torso\"\n";
  }
  void TearDown() override {
    fs::current_path(old_);
    fs::remove_all(folder_);
  }
  fs::path old_, folder_;
};

TEST_F(Plan, ScenarioIsFoundByPathOrByNameInAnyCase) {
  EXPECT_EQ(find_scenario("scenarios/tests/Zebra.toml"), "scenarios/tests/Zebra.toml");
  EXPECT_EQ(find_scenario("zebra"), "scenarios/tests/Zebra.toml");
  EXPECT_EQ(find_scenario("ZEBRA.toml"), "scenarios/tests/Zebra.toml");
  try {
    find_scenario("zebro");
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("found \"zebro\"; did you mean `zebra`? known: "));
  }
}

TEST_F(Plan, OptionsLieOverTheScenario) {
  RunRequest request;
  request.mode = "multibody";
  request.fidelity = "fine";
  request.until_ms = 5;
  Scenario scenario;
  const ConfigDocument document = load_scenario(find_scenario("zebra"), request, scenario);
  EXPECT_EQ(scenario.mode, RunMode::Multibody);
  EXPECT_EQ(scenario.fidelity, Fidelity::Fine);
  EXPECT_EQ(scenario.duration_ns(), 5'000'000);
  EXPECT_THAT(document.resolved_text(), HasSubstr("duration_ms = 5.0  # --until-ms:2:15"));
  EXPECT_THAT(programs_of(scenario), testing::ElementsAre("coupler", "mb_node", "recorder"));
}

TEST_F(Plan, MergedScenarioGivesEveryProcessTheSameRun) {
  Scenario scenario, again;
  RunRequest request;
  request.until_ms = 5;
  const ConfigDocument document = load_scenario(find_scenario("zebra"), request, scenario);
  std::ofstream("merged.toml") << document.resolved_text();
  load_scenario("merged.toml", {}, again);
  EXPECT_EQ(again.digest, scenario.digest);
  EXPECT_EQ(again.duration_ns(), 5'000'000);
}

TEST_F(Plan, RunFoldersAreNewAndNeverReused) {
  const RunDirectory first = make_run_directory({}, "Zebra 1");
  const RunDirectory second = make_run_directory({}, "Zebra 1");
  EXPECT_NE(first.root(), second.root());
  EXPECT_THAT(first.root().string(), HasSubstr("/runs/Zebra_1-20"));
  const RunDirectory asked = make_run_directory("mine", "x");
  std::ofstream(asked.scenario()) << "\n";
  EXPECT_THROW(make_run_directory("mine", "x"), UserError);
}

TEST_F(Plan, CommandsNameTheHostsOfOtherMachines) {
  const RunDirectory directory("/runs/x");
  const ProcessSpec here{"coupler", "/bin/coupler", {"run"}, {}, true};
  ProcessSpec there{"fe_node", "/bin/fe_node", {"run", "--out", "/runs/x"}, {}, false};
  there.host = "big";
  EXPECT_EQ(commands_text({here, there}, directory, "x-1"),
            "/bin/coupler run\n# on big, with /runs/x/scenario.toml copied to .crosswalk/x-1/ "
            "there:\ncd .crosswalk/x-1 && /bin/fe_node run --out .\n");
}

TEST_F(Plan, HostsComeFromTheScenarioAndTheCommandLine) {
  Scenario scenario;
  load_scenario(find_scenario("zebra"), {}, scenario);
  EXPECT_TRUE(hosts_of(scenario).empty());
  place_nodes(scenario, "fe=big,recorder=store");
  EXPECT_EQ(hosts_of(scenario), (std::set<std::string>{"big", "store"}));
  place_nodes(scenario, "fe_node=local,mb=store");
  EXPECT_EQ(hosts_of(scenario), (std::set<std::string>{"store"}));
  for (const char* bad : {"fe", "fe=", "sun=big", "fe=-oProxyCommand=x"})
    EXPECT_THROW(place_nodes(scenario, bad), UserError) << bad;
}

}  // namespace
}  // namespace crosswalk
