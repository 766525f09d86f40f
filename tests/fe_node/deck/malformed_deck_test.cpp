// Whatever a file holds, reading it ends in a bounded, clear report.
#include <filesystem>
#include <fstream>
#include <random>

#include <unistd.h>

#include "fe_node/deck/deck_report.h"
#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

TEST(MalformedDeck, AnEmptyFileIsNoDeck) {
  EXPECT_EQ(errors_of(""), "test.k: file: expected a keyword deck, found no keyword\n");
}

TEST(MalformedDeck, AnotherKindOfTextIsToldOnce) {
  EXPECT_EQ(errors_of("hello\nworld\n"),
            "test.k:1: line: expected a keyword that starts with * in column 1, found 'hello'\n");
}

TEST(MalformedDeck, BinaryGarbageIsLeftAtOnce) {
  std::mt19937 engine(7);
  std::string garbage(100000, ' ');
  for (char& c : garbage) c = static_cast<char>(engine() % 256);
  garbage[500] = '\0';
  const ReadDeck read = read_text(garbage);
  EXPECT_FALSE(read.problems.errors.empty());
  EXPECT_LE(read.problems.errors.kept().size(), std::size_t{ProblemList::kKept});
}

TEST(MalformedDeck, LettersInNumberFields) {
  EXPECT_EQ(
      errors_of("*NODE\n       1             abc             0.0             0.0\n       x\n"),
      "test.k:2:22: *NODE card 1 field 2 (X): expected a number, found 'abc'\n"
      "test.k:3:8: *NODE card 1 field 1 (NID): expected an integer, found 'x'\n");
}

TEST(MalformedDeck, TruncatedCards) {
  EXPECT_EQ(
      errors_of(
          "*MAT_PLASTIC_KINEMATIC\n         1     7.8-6     210.0       0.3       0.2\n*END\n"),
      "test.k:2: *MAT_PLASTIC_KINEMATIC card 2: expected another line, found the end of the "
      "keyword's cards\n");
}

TEST(MalformedDeck, ProblemsAreCappedAndCounted) {
  std::string text = "*NODE\n";
  for (int i = 0; i < 1000; ++i) text += "       x\n";
  const ReadDeck read = read_text(text);
  EXPECT_EQ(read.problems.errors.total(), 1000);
  const std::vector<Problem> summary = read.problems.errors.summary();
  EXPECT_EQ(summary.size(), static_cast<std::size_t>(ProblemList::kPerSubject) + 1);
  EXPECT_EQ(summary.back().text(), "992 more problems are not listed; in all 1000 *NODE");
}

TEST(MalformedDeck, AnOverlongLineIsCutAndTold) {
  const std::string text =
      "*NODE\n       1" + std::string(100000, '1') + "\n       2             5.0\n";
  const ReadDeck read = read_text(text);
  EXPECT_THAT(all_problems(read.problems), testing::HasSubstr("expected at most 4096 characters"));
  EXPECT_DOUBLE_EQ(read.deck.nodes.back().position.x(), 5);
}

TEST(MalformedDeck, ALongCommentIsNoProblem) {
  EXPECT_EQ(errors_of("*NODE\n$" + std::string(1000000, 'x') + "\n       1\n"), "");
}

/// A line of a megabyte stands for the gigabyte: the reader keeps 4096 characters of it either way.
TEST(MalformedDeck, AHugeLineFromAFileIsStreamed) {
  namespace fs = std::filesystem;
  const fs::path path =
      fs::temp_directory_path() / ("cw_huge_" + std::to_string(::getpid()) + ".k");
  {
    std::ofstream out(path, std::ios::binary);
    out << "*NODE\n";
    const std::string piece(1 << 16, '7');
    for (int i = 0; i < 16; ++i) out << piece;
  }
  const DeckReport report = report_deck(path);
  fs::remove(path);
  EXPECT_FALSE(report.is_sound);
  EXPECT_THAT(report.text, testing::HasSubstr("expected at most 4096 characters"));
}

TEST(MalformedDeck, AByteOrderMarkIsNoText) {
  EXPECT_EQ(errors_of("\xEF\xBB\xBF*NODE\n       1\n"), "");
  EXPECT_NE(errors_of("*NODE\n\xEF\xBB\xBF       1\n"), "");
}

TEST(MalformedDeck, CoordinatesOutOfRangeAreRefused) {
  ReadDeck read = read_text("*NODE\n1,1e13\n2,-1.0+20,0.\n3,1e11\n");
  EXPECT_FALSE(report_deck(read, "far.k").is_sound);
  EXPECT_EQ(read.problems.errors.total(), 2);
}

TEST(MalformedDeck, BlankLinesWithoutEnd) {
  EXPECT_EQ(errors_of("*MAT_ELASTIC\n         1     7.8-6     210.0       0.3\n" +
                      std::string(100000, '\n')),
            "");
}

TEST(MalformedDeck, AKeywordOfOneStar) {
  const ReadDeck read = read_text("*\n*_\n**\n*+\n* NODE\n");
  EXPECT_EQ(read.deck.unread.size(), 4U);
}

TEST(MalformedDeck, CountsThatDoNotFitAreErrors) {
  EXPECT_THAT(errors_of("*SECTION_SHELL\n         1         2          2000000000                  "
                        "           1\n       1.0\n"),
              testing::HasSubstr("expected 0 .. 1000 points"));
}

TEST(MalformedDeck, RandomCutsOfASoundDeckNeverCrash) {
  const std::string sound_text =
      "*KEYWORD\n*PARAMETER\nR A 1.0\n*NODE\n       1             0.0             0.0             "
      "0.0\n"
      "*PART_INERTIA\nbody\n         1         1         1\n       0.0       0.0       0.0       "
      "4.5\n"
      "       1.0\n\n*CONTACT_TIED_NODES_TO_SURFACE_ID\n         1name\n         1         2       "
      "  4         3\n"
      "\n\n*DEFINE_TABLE\n         1\n       1.0\n*DEFINE_CURVE\n         "
      "2\n0,0\n1,1\n*ELEMENT_SOLID\n"
      "       1       1\n       1       2       3       4       5       6       7       8\n*END\n";
  std::mt19937 engine(11);
  for (int i = 0; i < 2000; ++i) {
    std::string text = sound_text.substr(0, engine() % sound_text.size());
    for (int k = 0; k < 3 && !text.empty(); ++k)
      text[engine() % text.size()] = static_cast<char>(32 + engine() % 95);
    ReadDeck read = read_text(text);
    EXPECT_FALSE(report_deck(read, "cut.k").text.empty());
  }
}

}  // namespace
}  // namespace crosswalk::fe
