// Shell scripts stand in for the programs.
#include "launcher/supervisor.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

namespace crosswalk {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SupervisorTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("supervisor_test_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    out_ = open_memstream(&text_, &size_);
  }
  void TearDown() override {
    if (out_ != nullptr) std::fclose(out_);
    std::free(text_);
    fs::remove_all(folder_);
  }
  void add(const std::string& name, const std::string& script) {
    specs_.push_back(
        {name, "/bin/sh", {"-c", script}, folder_ / (name + ".log"), name == "coupler"});
  }
  Verdict run() {
    ProgressDisplay display(out_, ProgressDisplay::Style::Plain);
    Supervisor supervisor(specs_, display);
    const Verdict verdict = supervisor.run();
    std::fflush(out_);
    return verdict;
  }
  std::string output() const { return std::string(text_, size_); }

  fs::path folder_;
  std::vector<ProcessSpec> specs_;
  std::FILE* out_ = nullptr;
  char* text_ = nullptr;
  std::size_t size_ = 0;
};

TEST_F(SupervisorTest, AllDoneIsAGoodEnd) {
  add("coupler", "echo '@event info all joined'; echo '@progress 5 5 0 0'");
  add("mb_node", "exit 0");
  const Verdict verdict = run();
  EXPECT_EQ(verdict.code, ExitCode::Done);
  EXPECT_EQ(verdict.text, "");
  EXPECT_THAT(output(), HasSubstr("all joined\n"));
  EXPECT_THAT(output(), HasSubstr("5.00 ms of 5 ms  100 %"));
}

TEST_F(SupervisorTest, FailingNodeDecidesWithItsLastMessage) {
  add("coupler", "echo '@progress 12.5 200 0 0'; sleep 20 & trap 'kill $!; exit 130' TERM; wait");
  add("fe_node", "sleep 0.3; echo '[   12.520] [fe_node] error element 7 is inverted' >&2; exit 6");
  add("recorder", "sleep 20");
  const Verdict verdict = run();
  EXPECT_EQ(verdict.code, ExitCode::NumericalLimit);
  EXPECT_THAT(verdict.text,
              HasSubstr("fe_node failed at 12.50 ms (exit 6):\nelement 7 is inverted\nits log: "));
}

TEST_F(SupervisorTest, KilledNodeIsNamedWithItsSignal) {
  add("coupler", "sleep 20 & trap 'kill $!; exit 130' TERM; wait");
  add("mb_node", "kill -9 $$");
  const Verdict verdict = run();
  EXPECT_EQ(verdict.code, ExitCode::NodeFailed);
  EXPECT_THAT(verdict.text,
              HasSubstr("mb_node failed before the start (killed by signal 9 (Killed))"));
}

TEST_F(SupervisorTest, NodeThatFollowsTheCouplerOutIsNotTheCulprit) {
  add("coupler", "echo '[ 0.000] [coupler] error never joined: fe_node' >&2; sleep 0.3; exit 4");
  add("mb_node", "echo '[ 0.000] [mb_node] error the coupler ended the run: x' >&2; exit 3");
  const Verdict verdict = run();
  EXPECT_EQ(verdict.code, ExitCode::TimeOut);
  EXPECT_THAT(verdict.text, HasSubstr("coupler failed before the start (exit 4):\nnever joined"));
}

TEST_F(SupervisorTest, StubbornProcessesAreKilledAfterTheGrace) {
  add("coupler", "trap '' TERM; while :; do sleep 0.1; done");
  add("mb_node", "exit 2");
  EXPECT_EQ(run().code, ExitCode::UserError);
}

TEST_F(SupervisorTest, LastWordsAreTheWholeLastError) {
  std::ofstream(folder_ / "a.log") << "[ 1.000] [fe_node] info start\n"
                                      "[ 1.000] [fe_node] error a.toml:1:1: one\n"
                                      "a.toml:2:1: two\n"
                                      "[ 1.000] [fe_node] info end\n";
  EXPECT_EQ(last_words(folder_ / "a.log"), "a.toml:1:1: one\na.toml:2:1: two");
  std::ofstream(folder_ / "b.log") << "[ 1.000] [fe_node] info start\nSegmentation fault\n";
  EXPECT_EQ(last_words(folder_ / "b.log"), "start\nSegmentation fault");
  EXPECT_EQ(last_words(folder_ / "none.log"), "");
}

TEST_F(SupervisorTest, ProgramThatCannotBeStartedIsAUserError) {
  specs_.push_back({"coupler", folder_ / "none", {}, folder_ / "c.log", true});
  EXPECT_THROW(run(), UserError);
}

TEST(ProcessSpecText, IsGoodForAShell) {
  const ProcessSpec spec{"a", "/bin/echo", {"plain", "two words", "it's", ""}, {}, false};
  EXPECT_EQ(spec.command_text(), R"(/bin/echo plain 'two words' 'it'\''s' '')");
}

}  // namespace
}  // namespace crosswalk
