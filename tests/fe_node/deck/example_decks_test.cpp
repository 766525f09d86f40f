// Third-party example decks, read from the folder that CROSSWALK_DECKS names; skipped without it.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "fe_node/deck/deck_report.h"
#include "fe_node/deck/deck_writer.h"
#include "fe_node/deck/units_guess.h"
#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

namespace fs = std::filesystem;

/// A count of lines that knows nothing of the reader: data lines below *NODE, shells of one or two
/// lines, solids of one or two, *MAT keywords.
struct PlainCount {
  long nodes = 0, shells = 0, solids = 0, materials = 0;

  void add_file(const fs::path& file) {
    std::ifstream in(file);
    std::string keyword;
    long row = 0, solid_rows = 1;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with('$')) continue;
      if (line.starts_with('*')) {
        keyword = line.substr(1, line.find_first_of(" \r+") - 1);
        row = 0;
        if (keyword == "END") return;
        if (keyword.starts_with("MAT_") && !keyword.starts_with("MAT_ADD")) ++materials;
        continue;
      }
      const bool is_blank = line.find_first_not_of(" \t\r") == std::string::npos;
      if (is_blank) continue;
      ++row;
      std::istringstream fields(line);
      const long count = std::distance(std::istream_iterator<std::string>(fields), {});
      if (row == 1) solid_rows = count <= 2 ? 2 : 1;
      if (keyword == "NODE") ++nodes;
      if (keyword == "ELEMENT_SHELL") ++shells;
      if (keyword == "ELEMENT_SHELL_THICKNESS" && row % 2 == 1) ++shells;
      if (keyword == "ELEMENT_SOLID" && row % solid_rows == 0) ++solids;
    }
  }
};

class ExampleDecks : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("CROSSWALK_DECKS");
    if (folder == nullptr || !fs::is_directory(folder))
      GTEST_SKIP() << "CROSSWALK_DECKS names no folder";
    folder_ = folder;
  }
  /// The deck of that name, or a skip when this collection lacks it.
  fs::path deck(const std::string& name) { return folder_ / name; }
  fs::path folder_;
};

TEST_F(ExampleDecks, BallAndPlateIsWhollyReadable) {
  if (!fs::exists(deck("pydyna-mit/ball_plate.k"))) GTEST_SKIP();
  ReadDeck read = read_deck(deck("pydyna-mit/ball_plate.k"));
  const DeckReport report = report_deck(read, "ball_plate.k");
  EXPECT_TRUE(report.is_sound) << report.text;
  EXPECT_EQ(read.deck.nodes.size(), 1940U);
  EXPECT_EQ(read.deck.solids.size(), 1512U);
  EXPECT_EQ(read.deck.shells.size(), 256U);
  EXPECT_EQ(guess_units(read.deck).system, UnitSystem::MmKgMs);
  EXPECT_TRUE(std::holds_alternative<mat::Rigid>(read.deck.materials[1].law));
  EXPECT_DOUBLE_EQ(*read.deck.control.end_time, 10);
}

TEST_F(ExampleDecks, TheSimpleCarIsWhollyReadable) {
  if (!fs::exists(deck("simple-car-gpl3/main_v223.k"))) GTEST_SKIP();
  ReadDeck read = read_deck(deck("simple-car-gpl3/main_v223.k"));
  const DeckReport report = report_deck(read, "main_v223.k");
  EXPECT_TRUE(report.is_sound) << report.text;
  EXPECT_EQ(read.deck.nodes.size(), 2378U);
  EXPECT_EQ(read.deck.shells.size(), 2424U);
  EXPECT_EQ(read.deck.parts.size(), 7U);
  EXPECT_EQ(read.deck.node_ties.size(), 3U);
  EXPECT_EQ(read.deck.rigid_walls.size(), 2U);
  EXPECT_EQ(guess_units(read.deck).system, UnitSystem::MmTonneS);
  EXPECT_DOUBLE_EQ(std::get<SectionShell>(read.deck.sections[1].law).thickness[0], 3);
}

TEST_F(ExampleDecks, TheHumanBodyModelListsItsMissingFiles) {
  const fs::path path = deck("vivaplus-0.3.3/50M-standing/vivaplus-50M-standing.key");
  if (!fs::exists(path)) GTEST_SKIP();
  ReadDeck read = read_deck(path);
  const DeckReport report = report_deck(read, "viva");
  EXPECT_FALSE(report.is_sound);
  EXPECT_EQ(read.deck.missing_includes.size(), 8U);
  EXPECT_TRUE(read.problems.errors.empty()) << report.text;
  for (const UnreadKeyword& unread : read.deck.unread)
    EXPECT_NE(unread.effect, Effect::Physics) << unread.keyword;
  EXPECT_EQ(read.deck.joints.size(), 40U);
}

TEST_F(ExampleDecks, NeckMusclesAreCounted) {
  const fs::path path = deck("vivaplus-0.3.3/common/vivaplus-22-Neck-Muscles.k");
  if (!fs::exists(path)) GTEST_SKIP();
  const ReadDeck read = read_deck(path);
  EXPECT_EQ(read.deck.parts.size(), 252U);
  EXPECT_EQ(std::count_if(read.deck.parts.begin(), read.deck.parts.end(),
                          [](const Part& part) { return part.is_averaged; }),
            56);
  EXPECT_EQ(read.deck.materials.size(), 126U);
  EXPECT_EQ(read.deck.sections.size(), 252U);
}

TEST_F(ExampleDecks, TheBeltedDummyLacksItsSections) {
  const fs::path path = deck("pydyna-mit/belted_dummy.k");
  if (!fs::exists(path)) GTEST_SKIP();
  ReadDeck read = read_deck(path);
  const DeckReport report = report_deck(read, "belted_dummy.k");
  EXPECT_FALSE(report.is_sound);
  EXPECT_EQ(read.deck.discretes.size(), 108U);
  EXPECT_EQ(read.deck.curves.size(), 49U);
  EXPECT_EQ(read.deck.segment_sets.size(), 22U);
  EXPECT_EQ(read.problems.errors.total(), 2 * 130) << report.text;
}

TEST_F(ExampleDecks, AnIncludeTreeNeedsItsSearchPath) {
  const fs::path path = deck("pydyna-mit/include_tree/bird_B.k");
  if (!fs::exists(path)) GTEST_SKIP();
  EXPECT_EQ(read_deck(path).deck.missing_includes.size(), 1U);
  const ReadDeck read = read_deck(path, {.include_paths = {path.parent_path() / "fol"}});
  EXPECT_TRUE(read.deck.missing_includes.empty());
  EXPECT_EQ(read.deck.nodes.size(), 1781U);
  EXPECT_EQ(read.deck.solids.size(), 729U);
}

TEST_F(ExampleDecks, CountsAgreeWithAPlainCountOfLines) {
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    if (entry.path().extension() != ".k" && entry.path().extension() != ".key") continue;
    const ReadDeck read = read_deck(entry.path());
    PlainCount plain;
    for (const std::string& file : read.deck.files.names) plain.add_file(file);
    EXPECT_EQ(static_cast<long>(read.deck.nodes.size()), plain.nodes) << entry.path();
    EXPECT_EQ(static_cast<long>(read.deck.shells.size()), plain.shells) << entry.path();
    EXPECT_EQ(static_cast<long>(read.deck.solids.size()), plain.solids) << entry.path();
    EXPECT_EQ(static_cast<long>(read.deck.materials.size()), plain.materials) << entry.path();
  }
}

TEST_F(ExampleDecks, EveryOneReadsReportsAndReadsBackEqual) {
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    if (entry.path().extension() != ".k" && entry.path().extension() != ".key") continue;
    ReadDeck read = read_deck(entry.path());
    const Deck original = read.deck;
    EXPECT_FALSE(report_deck(read, entry.path().string()).text.empty());
    ReadDeck again = read_text(deck_text(original));
    again.deck.missing_includes = original.missing_includes;
    EXPECT_EQ(again.deck, original) << entry.path();
  }
}

}  // namespace
}  // namespace crosswalk::fe
