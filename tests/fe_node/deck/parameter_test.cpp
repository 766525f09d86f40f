#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

const SectionShell& shell(const Deck& deck, std::size_t i = 0) {
  return std::get<SectionShell>(deck.sections.at(i).law);
}

TEST(DeckParameter, FillsFieldsOfAnyWidth) {
  const Deck deck = sound(
      "*PARAMETER\n"
      "r  tbumper         3I  NPOINTS         5R     EMOD     210.0\n"
      "*SECTION_SHELL\n"
      "         2         2       1.0  &npoints\n"
      "  &tbumper  &TBUMPER&tbumper  &tbumper\n"
      "*MAT_ELASTIC\n"
      "         1   7.83E-6     &emod       0.3\n");
  EXPECT_EQ(shell(deck).points, 5);
  EXPECT_DOUBLE_EQ(shell(deck).thickness[3], 3);
  EXPECT_DOUBLE_EQ(std::get<mat::Elastic>(deck.materials[0].law).youngs, 210);
}

TEST(DeckParameter, MayTouchTheFieldBefore) {
  // A ten-character id directly followed by a parameter, as real decks have it.
  const Deck deck = sound(
      "*PARAMETER\nRTX_DENS    1.1e-6\n"
      "*MAT_VISCOELASTIC\n    405100&TX_DENS       2.0     0.001    0.0005      0.08\n");
  EXPECT_EQ(deck.materials[0].id, DeckId(405100));
  EXPECT_DOUBLE_EQ(deck.materials[0].density, 1.1e-6);
}

TEST(DeckParameter, CanBeNegated) {
  const Deck deck = sound(
      "*PARAMETER\nR V,10.0\n*INITIAL_VELOCITY_NODE\n         1       0.0       0.0       -&v\n");
  EXPECT_DOUBLE_EQ(deck.nodal_velocities[0].velocity.z(), -10);
}

TEST(DeckParameter, ExpressionsUseEarlierOnes) {
  const Deck deck = sound(
      "*PARAMETER\nR      SEX       1.0\n"
      "*PARAMETER_EXPRESSION\n"
      "RLX_QuadL0364.2+SEX*49.\n"
      "R     HALF LX_QuadL0\n"
      "          /2\n"
      "*SECTION_SHELL\n         1\n     &HALF\n");
  EXPECT_DOUBLE_EQ(shell(deck).thickness[0], 206.6);
}

TEST(DeckParameter, TheFirstDefinitionHoldsAndTheSecondIsTold) {
  const ReadDeck read =
      read_text("*PARAMETER\nR A,1.0\n*PARAMETER\nR A,2.0\n*SECTION_SHELL\n         1\n&A\n");
  EXPECT_DOUBLE_EQ(shell(read.deck).thickness[0], 1);
  EXPECT_EQ(
      all_problems(read.problems),
      "warning test.k:4: *PARAMETER A: found a second definition; the first one, at test.k:2, "
      "holds\n");
}

TEST(DeckParameter, AnUndefinedOneIsAnErrorWithItsPlace) {
  EXPECT_EQ(errors_of("*PARAMETER\nR THICK,2.0\n*SECTION_SHELL\n         1\n    &THIK\n"),
            "test.k:5:5: *SECTION_SHELL card 2 field 1 (T1): expected a defined parameter, found "
            "'&THIK'; did you mean &THICK?\n");
}

TEST(DeckParameter, ABadValueIsAnError) {
  EXPECT_EQ(errors_of("*PARAMETER\nR A,1.0..2\n"),
            "test.k:2: *PARAMETER A: expected a value or an expression, found '1.0..2' (unexpected "
            "'.')\n");
  EXPECT_EQ(errors_of("*PARAMETER\nX A,1.0\n"),
            "test.k:2: *PARAMETER X A: expected a letter R, I or C and a name, found 'X A'\n");
}

}  // namespace
}  // namespace crosswalk::fe
