#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "fe_node/deck/runnable.h"
#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

namespace fs = std::filesystem;

/// A folder with deck files that is gone after the test.
class IncludeTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("cw_deck_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  fs::path folder_;
};

TEST_F(IncludeTest, NestedFilesAreReadInPlace) {
  file("sub/inner.k", "*NODE\n       2\n*END\n*NODE\n      99\n");
  file("outer.k", "*NODE\n       1\n*INCLUDE\nsub/inner.k\n*NODE\n       3\n");
  const ReadDeck read = read_deck(file("top.k", "*INCLUDE\nouter.k\n*NODE\n       4\n*END\n"));
  EXPECT_EQ(all_problems(read.problems), "");
  std::vector<int> ids;
  for (const DeckNode& node : read.deck.nodes) ids.push_back(node.id.value);
  EXPECT_EQ(ids, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(read.deck.files.names.size(), 3U);
  EXPECT_TRUE(read.deck.place(read.deck.nodes[1].source).file.ends_with("inner.k"));
}

TEST_F(IncludeTest, SearchPathsFromTheDeckAndFromTheCaller) {
  file("common/part.k", "*NODE\n       1\n");
  file("far/mesh.k", "*NODE\n       2\n");
  const fs::path top =
      file("deck/top.k", "*INCLUDE_PATH\n..\\common\\\n*INCLUDE\npart.k\nmesh.k\n");
  const ReadDeck alone = read_deck(top);
  EXPECT_EQ(alone.deck.nodes.size(), 1U);
  ASSERT_EQ(alone.deck.missing_includes.size(), 1U);
  EXPECT_EQ(alone.deck.missing_includes[0].name, "mesh.k");
  EXPECT_EQ(alone.deck.missing_includes[0].source.line, 5);
  const ReadDeck helped = read_deck(top, {.include_paths = {folder_ / "far"}});
  EXPECT_EQ(helped.deck.nodes.size(), 2U);
  EXPECT_TRUE(helped.deck.missing_includes.empty());
}

TEST_F(IncludeTest, AllMissingFilesAreListed) {
  const ReadDeck read = read_deck(file("top.k", "*INCLUDE\na.k\n*INCLUDE\nb.k\n*NODE\n       1\n"));
  EXPECT_EQ(read.deck.missing_includes.size(), 2U);
  EXPECT_EQ(read.deck.nodes.size(), 1U);
  try {
    ReadDeck again = read_deck(folder_ / "top.k");
    require_runnable(again, MissingPolicy::Refuse);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.problems().size(), 2U);
  }
}

TEST_F(IncludeTest, CyclesAreRefused) {
  file("b.k", "*NODE\n       2\n*INCLUDE\na.k\n");
  const ReadDeck read = read_deck(file("a.k", "*NODE\n       1\n*INCLUDE\nb.k\n"));
  EXPECT_EQ(read.deck.nodes.size(), 2U);
  ASSERT_EQ(read.problems.errors.total(), 1);
  EXPECT_THAT(read.problems.errors.kept()[0].text(),
              testing::HasSubstr("b.k:4: *INCLUDE: found a cycle"));
}

TEST_F(IncludeTest, OneFileMayBeIncludedTwice) {
  file("curve.k", "*NODE\n       1\n");
  const ReadDeck read = read_deck(file("top.k", "*INCLUDE\ncurve.k\ncurve.k\n"));
  EXPECT_EQ(all_problems(read.problems), "");
  EXPECT_EQ(read.deck.nodes.size(), 2U);
}

TEST_F(IncludeTest, LocalParametersStayInTheirFileAndBelow) {
  file("below.k", "*SECTION_SOLID\n         3      &LOC\n");
  file("a.k", "*PARAMETER_LOCAL\nRloc,13\n*INCLUDE\nbelow.k\n*PARAMETER\nRshared,1\n");
  file("b.k", "*SECTION_SOLID\n         1      &LOC\n*SECTION_SOLID\n         2   &SHARED\n");
  const ReadDeck read = read_deck(file("top.k", "*INCLUDE\na.k\n*INCLUDE\nb.k\n"));
  ASSERT_EQ(read.problems.errors.total(), 1);
  EXPECT_THAT(read.problems.errors.kept()[0].text(), testing::HasSubstr("b.k:2:17"));
  EXPECT_EQ(std::get<SectionSolid>(read.deck.sections[0].law).formulation, 13);
  EXPECT_EQ(std::get<SectionSolid>(read.deck.sections[2].law).formulation, 1);
}

TEST_F(IncludeTest, LongNamesContinueOnTheNextLine) {
  file("a_long_folder_name/file.k", "*NODE\n       1\n");
  const ReadDeck read = read_deck(file("top.k", "*INCLUDE\na_long_folder +\n_name/file.k\n"));
  EXPECT_EQ(read.deck.nodes.size(), 1U);
}

TEST_F(IncludeTest, TheLongFormatOfAFileEndsWithIt) {
  file("long.k", "*KEYWORD LONG=Y\n*SET_NODE\n                   1\n                   5\n");
  const ReadDeck read =
      read_deck(file("top.k", "*INCLUDE\nlong.k\n*SET_NODE\n         2\n         6\n"));
  EXPECT_EQ(read.deck.sets[0].ids, std::vector<DeckId>{DeckId(5)});
  EXPECT_EQ(read.deck.sets[1].ids, std::vector<DeckId>{DeckId(6)});
}

TEST_F(IncludeTest, AMissingDeckIsOneError) {
  const ReadDeck read = read_deck(folder_ / "none.k");
  ASSERT_EQ(read.problems.errors.total(), 1);
  EXPECT_THAT(read.problems.errors.kept()[0].text(), testing::HasSubstr("no such file"));
}

TEST_F(IncludeTest, AFolderIsNotADeck) { EXPECT_EQ(read_deck(folder_).problems.errors.total(), 1); }

}  // namespace
}  // namespace crosswalk::fe
