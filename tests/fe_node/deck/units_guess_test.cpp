#include "fe_node/deck/units_guess.h"

#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

/// Steel, written in some system, with an end time of 100 ms.
Deck steel(UnitSystem system) {
  const UnitFactors factors = unit_factors(system);
  Deck deck;
  Material& material = deck.materials.emplace_back();
  material.density = 7830 / factors.density();
  mat::Rigid law;
  law.youngs = 2.1e11 / factors.stress();
  material.law = law;
  deck.control.end_time = 0.1 / factors.time;
  deck.nodes.resize(2);
  deck.nodes[1].position = Vec3(0.5, 0, 0) / factors.length;
  return deck;
}

TEST(UnitsGuess, FindsTheSystemSteelIsWrittenIn) {
  for (const UnitSystem system : {UnitSystem::MKgS, UnitSystem::MmTonneS, UnitSystem::MmKgMs,
                                  UnitSystem::MmGramMs, UnitSystem::InchSlinchS}) {
    const UnitsGuess guess = guess_units(steel(system));
    EXPECT_EQ(guess.system, system) << unit_system_name(system);
    EXPECT_EQ(guess.certainty, UnitsGuess::Certainty::Likely) << unit_system_name(system);
  }
}

TEST(UnitsGuess, AStatementEndsTheGuessing) {
  Deck deck = steel(UnitSystem::MmTonneS);
  deck.units = UnitSystem::MmKgMs;
  EXPECT_EQ(guess_units(deck).system, UnitSystem::MmKgMs);
  EXPECT_EQ(guess_units(deck).certainty, UnitsGuess::Certainty::Stated);
}

TEST(UnitsGuess, AStatementAgainstTheNumbersIsDoubted) {
  Deck deck = steel(UnitSystem::MmTonneS);
  for (const UnitSystem stated : {UnitSystem::MmTonneS, UnitSystem::MmKgMs}) {
    deck.units = stated;
    DeckProblems problems;
    check_units(deck, problems);
    EXPECT_TRUE(problems.errors.empty());
    if (stated == UnitSystem::MmTonneS) {
      EXPECT_EQ(all_problems(problems), "");
    } else {
      EXPECT_THAT(all_problems(problems),
                  testing::HasSubstr("expected mm-t-s, as the numbers look, found mm-kg-ms is "
                                     "stated: density"));
    }
  }
}

TEST(UnitsGuess, AMeshAloneTellsNothing) {
  Deck deck;
  deck.nodes.emplace_back().position = {100, 0, 0};
  EXPECT_EQ(guess_units(deck).certainty, UnitsGuess::Certainty::None);
}

TEST(UnitsGuess, NonsenseIsNotCalledLikely) {
  Deck deck = steel(UnitSystem::MKgS);
  deck.materials[0].density = 1;
  std::get<mat::Rigid>(deck.materials[0].law).youngs = 1e30;
  EXPECT_NE(guess_units(deck).certainty, UnitsGuess::Certainty::Likely);
}

}  // namespace
}  // namespace crosswalk::fe
