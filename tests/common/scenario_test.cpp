#include "common/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crosswalk {
namespace {

using testing::HasSubstr;

constexpr const char* kRun = "[run]\nname = \"V2370\"\nduration_ms = 200.0\n";
constexpr const char* kFaces =
    "[[interfaces]]\nbody = \"hood\"\nattached = false\n[[interfaces]]\nbody = \"torso\"\npart = "
    "\"neck_base\"\n";

Scenario scenario_of(const std::string& text) {
  ConfigDocument document = ConfigDocument::from_text(text, "s.toml");
  Scenario scenario = read_scenario(document);
  ignore_tables_of_others(document, "none");
  document.finish();
  return scenario;
}

std::string complaint(const std::string& text) {
  try {
    scenario_of(text);
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

TEST(Scenario, SharedTablesComeWithDefaults) {
  const Scenario scenario = scenario_of(std::string(kRun) + kFaces + "[coupling]\nx = 1\n");
  EXPECT_EQ(scenario.name, "V2370");
  EXPECT_EQ(scenario.mode, RunMode::Coupled);
  EXPECT_EQ(scenario.fidelity, Fidelity::Coarse);
  EXPECT_EQ(scenario.duration_ns(), 200'000'000);
  ASSERT_EQ(scenario.interfaces.size(), 2u);
  EXPECT_EQ(scenario.interfaces[0].body, "torso");  // attached ones first
  EXPECT_EQ(scenario.interfaces[0].part, "neck_base");
  EXPECT_EQ(scenario.interfaces[1].body, "hood");
  EXPECT_EQ(scenario.interfaces[1].part, "hood");
  EXPECT_FALSE(scenario.interfaces[1].is_attached);
}

TEST(Scenario, MultibodyModeHasNoInterfaces) {
  const Scenario scenario = scenario_of(std::string(kRun) + "mode = \"multibody\"\n" + kFaces);
  EXPECT_FALSE(scenario.has_fe());
  EXPECT_TRUE(scenario.interfaces.empty());
}

TEST(Scenario, CoupledModeNeedsAnAttachedBody) {
  EXPECT_EQ(complaint(kRun),
            "s.toml:1:1: run.mode: expected at least one attached [[interfaces]] in mode "
            "\"coupled\", found none; write `mode = \"multibody\"` for the pedestrian alone");
}

TEST(Scenario, MistakesAreNamed) {
  EXPECT_THAT(complaint(std::string(kRun) + "mod = \"multibody\"\n" + kFaces),
              HasSubstr("s.toml:4:1: run.mod: unknown key; did you mean `mode`?"));
  EXPECT_THAT(complaint(std::string(kRun) + kFaces + kFaces),
              HasSubstr("interfaces[2].body: expected every body once, found \"hood\" again"));
  EXPECT_THAT(complaint(std::string(kRun) + kFaces + "[copling]\n"),
              HasSubstr("copling: unknown key; did you mean `coupling`?"));
}

TEST(Scenario, EveryProgramChecksItsOwnTablesOnly) {
  ConfigDocument document = ConfigDocument::from_text("[coupling]\na = 1\n[fe]\nb = 1\n", "s.toml");
  ignore_tables_of_others(document, "coupler");
  try {
    document.finish();
    FAIL() << "no error";
  } catch (const UserError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_THAT(error.what(), HasSubstr("coupling: unknown key"));
  }
  EXPECT_THAT(owned_tables("coupler"), testing::ElementsAre("coupling"));
}

}  // namespace
}  // namespace crosswalk
