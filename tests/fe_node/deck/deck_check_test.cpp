#include "fe_node/deck/deck_check.h"

#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

const std::string kCube =
    "*NODE\n       1             0.0             0.0             0.0\n"
    "       2             1.0             0.0             0.0\n"
    "       3             1.0             1.0             0.0\n"
    "       4             0.0             1.0             0.0\n"
    "       5             0.0             0.0             1.0\n"
    "       6             1.0             0.0             1.0\n"
    "       7             1.0             1.0             1.0\n"
    "       8             0.0             1.0             1.0\n"
    "*PART\ncube\n         1         1         1\n*SECTION_SOLID\n         1\n"
    "*MAT_ELASTIC\n         1     7.8-6     210.0       0.3\n";

std::string problems_of(const std::string& text) {
  ReadDeck read = read_text(text);
  const DeckIndex index(read.deck);
  check_deck(index, read.problems);
  return all_problems(read.problems);
}

TEST(DeckCheck, ASoundCubeHasNoProblem) {
  EXPECT_EQ(problems_of(kCube + "*ELEMENT_SOLID\n       1       1       1       2       3       4  "
                                "     5       6       7       8\n"),
            "");
}

TEST(DeckCheck, InsideOutAndFlatSolids) {
  EXPECT_EQ(
      problems_of(kCube + "*ELEMENT_SOLID\n       1       1       5       6       7       8       "
                          "1       2       3       4\n"),
      "error test.k:18: solid 1: expected a positive volume, found hex8 of volume -1 (part 1); it "
      "is inside out: turn the order of its nodes\n");
  EXPECT_EQ(
      problems_of(kCube + "*ELEMENT_SOLID\n       1       1       1       2       3       4       "
                          "4       4       4       4\n"),
      "error test.k:18: solid 1: expected a positive volume, found tet4 of volume 0 (part 1); its "
      "nodes lie in a plane\n");
}

TEST(DeckCheck, MissingNodesAndParts) {
  EXPECT_EQ(problems_of(kCube + "*ELEMENT_SOLID\n       1       9       1       2       3       4  "
                                "     5       6      77      88\n"),
            "error test.k:18: solid 1: expected node 77, found none of that number, and 1 more "
            "like it\n"
            "error test.k:18: solid 1: expected part 9, found none of that number\n");
  EXPECT_EQ(
      problems_of(kCube + "*ELEMENT_SOLID\n       1       1\n"),
      "error test.k:18: *ELEMENT_SOLID card 2: expected another line, found the end of the "
      "keyword's cards\n"
      "error test.k:18: solid 1: expected 4, 5, 6, 8 or 10 nodes, found a node that is missing\n");
}

TEST(DeckCheck, DoubledIds) {
  EXPECT_EQ(
      problems_of(kCube + "*NODE\n       8             0.5\n       3             1.0             "
                          "1.0             0.0\n"),
      "error test.k:18: node id 8: expected one definition, found another one; the first is at "
      "test.k:9\n"
      "warning test.k:19: node id 3: expected one definition, found the same one twice; the first "
      "is at test.k:4\n");
}

TEST(DeckCheck, ImpossibleValues) {
  EXPECT_EQ(
      problems_of("*MAT_ELASTIC\n         1     7.8-6       0.0       0.5\n"),
      "error test.k:1: *MAT_ELASTIC 1 (E): expected a positive number, found 0\n"
      "error test.k:1: *MAT_ELASTIC 1 (PR): expected a Poisson ratio in (-1, 0.5), found 0.5\n");
  EXPECT_EQ(problems_of("*DEFINE_CURVE\n         1\n0.0,0.0\n0.0,1.0\n"),
            "error test.k:1: *DEFINE_CURVE 1: expected rising abscissas, found 0 after 0\n");
}

TEST(DeckCheck, DanglingReferencesOfEveryFamily) {
  const std::string text = problems_of(
      "*MAT_PIECEWISE_LINEAR_PLASTICITY\n         1     7.8-6     210.0       0.3       0.2\n"
      "                            55\n\n\n"
      "*MAT_MUSCLE\n         2     1.0-6       1.0\n     -66.0\n"
      "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n        77         0         2\n\n\n"
      "*CONSTRAINED_JOINT_SPHERICAL\n         8         9\n"
      "*BOUNDARY_SPC_SET\n        10\n*LOAD_BODY_Z\n        11\n");
  EXPECT_THAT(text, testing::HasSubstr("*MAT_PIECEWISE_LINEAR_PLASTICITY 1: expected curve 55"));
  EXPECT_THAT(text, testing::HasSubstr("*MAT_MUSCLE 2: expected curve 66"));
  EXPECT_THAT(text, testing::HasSubstr("*CONTACT 0: expected part set 77"));
  EXPECT_THAT(text, testing::HasSubstr("expected node 8, found none of that number, and 1 more"));
  EXPECT_THAT(text, testing::HasSubstr("*BOUNDARY_SPC: expected node set 10"));
  EXPECT_THAT(text, testing::HasSubstr("*LOAD_BODY: expected curve 11"));
}

TEST(DeckCheck, ThickShellsAreRefused) {
  EXPECT_THAT(
      problems_of(kCube + "*ELEMENT_TSHELL\n       1       1       1       2       3       4       "
                          "5       6       7       8\n"),
      testing::HasSubstr("*ELEMENT_TSHELL: expected solids or shells, found 1 thick shells"));
}

TEST(DeckCheck, APartThatManyElementsMissIsOneProblem) {
  std::string text = "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT_SHELL\n";
  for (int i = 1; i <= 50; ++i) text += std::to_string(i) + ",7,1,2,3,4\n";
  EXPECT_EQ(problems_of(text),
            "error test.k:7: shell 1: expected part 7, found none of that number, and 49 elements "
            "like it\n");
}

}  // namespace
}  // namespace crosswalk::fe
