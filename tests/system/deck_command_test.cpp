// `crosswalk check DECK` and `crosswalk solve DECK` as the user has them: sound decks run,
// malformed ones end in one clear report and exit code 2, within bounded time and memory.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/source_folder.h"
#include "tests/system/launched.h"

namespace crosswalk::system_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kPatience = 60;  // s; a busy machine is slow, none of this is long
#ifdef __SANITIZE_ADDRESS__
constexpr const char* kMemoryLimit = "unlimited";  // the sanitizer reserves far more
#else
constexpr const char* kMemoryLimit = "1500000";  // kB of address space
#endif

struct Outcome {
  int code = -1;
  std::string output;
};

class DeckCommand : public testing::Test {
 protected:
  fs::path file(const std::string& name, const std::string& text) {
    fs::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }
  /// Runs crosswalk under a limit of memory; a program that is killed has no exit code of its own.
  Outcome call(const std::vector<std::string>& arguments) {
    std::string line = std::string("ulimit -v ") + kMemoryLimit + "; exec " +
                       (build_folder() / "bin/crosswalk").string();
    for (const std::string& argument : arguments) line += " '" + argument + "'";
    Launched launched("/bin/sh", {"-c", line}, folder_.path() / "output.txt");
    const auto status = launched.wait(kPatience);
    Outcome outcome;
    outcome.output = launched.output();
    EXPECT_TRUE(status) << "still running:\n" << outcome.output;
    if (status && status->signal == 0) outcome.code = status->code;
    return outcome;
  }
  Outcome check(const fs::path& deck) { return call({"check", deck.string()}); }
  Outcome solve(const fs::path& deck, std::vector<std::string> options = {}) {
    std::vector<std::string> arguments{
        "solve", deck.string(), "--threads", "1", "--out", (folder_.path() / "results").string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return call(arguments);
  }
  /// Both commands must end with 2 and tell of `text`.
  void expect_refused(const fs::path& deck, const std::string& text) {
    for (const Outcome& outcome : {check(deck), solve(deck)}) {
      EXPECT_EQ(outcome.code, 2) << outcome.output;
      EXPECT_THAT(outcome.output, HasSubstr(text));
      EXPECT_LT(outcome.output.size(), 50000U);
    }
    EXPECT_FALSE(fs::exists(folder_.path() / "results/restart.bin"));
  }
  TemporaryFolder folder_;
};

const std::string kHead =
    "*KEYWORD\n$ crosswalk: unit_system=mm-kg-ms\n*CONTROL_TERMINATION\n      0.02\n";
const std::string kNodes =
    "*NODE\n"
    "       1             0.0             0.0             0.0\n"
    "       2            10.0             0.0             0.0\n"
    "       3            10.0            10.0             0.0\n"
    "       4             0.0            10.0             0.0\n"
    "       5             0.0             0.0            10.0\n"
    "       6            10.0             0.0            10.0\n"
    "       7            10.0            10.0            10.0\n"
    "       8             0.0            10.0            10.0\n";
const std::string kPart =
    "*PART\ncube\n         1         1         1\n*SECTION_SOLID\n         1         1\n"
    "*MAT_ELASTIC\n         1     7.8-6     210.0       0.3\n";
const std::string kElement =
    "*ELEMENT_SOLID\n       1       1       1       2       3       4       5       6       7      "
    " "
    "8\n";
const std::string kVelocity = "*INITIAL_VELOCITY_NODE\n         1       0.1\n";

std::string sound_deck() { return kHead + kNodes + kPart + kElement + kVelocity + "*END\n"; }

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(DeckCommand, ASoundDeckChecksAndRuns) {
  const fs::path deck = file("cube.k", sound_deck());
  const Outcome checked = check(deck);
  EXPECT_EQ(checked.code, 0) << checked.output;
  for (const char* text : {"nodes     8", "elements  1 hex8", "units     mm-kg-ms, stated",
                           "mass      0.0078 kg", "stable step", "The deck is sound"})
    EXPECT_THAT(checked.output, HasSubstr(text));
  const Outcome solved = solve(deck);
  EXPECT_EQ(solved.code, 0) << solved.output;
  EXPECT_THAT(solved.output, HasSubstr("energy balance"));
  EXPECT_TRUE(fs::exists(folder_.path() / "results/fields/fields.pvd"));
}

TEST_F(DeckCommand, EndTimeThreadsAndUnitsFromTheCommandLine) {
  const fs::path deck =
      file("cube.k", with(sound_deck(), "$ crosswalk: unit_system=mm-kg-ms\n", ""));
  const Outcome solved = solve(deck, {"--end-ms", "0.01", "--units", "mm-kg-ms"});
  EXPECT_EQ(solved.code, 0) << solved.output;
  EXPECT_THAT(solved.output, HasSubstr("end              0.01"));
  EXPECT_EQ(solve(deck, {"--units", "furlong-stone-s"}).code, 2);
  const Outcome doubted = call({"check", deck.string(), "--units", "m-kg-s"});
  EXPECT_THAT(doubted.output, HasSubstr("unit system: expected mm-kg-ms, as the numbers look"));
}

TEST_F(DeckCommand, WindowsFilesReadAlike) {
  std::string text;
  for (const char c : sound_deck()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(check(file("crlf.k", text)).code, 0);
  EXPECT_EQ(check(file("bom.k", "\xEF\xBB\xBF" + sound_deck())).code, 0);
  const std::string tabs =
      with(sound_deck(), "       1       1       1       2", "1,1\t,1,\t2,3,4,5,6,7,8\n$");
  EXPECT_EQ(check(file("tabs.k", tabs)).code, 0);
}

TEST_F(DeckCommand, IncludesAreFoundOnEverySearchPath) {
  const fs::path deck = file("deck/top.k", kHead + "*INCLUDE_PATH\n../nodes\n*INCLUDE\nnodes.k\n" +
                                               "*INCLUDE\nouter.k\n*INCLUDE\npart.k\n*END\n");
  file("nodes/nodes.k", kNodes);
  file("far/outer.k", "*INCLUDE\ninner.k\n" + kVelocity);
  file("farther/inner.k", kElement);
  file("deck/part.k", kPart);
  const Outcome lost = check(deck);
  EXPECT_EQ(lost.code, 2);
  EXPECT_THAT(lost.output, HasSubstr("top.k:10: outer.k"));
  const std::vector<std::string> paths{"--include-path", (folder_.path() / "far").string(),
                                       "--include-path", (folder_.path() / "farther").string()};
  std::vector<std::string> arguments{"check", deck.string()};
  arguments.insert(arguments.end(), paths.begin(), paths.end());
  const Outcome found = call(arguments);
  EXPECT_EQ(found.code, 0) << found.output;
  EXPECT_THAT(found.output, HasSubstr("elements  1 hex8"));
  EXPECT_EQ(solve(deck, paths).code, 0);
}

TEST_F(DeckCommand, EveryMissingIncludeAndCycleIsToldAtOnce) {
  file("b.k", "*INCLUDE\na.k\n*INCLUDE\ngone_1.k\n");
  const fs::path deck =
      file("a.k", sound_deck().substr(0, sound_deck().find("*END")) +
                      "*INCLUDE\nb.k\ngone_2.k\n*MAT_ELASTIC\n         2       abc\n");
  const Outcome outcome = check(deck);
  EXPECT_EQ(outcome.code, 2);
  for (const char* text : {"a cycle", "gone_1.k", "gone_2.k", "expected a number, found 'abc'"})
    EXPECT_THAT(outcome.output, HasSubstr(text));
  EXPECT_EQ(solve(deck).code, 2);
}

TEST_F(DeckCommand, AMissingDeckIsAUserError) {
  expect_refused(folder_.path() / "none.k", "no such file");
}

struct Malformed {
  const char* name;
  std::string text, report;
};

class MalformedDecks : public DeckCommand, public testing::WithParamInterface<Malformed> {};

TEST_P(MalformedDecks, EndInOneReport) {
  expect_refused(file("deck.k", GetParam().text), GetParam().report);
}

std::vector<Malformed> malformed_decks() {
  const std::string good = sound_deck();
  std::string garbage;
  for (int i = 0; i < 100000; ++i) garbage += static_cast<char>((i * 7919 + i / 13) % 256);
  return {
      {"Empty", "", "found no keyword"},
      {"AnotherText", "Dear reader,\nthis is a letter.\n", "expected a keyword that starts with *"},
      {"TruncatedCard", kHead + kNodes + "*SECTION_SHELL\n         1         2\n*END\n",
       "found the end of the keyword's cards"},
      {"LettersInNumbers", with(good, "210.0", "2x0.0"), "expected a number, found '2x0.0'"},
      {"NotANumber", with(good, "210.0", "  nan"), "expected a number, found 'nan'"},
      {"Infinite", with(good, "210.0", "  inf"), "expected a number, found 'inf'"},
      {"TooLargeANumber", with(good, "210.0", "1e999"), "expected a number, found '1e999'"},
      {"AbsurdModulus", with(good, "     210.0", "   1.0+308"), "finite mass and stable step"},
      {"HugeId", with(good, "         1     7.8-6", "9999999999     7.8-6"),
       "expected an integer, found '9999999999'"},
      {"NegativeId", with(good, "*ELEMENT_SOLID\n       1", "*ELEMENT_SOLID\n      -1"),
       "expected a positive number, found -1"},
      {"MissingNode", with(good, "7       8\n", "7      99\n"), "expected node 99"},
      {"MissingPart",
       with(good, "*ELEMENT_SOLID\n       1       1", "*ELEMENT_SOLID\n       1       5"),
       "expected part 5"},
      {"FlatElement",
       with(with(with(with(good, "0.0             0.0            10.0",
                           "0.0             0.0             0.0"),
                      "10.0             0.0            10.0",
                      "10.0             0.0             0.0"),
                 "10.0            10.0            10.0", "10.0            10.0             0.0"),
            "0.0            10.0            10.0", "0.0            10.0             0.0"),
       "its nodes lie in a plane"},
      {"InvertedElement",
       with(good, "1       2       3       4       5       6       7       8",
            "5       6       7       8       1       2       3       4"),
       "it is inside out"},
      {"DuplicateNode", with(good, "*PART\n", "*NODE\n       1             3.0\n*PART\n"),
       "expected one definition, found another one"},
      {"DuplicateElement",
       good.substr(0, good.find("*END")) + with(kElement, "7       8", "8       7"),
       "expected one definition, found another one"},
      {"BinaryGarbage", garbage, "binary data"},
      {"EndlessExpression",
       "*PARAMETER_EXPRESSION\nR A       " + std::string(3000, '(') + "\n" + good,
       "nested too deeply"},
      {"ParameterOfItself", "*PARAMETER_EXPRESSION\nR A       A+1\n" + good, "'A' is not defined"},
      {"NegativeCount", with(good, "*PART\n", "*SECTION_SHELL\n7,2,,-3,,,1\n1.0\n*PART\n"),
       "expected 0 .. 1000 points, found -3"},
      {"SetOfItself",
       with(good, "*PART\n",
            "*SET_NODE_ADD\n         1\n         1\n*BOUNDARY_SPC_SET\n         1         0        "
            " 1\n*PART\n"),
       "itself among the sets it adds"},
      {"MasslessBody",
       with(good, "*PART\n",
            "*PART\nghost\n         2         1         2\n*MAT_RIGID\n         2     7.8-6     "
            "210.0       0.3\n\n\n*PART\n"),
       "expected a mass above zero"},
      {"UnclearUnits",
       with(with(good, "$ crosswalk: unit_system=mm-kg-ms\n", ""), "7.8-6     210.0",
            "  1.0     1.0-2"),
       "unit system: expected one stated, found none"},
      {"NothingToRun", kHead + kNodes, "elements"},
  };
}

INSTANTIATE_TEST_SUITE_P(Each, MalformedDecks, testing::ValuesIn(malformed_decks()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_F(DeckCommand, ARangeOfAllNumbersIsNoBurden) {
  const std::string text =
      with(sound_deck(), "*PART\n",
           "*SET_NODE_LIST_GENERATE\n         1\n         12147483647\n*BOUNDARY_SPC_SET\n"
           "         1         0         1\n*PART\n");
  const Outcome outcome = solve(file("range.k", text));
  EXPECT_EQ(outcome.code, 0) << outcome.output;
}

TEST_F(DeckCommand, ALineOfAGigabyteIsStreamed) {
  const fs::path deck = file("huge.k", kHead + "*NODE\n");
  {
    std::ofstream out(deck, std::ios::binary | std::ios::app);
    const std::string piece(std::size_t{1} << 24, '7');
    for (int i = 0; i < 64; ++i) out << piece;
    if (!out.flush()) GTEST_SKIP() << "no room for a file of 1 GB";
  }
  const Outcome outcome = check(deck);
  fs::remove(deck);
  EXPECT_EQ(outcome.code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("expected at most 4096 characters"));
}

}  // namespace
}  // namespace crosswalk::system_test
