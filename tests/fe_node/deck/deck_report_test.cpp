#include "fe_node/deck/deck_report.h"

#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

DeckReport report_of(const std::string& text) {
  ReadDeck read = read_text(text);
  return report_deck(read, "test.k");
}

const std::string kPlate =
    "*KEYWORD\n$ crosswalk: unit_system=mm-kg-ms\n*TITLE\na plate\n*CONTROL_TERMINATION\n      "
    "10.0\n"
    "*NODE\n       1             0.0             0.0\n       2           100.0             0.0\n"
    "       3           100.0           100.0\n       4             0.0           100.0\n"
    "*PART\nplate\n         1         1         1\n*SECTION_SHELL\n         1         2\n       "
    "2.0\n"
    "*MAT_ELASTIC\n         1     7.8-6     210.0       0.3\n"
    "*ELEMENT_SHELL\n       1       1       1       2       3       4\n";

TEST(DeckReport, TellsPartsMassesAndUnits) {
  const DeckReport report = report_of(kPlate);
  EXPECT_TRUE(report.is_sound);
  EXPECT_THAT(report.text, testing::HasSubstr("units     mm-kg-ms, stated by the deck"));
  EXPECT_THAT(report.text, testing::HasSubstr("elements  1 quad4"));
  // 100 x 100 x 2 mm of 7.8e-6 kg/mm3
  EXPECT_THAT(report.text, testing::HasSubstr("mass      0.156 kg"));
  EXPECT_THAT(report.text, testing::HasSubstr("end time  10 (10 ms)"));
  EXPECT_THAT(report.text, testing::ContainsRegex("1  plate +1 quad4 +shell 2 +1 ELASTIC +0.156"));
  EXPECT_THAT(report.text, testing::HasSubstr("The deck is sound"));
}

TEST(DeckReport, ListsWhatIsLeftOutOnceWithItsEffect) {
  const DeckReport report = report_of(
      kPlate + "*AIRBAG_SIMPLE\n         1\n*DATABASE_EXTENT_BINARY\n*DATABASE_EXTENT_BINARY\n");
  EXPECT_FALSE(report.is_sound);
  EXPECT_THAT(
      report.text,
      testing::HasSubstr(
          "test.k:22: *AIRBAG_SIMPLE: changes the physics: refused unless --accept-missing"));
  EXPECT_THAT(
      report.text,
      testing::HasSubstr("test.k:24: *DATABASE_EXTENT_BINARY (2 times): ignored: output only"));
  EXPECT_THAT(report.text, testing::HasSubstr("The deck cannot be run as it stands."));
}

TEST(DeckReport, ListsEveryErrorAtOnce) {
  const DeckReport report = report_of(kPlate +
                                      "*MAT_ELASTIC\n         2       abc     210.0       "
                                      "0.7\n*PART\nlost\n         2         5         2\n");
  EXPECT_FALSE(report.is_sound);
  EXPECT_THAT(report.text, testing::HasSubstr("errors (3)"));
  EXPECT_THAT(report.text, testing::HasSubstr("field 2 (RO): expected a number, found 'abc'"));
  EXPECT_THAT(report.text, testing::HasSubstr("found 0.7"));
  EXPECT_THAT(report.text, testing::HasSubstr("expected section 5"));
}

TEST(DeckReport, GivesCompositeAndPartInertiaMasses) {
  const DeckReport report =
      report_of(kPlate +
                "*PART_COMPOSITE\nlaminate\n         2         2\n         1       2.0       0.0   "
                "                1       1.0\n"
                "*ELEMENT_SHELL\n       2       2       1       2       3       4\n"
                "*PART_INERTIA\nbody\n         3         1         1\n       0.0       0.0       "
                "0.0       4.5\n       1.0\n\n");
  EXPECT_THAT(report.text,
              testing::ContainsRegex("2  laminate +1 quad4 +shell 2 +2 layers +0.234"));
  EXPECT_THAT(report.text, testing::ContainsRegex("3  body .*4.5"));
}

}  // namespace
}  // namespace crosswalk::fe
