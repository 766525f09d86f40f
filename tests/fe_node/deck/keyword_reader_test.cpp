#include "fe_node/deck/runnable.h"
#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

TEST(KeywordReader, FixedColumnsNeedNoBlanks) {
  const Deck deck = sound(
      "*NODE\n"
      "       1-2.309401035E+00-2.309401035E+00-2.309401035E+00       0       7\n"
      "*MAT_PLASTIC_KINEMATIC\n"
      "         2 7.34000-4 2.90000+70.30000000 50000.000 10000.000 0.0000000\n"
      " 0.0000000 0.0000000 0.0500000\n");
  EXPECT_DOUBLE_EQ(deck.nodes[0].position.z(), -2.309401035);
  EXPECT_EQ(deck.nodes[0].fixed_rotation, 7);
  const auto& law = std::get<mat::PlasticKinematic>(deck.materials[0].law);
  EXPECT_EQ(deck.materials[0].id, DeckId(2));
  EXPECT_DOUBLE_EQ(deck.materials[0].density, 7.34e-4);
  EXPECT_DOUBLE_EQ(law.youngs, 2.9e7);
  EXPECT_DOUBLE_EQ(law.failure_strain, 0.05);
}

TEST(KeywordReader, CommasFreeTheColumnsOfTheirLineOnly) {
  const Deck deck = sound(
      "*INITIAL_VELOCITY\n95\n5.,-1.,0.,0.,0.,100.\n"
      "*SET_NODE_LIST_GENERATE\n95\n1569,3136\n"
      "*MAT_ELASTIC\n1,7.8e-9,210000.0,\n");
  EXPECT_EQ(deck.initial_velocities[0].set, DeckId(95));
  EXPECT_DOUBLE_EQ(deck.initial_velocities[0].angular.z(), 100);
  EXPECT_EQ(deck.sets[0].ranges[0], std::make_pair(DeckId(1569), DeckId(3136)));
  EXPECT_DOUBLE_EQ(std::get<mat::Elastic>(deck.materials[0].law).youngs, 210000);
}

TEST(KeywordReader, LongFormatByKeywordAndByDeck) {
  const char* card =
      "                   1              7.8e-9               210.0                 0.3\n";
  for (const std::string head :
       {"*MAT_ELASTIC +\n", "*MAT_ELASTIC+\n", "*MAT_ELASTIC+ a remark\n",
        "*KEYWORD LONG=Y\n*MAT_ELASTIC\n"})
    EXPECT_DOUBLE_EQ(std::get<mat::Elastic>(sound(head + card).materials[0].law).poisson, 0.3)
        << head;
  const Deck deck =
      sound("*KEYWORD LONG=Y\n*MAT_ELASTIC -\n         1    7.8e-9     210.0       0.3\n");
  EXPECT_DOUBLE_EQ(std::get<mat::Elastic>(deck.materials[0].law).youngs, 210);
}

TEST(KeywordReader, TenColumnIds) {
  const Deck deck = sound("*NODE %\n  89999999             1.0             2.0             3.0\n");
  EXPECT_EQ(deck.nodes[0].id, DeckId(89999999));
  EXPECT_DOUBLE_EQ(deck.nodes[0].position.z(), 3);
}

TEST(KeywordReader, CommentsMayStandAnywhere) {
  const Deck deck = sound(
      "$ head\n*PART\n$ title\na part, with a comma\n$#     pid\n         1         2         3\n"
      "*ELEMENT_SOLID\n       7       1\n$ between the two lines\n"
      "       1       2       3       4       5       6       7       8\n");
  EXPECT_EQ(deck.parts[0].title, "a part, with a comma");
  EXPECT_EQ(deck.parts[0].material, DeckId(3));
  EXPECT_EQ(deck.solids[0].nodes[7], DeckId(8));
}

TEST(KeywordReader, CarriageReturnsTabsAndTrailingBlanks) {
  const Deck deck = sound("*KEYWORD\r\n*NODE\r\n       1\t     2.0   \r\n*END\r\n");
  EXPECT_DOUBLE_EQ(deck.nodes[0].position.x(), 2.0);
}

TEST(KeywordReader, SeveralPartsUnderOneKeyword) {
  const Deck deck = sound(
      "*PART\nfirst\n         1         1         1\n\n         2         1         1\n"
      "third\n         3         1         1\n\n");
  ASSERT_EQ(deck.parts.size(), 3U);
  EXPECT_EQ(deck.parts[1].title, "");
  EXPECT_EQ(deck.parts[2].id, DeckId(3));
}

TEST(KeywordReader, BlankFieldsKeepTheDefault) {
  const Deck deck = sound(
      "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n"
      "         1         0         2         0\n"
      "       0.2                                                           0.0\n\n");
  const Contact& contact = deck.contacts[0];
  EXPECT_DOUBLE_EQ(contact.death, kNever);
  EXPECT_DOUBLE_EQ(contact.slave.stiffness_scale, 1);
  EXPECT_DOUBLE_EQ(contact.master.thickness_scale, 1);
  EXPECT_EQ(contact.slave.kind, SurfaceKind::PartSet);
  EXPECT_EQ(contact.kind, ContactKind::SingleSurface);
  EXPECT_TRUE(contact.is_automatic);
}

TEST(KeywordReader, ContactWithNumberTitleProcessorCardsAndOptionalCards) {
  const Deck deck = sound(
      "*CONTACT_AUTOMATIC_GENERAL_ID_MPP\n"
      "    100001Head, neck\n"
      "         0       200                   3         2    1.0005                   0\n"
      "&                  0        1.         0\n"
      "    100001         0         2                   0         0         0         0\n"
      "        0.        0.        0.        0.        0.         0        0.     1.E20\n"
      "        1.        1.        0.        0.        1.        1.        1.        1.\n"
      "         2       0.1                   0         3         5\n"
      "        0.         0\n"
      "         1         1\n");
  const Contact& contact = deck.contacts[0];
  EXPECT_EQ(contact.title, "Head, neck");
  EXPECT_EQ(contact.mpp_cards.size(), 2U);
  EXPECT_EQ(contact.card_a->soft, 2);
  EXPECT_DOUBLE_EQ(contact.card_a->segment_extension, 1.025);
  EXPECT_EQ(contact.card_c->ignore, 1);
  EXPECT_EQ(contact.kind, ContactKind::General);
}

TEST(KeywordReader, ShellsWithThicknessCards) {
  const Deck deck = sound(
      "*ELEMENT_SHELL_THICKNESS\n"
      "       1       2       1    1769    1773    1772       0       0       0       0\n"
      "             0.0             1.5             0.0             0.0            45.0\n"
      "       2       2       2    1771    1777    1776       0       0       0       0\n"
      "             0.0             0.0             0.0             2.5             0.0\n");
  EXPECT_DOUBLE_EQ(deck.shells[0].thickness[1], 1.5);
  EXPECT_DOUBLE_EQ(deck.shells[0].material_angle_deg, 45);
  EXPECT_DOUBLE_EQ(deck.shells[1].thickness[3], 2.5);
}

TEST(KeywordReader, DiscreteElementsHaveWideFieldsBehindNarrowOnes) {
  const Deck deck = sound(
      "*ELEMENT_DISCRETE\n       1     101       1     129       1  2.50000000E+00       1\n");
  EXPECT_DOUBLE_EQ(deck.discretes[0].scale, 2.5);
  EXPECT_EQ(deck.discretes[0].print, 1);
}

TEST(KeywordReader, ZeroWeightOfInterpolationMeansOne) {
  const Deck deck = sound(
      "*CONSTRAINED_INTERPOLATION\n   7274788   7109209       123                   0\n"
      "   7188849       123        0.\n   7188848       123        2.\n");
  EXPECT_DOUBLE_EQ(deck.interpolations[0].nodes[0].weight, 1);
  EXPECT_DOUBLE_EQ(deck.interpolations[0].nodes[1].weight, 2);
}

TEST(KeywordReader, TablesTakeTheCurvesThatFollowOrNameThem) {
  const Deck deck = sound(
      "*DEFINE_TABLE\n       103       1.0       0.0\n                 0.0\n                 1.0\n"
      "*DEFINE_CURVE\n         7\n                 0.0                 0.0\n"
      "*DEFINE_CURVE\n         8\n                 0.0                 0.0\n"
      "*DEFINE_TABLE_2D\n       104\n           2.401E-4                   7\n");
  EXPECT_EQ(deck.tables[0].curves, (std::vector<DeckId>{DeckId(7), DeckId(8)}));
  EXPECT_EQ(deck.tables[1].curves, (std::vector<DeckId>{DeckId(7)}));
}

TEST(KeywordReader, RubberWithPronyLines) {
  const Deck deck = sound(
      "*MAT_OGDEN_RUBBER_TITLE\nscalp\n"
      "    103001    1.1E-6   0.49998         0         6\n"
      "    3.5E-8\n       20.\n     8.E-7     0.006\n    1.8E-6      0.05\n    2.2E-6       0.6\n");
  const auto& law = std::get<mat::OgdenRubber>(deck.materials[0].law);
  EXPECT_EQ(deck.materials[0].title, "scalp");
  EXPECT_DOUBLE_EQ(law.mu[0], 3.5e-8);
  EXPECT_DOUBLE_EQ(law.alpha[0], 20);
  ASSERT_EQ(law.terms.size(), 3U);
  EXPECT_DOUBLE_EQ(law.terms[2].shear_decay, 0.6);
}

TEST(KeywordReader, MaterialsByNumber) {
  const Deck deck = sound(
      "*MAT_020_TITLE\nrigid\n         1    7.8e-6     207.0       0.3\n\n\n"
      "*MAT_S01\n         2      10.0\n*MAT_077_O\n         3    1.0e-6      0.49\n       1.0\n    "
      "   2.0\n");
  EXPECT_TRUE(std::holds_alternative<mat::Rigid>(deck.materials[0].law));
  EXPECT_TRUE(std::holds_alternative<mat::SpringElastic>(deck.materials[1].law));
  EXPECT_TRUE(std::holds_alternative<mat::OgdenRubber>(deck.materials[2].law));
}

TEST(KeywordReader, UnsupportedMaterialsKeepTheirNumberAndCards) {
  const ReadDeck read =
      read_text("*MAT_NEVER_HEARD_OF_TITLE\nname\n        42    1.0e-6       1.0\n");
  EXPECT_EQ(read.deck.materials[0].id, DeckId(42));
  EXPECT_EQ(read.deck.materials[0].title, "name");
  EXPECT_EQ(std::get<mat::Unsupported>(read.deck.materials[0].law).cards.size(), 1U);
  EXPECT_EQ(read.deck.unread[0].effect, Effect::Physics);
}

TEST(KeywordReader, KeywordsInAnyCaseAndWithTheirOptions) {
  const Deck deck = sound(
      "*set_node_list_generate\n1\n1,376\n*Boundary_Spc_Set_ID\n         5clamp\n         1        "
      " 0         1\n");
  EXPECT_EQ(deck.sets[0].ranges.size(), 1U);
  EXPECT_EQ(deck.spcs[0].id, DeckId(5));
  EXPECT_EQ(deck.spcs[0].title, "clamp");
  EXPECT_EQ(deck.spcs[0].fixed[0], 1);
}

TEST(KeywordReader, NothingIsSilentlyIgnored) {
  const ReadDeck read = read_text(
      "*DATABASE_EXTENT_BINARY\n         0\n*AIRBAG_SIMPLE\n         1\n         "
      "2\n*SET_NODE_COLLECT\n1\n");
  ASSERT_EQ(read.deck.unread.size(), 3U);
  EXPECT_EQ(read.deck.unread[0].effect, Effect::OutputOnly);
  EXPECT_EQ(read.deck.unread[1].effect, Effect::Physics);
  EXPECT_EQ(read.deck.unread[1].card_count, 2);
  EXPECT_EQ(read.deck.unread[2].effect, Effect::Physics);
}

TEST(KeywordReader, ExtraCardsAreTold) {
  const ReadDeck read =
      read_text("*MAT_ELASTIC\n         1    7.8e-6     207.0       0.3\n         9\n");
  EXPECT_EQ(
      all_problems(read.problems),
      "warning test.k:3: *MAT_ELASTIC: expected 1 cards, found more; the rest of them was not "
      "read\n");
}

TEST(KeywordReader, UnitsByCommentAndByCard) {
  EXPECT_EQ(sound("*KEYWORD\n$ crosswalk: unit_system=mm-kg-ms\n").units, UnitSystem::MmKgMs);
  EXPECT_EQ(sound("*CONTROL_UNITS\n        mm        ms        kg\n").units, UnitSystem::MmKgMs);
  EXPECT_EQ(sound("*CONTROL_UNITS\n        mm       sec  mtrc_ton\n").units, UnitSystem::MmTonneS);
  EXPECT_THAT(errors_of("*KEYWORD\n$ crosswalk: unit_system=furlong\n"),
              testing::HasSubstr("expected unit_system= one of m-kg-s, mm-t-s"));
}

TEST(KeywordReader, EveryRecordKnowsItsPlace) {
  const Deck deck =
      sound("*KEYWORD\n*NODE\n       1\n       2\n*PART\nname\n         4         1         1\n");
  EXPECT_EQ(deck.place(deck.nodes[1].source).text(), "test.k:4");
  EXPECT_EQ(deck.place(deck.parts[0].source).text(), "test.k:7");
  EXPECT_EQ(deck.place(Source{}).text(), "generated deck");
}

TEST(KeywordReader, ARunRefusesWhatChangesThePhysics) {
  const std::string text = "*NODE\n       1\n*AIRBAG_SIMPLE\n         1\n*DATABASE_EXTENT_BINARY\n";
  ReadDeck read = read_text(text);
  EXPECT_THROW(require_runnable(read, MissingPolicy::Refuse), UserError);
  EXPECT_NO_THROW(require_runnable(read, MissingPolicy::Accept));
}

}  // namespace
}  // namespace crosswalk::fe
