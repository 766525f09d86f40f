#include "common/node_main.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/protocol.h"

namespace crosswalk {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class NodeMain : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("node_main_test_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write(
        "[run]\nname = \"t\"\nduration_ms = 5\nmode = \"multibody\"\n[coupling]\nwindow_us = 20\n");
    program_.name = "coupler";
    program_.purpose = "test";
    program_.read = [](ConfigDocument& document, const Scenario&) {
      document.root()
          .table("coupling", "Coupling.")
          .quantity("window", Dimension::Time, {1e-6, 1e-4}, "Window length.");
    };
    program_.run = [this](RunContext& context) {
      seen_run_id_ = context.run_id;
      seen_url_ = context.url;
      seen_threads_ = context.threads;
      program_.read(context.document, context.scenario);
      context.document.finish();
      return action_ ? action_() : ExitCode::Done;
    };
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& text) { std::ofstream(folder_ / "s.toml") << text; }
  int call(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "coupler");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const int code = node_main(static_cast<int>(argv.size()), argv.data(), program_);
    stdout_ = testing::internal::GetCapturedStdout();
    stderr_ = testing::internal::GetCapturedStderr();
    return code;
  }
  int run() {
    return call({"run", "--scenario", (folder_ / "s.toml").string(), "--run-id", "abc", "--out",
                 (folder_ / "out").string(), "--threads", "2"});
  }

  fs::path folder_;
  NodeProgram program_;
  std::function<ExitCode()> action_;
  std::string seen_run_id_, seen_url_, stdout_, stderr_;
  int seen_threads_ = 0;
};

TEST_F(NodeMain, RunGivesTheContextAndLeavesProvenanceAndLog) {
  EXPECT_EQ(run(), 0) << stderr_;
  EXPECT_EQ(seen_run_id_, "abc");
  EXPECT_EQ(seen_url_, default_lcm_url("abc"));
  EXPECT_EQ(seen_threads_, 2);
  EXPECT_TRUE(fs::exists(folder_ / "out/logs/coupler.log"));
  std::ostringstream provenance;
  provenance << std::ifstream(folder_ / "out/provenance.json").rdbuf();
  EXPECT_THAT(provenance.str(), HasSubstr("\"run_id\": \"abc\""));
  EXPECT_THAT(provenance.str(), HasSubstr("\"processor\""));
}

TEST_F(NodeMain, ExceptionsBecomeExitCodesWithOneMessage) {
  const auto code_of = [&](std::function<ExitCode()> action) {
    action_ = std::move(action);
    return run();
  };
  EXPECT_EQ(code_of([]() -> ExitCode { throw NumericalError(0.0234, "element 7"); }), 6);
  EXPECT_THAT(stderr_, HasSubstr("coupler stopped at t = 23.400 ms: element 7"));
  EXPECT_EQ(code_of([]() -> ExitCode { throw ProtocolError(ExitCode::RoleTaken, "taken"); }), 13);
  EXPECT_THAT(stderr_, HasSubstr("taken"));
  EXPECT_EQ(code_of([]() -> ExitCode { throw std::logic_error("oops"); }), 70);
  EXPECT_THAT(stderr_, HasSubstr("this is a bug"));
  EXPECT_EQ(code_of([] { return ExitCode::TimeOut; }), 4);
}

TEST_F(NodeMain, CheckReportsMistakesOfOwnAndSharedTables) {
  EXPECT_EQ(call({"check", (folder_ / "s.toml").string()}), 0) << stderr_;
  write("[run]\nname = 1\nduration_ms = 5\nmode = \"multibody\"\n[coupling]\nwindow_ms = 20\n");
  EXPECT_EQ(call({"check", (folder_ / "s.toml").string()}), 2);
  EXPECT_THAT(stderr_, HasSubstr("s.toml:2:8: run.name: expected text in quotes, found 1"));
  EXPECT_THAT(stderr_, HasSubstr("expected 0.001 .. 0.1 ms, found 20; is the value in us? write "
                                 "`window_us`"));
}

TEST_F(NodeMain, OtherFilesGoToTheProgram) {
  fs::path seen;
  bool is_strict = false;
  program_.check_file = [&](CLI::App& options) {
    options.add_flag("--strict", is_strict);
    return [&](const fs::path& file) {
      seen = file;
      return is_strict ? ExitCode::UserError : ExitCode::Done;
    };
  };
  EXPECT_EQ(call({"check", "head.k"}), 0);
  EXPECT_EQ(seen, "head.k");
  EXPECT_EQ(call({"check", "--strict", "head.k"}), 2);
}

TEST_F(NodeMain, KeysPrintTheReference) {
  EXPECT_EQ(call({"keys"}), 0);
  EXPECT_THAT(stdout_, HasSubstr("| `coupling.window` | _s, _ms, _us or _ns |"));
}

TEST_F(NodeMain, UsageErrorsExitWithTwo) {
  EXPECT_EQ(call({"run"}), 2);
  EXPECT_EQ(call({"frobnicate"}), 2);
  EXPECT_EQ(call({"run", "--scenario", (folder_ / "none.toml").string(), "--run-id", "x", "--out",
                  (folder_ / "out").string()}),
            2);
  EXPECT_THAT(stderr_, HasSubstr("none.toml"));
  EXPECT_EQ(call({"--help"}), 0);
}

TEST_F(NodeMain, UsageErrorsAreAnObjectWithJson) {
  EXPECT_EQ(call({"run", "--json"}), 2);
  EXPECT_THAT(stdout_, HasSubstr("\"error\": \"usage\""));
  EXPECT_EQ(call({"--help", "--json"}), 0);
}

TEST_F(NodeMain, FurtherCommandsParseTheirOptions) {
  int value = 0;
  program_.commands.push_back({"solve", "Solves.", [&](CLI::App& options) {
                                 options.add_option("--value", value, "A value");
                                 return [] { return ExitCode::NumericalLimit; };
                               }});
  EXPECT_EQ(call({"solve", "--value", "3"}), 6);
  EXPECT_EQ(value, 3);
}

}  // namespace
}  // namespace crosswalk
