#include "fe_node/deck/deck_writer.h"

#include <fmt/format.h>

#include "fe_node/deck/keyword_table.h"
#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

/// Cards of distinct numbers in the columns of that keyword.
std::string numbered_cards(const std::string& keyword) {
  const bool is_element = keyword.starts_with("NODE") || keyword.starts_with("ELEMENT");
  std::string text = "*" + keyword + "\n";
  if (keyword.starts_with("PART")) text += "a title\n";
  if (keyword.starts_with("DEFINE_TABLE") || keyword.starts_with("EOS_TABULATED")) {
    if (keyword.ends_with("TITLE")) text += "a title\n";
    for (int row = 1; row < 10; ++row) text += fmt::format("{},{}\n", row, row + 1);
    return text;
  }
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 8; ++column) {
      const std::string number =
          column < 4 ? std::to_string(1 + row + column) : fmt::format("{}", 4.0 + column);
      text += fmt::format("{:>{}}", number, is_element ? 8 : 10);
    }
    text += '\n';
  }
  return text;
}

std::vector<std::string> all_keywords() {
  std::vector<std::string> out;
  for (const auto entries :
       {mesh_keywords(), part_keywords(), material_keywords(), table_keywords(), set_keywords(),
        condition_keywords(), constraint_keywords(), control_keywords()})
    for (const KeywordEntry& entry : entries) {
      out.emplace_back(entry.base);
      for (const std::string_view option : entry.options)
        out.push_back(fmt::format("{}_{}", entry.base, option));
    }
  for (const char* contact : {"AUTOMATIC_SINGLE_SURFACE_ID", "ERODING_NODES_TO_SURFACE",
                              "TIED_SURFACE_TO_SURFACE_OFFSET", "FORCE_TRANSDUCER_PENALTY_MPP"})
    out.push_back(std::string("CONTACT_") + contact);
  out.emplace_back("DATABASE_GLSTAT");
  out.emplace_back("NOT_A_KEYWORD");
  return out;
}

TEST(DeckWriter, CardsOfAKeywordWithoutANameStayItsOwn) {
  const Deck deck = read_text("*NODE\n1,0,0,0\n*\n3,4\n").deck;
  EXPECT_EQ(read_text(deck_text(deck)).deck, deck);
}

TEST(DeckWriter, TheFirstKeywordIsNeverOneToKeep) {
  for (const char* text : {"*KEYWORD%\n*NODE\n1,0,0,0\n", "*KEYWORD +\n*NODE\n1,0,0,0\n"}) {
    const Deck deck = read_text(text).deck;
    EXPECT_TRUE(deck.unread.empty());
    EXPECT_EQ(read_text(deck_text(deck)).deck, deck);
  }
}

TEST(DeckWriter, EveryKeywordReadsBackEqual) {
  for (const std::string& keyword : all_keywords()) {
    const Deck deck = read_text(numbered_cards(keyword)).deck;
    EXPECT_NE(deck, Deck{}) << keyword << " left nothing";
    const std::string text = deck_text(deck);
    const ReadDeck again = read_text(text);
    EXPECT_EQ(again.deck, deck) << keyword << '\n' << text;
    EXPECT_EQ(all_problems(again.problems), "") << keyword << '\n' << text;
  }
}

TEST(DeckWriter, GeneratedRecordsReadBackEqual) {
  Deck deck;
  deck.title = "a head";
  deck.units = UnitSystem::MmKgMs;
  deck.nodes.emplace_back().id = DeckId(1);
  deck.nodes.back().position = {1.5, -2.25, 1e-3};
  SolidElement& solid = deck.solids.emplace_back();
  solid.id = DeckId(1);
  solid.part = DeckId(2);
  for (int i = 0; i < 10; ++i) solid.nodes[static_cast<std::size_t>(i)] = DeckId(i + 1);
  Part& part = deck.parts.emplace_back();
  part.id = DeckId(2);
  part.title = "brain, left";
  Material& brain = deck.materials.emplace_back();
  brain.id = DeckId(1);
  brain.title = "brain";
  brain.density = 1.04e-6;
  brain.law =
      mat::Viscoelastic{.bulk = 2.19, .shear_short = 6e-6, .shear_long = 1.2e-6, .decay = 0.08};
  DeckCurve& curve = deck.curves.emplace_back();
  curve.id = DeckId(3);
  curve.points = {{0, 0}, {1, 1.0 / 3}};
  deck.contacts.push_back(contact_named("AUTOMATIC_SURFACE_TO_SURFACE"));
  const ReadDeck again = read_text(deck_text(deck));
  EXPECT_EQ(all_problems(again.problems), "");
  EXPECT_EQ(again.deck, deck);
}

TEST(DeckWriter, NumbersThatDoNotFitTurnTheBlockLong) {
  Deck deck;
  Material& material = deck.materials.emplace_back();
  material.density = 1.0 / 3 * 1e-6;
  material.law = mat::Rigid{};
  const std::string text = deck_text(deck);
  EXPECT_THAT(text, testing::HasSubstr("*MAT_RIGID +\n"));
  const Deck again = sound(text);
  EXPECT_NEAR(again.materials[0].density, deck.materials[0].density,
              CardWriter::kWrittenPrecision * deck.materials[0].density);
}

TEST(DeckWriter, FieldsAreNamedAboveTheirColumns) {
  Deck deck;
  deck.nodes.emplace_back().id = DeckId(7);
  deck.nodes.back().position = {1, 2, 3};
  EXPECT_EQ(deck_text(deck),
            "*KEYWORD\n"
            "*NODE\n"
            "$#   nid               x               y               z      tc      rc\n"
            "       7             1.0             2.0             3.0       0       0\n"
            "*END\n");
}

TEST(DeckWriter, AnUnwritablePathIsAUserError) {
  EXPECT_THROW(write_deck(std::filesystem::path("/nowhere/at/all.k"), Deck{}), UserError);
}

}  // namespace
}  // namespace crosswalk::fe
