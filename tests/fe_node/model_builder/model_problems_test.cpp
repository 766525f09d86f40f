// Decks that cannot become a model: every reason at once, with its place.
#include "common/error.h"
#include "tests/fe_node/model_builder/built_deck.h"

namespace crosswalk::fe {
namespace {

using testing::HasSubstr;

/// What stands against the deck, one problem a line.
std::string problems_of(const std::string& text) {
  try {
    model_of(text);
  } catch (const UserError& error) {
    std::string out;
    for (const Problem& problem : error.problems()) out += problem.text() + '\n';
    return out;
  }
  return "none";
}

TEST(ModelProblems, ASoundDeckHasNone) { EXPECT_EQ(problems_of(kCube), "none"); }

TEST(ModelProblems, AllAreToldAtOnceWithTheirPlaces) {
  const std::string found = problems_of(
      kCube +
      "*CONSTRAINED_JOINT_SPHERICAL\n1,2\n*LOAD_NODE_POINT\n1,1,99\n"
      "*BOUNDARY_SPC_NODE\n77,0,1\n*ELEMENT_SOLID\n5,9,1,2,3,4,5,6,7,8\n6,1,5,6,7,8,1,2,3,4\n");
  for (const char* text :
       {"expected a *DEFINE_CURVE of the deck, found 99", "expected a node of the deck, found 77",
        "*ELEMENT_SOLID 5: expected a part of the deck, found 9",
        "*ELEMENT_SOLID 6: expected a positive volume", "test.k:"})
    EXPECT_THAT(found, HasSubstr(text));
}

TEST(ModelProblems, ManyOfOneKindDoNotHideTheOthers) {
  std::string text = kCube + "*ELEMENT_SOLID\n";
  for (int i = 10; i < 200; ++i) text += std::to_string(i) + ",9,1,2,3,4,5,6,7,8\n";
  const std::string found = problems_of(text + "*LOAD_NODE_POINT\n1,1,99\n");
  EXPECT_THAT(found, HasSubstr("found 99"));
  EXPECT_THAT(found, HasSubstr("in all 190 *ELEMENT_SOLID"));
}

TEST(ModelProblems, NothingToRun) {
  EXPECT_THAT(problems_of(kCubeNodes), HasSubstr("elements: expected one or more, found none"));
}

TEST(ModelProblems, ABodyWithoutMass) {
  EXPECT_THAT(problems_of(kCube + "*PART\nghost\n2,1,2\n*MAT_RIGID\n2,7.8e-6,210.0,0.3\n0\n0\n"),
              HasSubstr("rigid body 'ghost': expected a mass above zero"));
}

TEST(ModelProblems, AnInertiaThatNoBodyHas) {
  for (const char* tensor : {"0,0,0,0,0,0", "1,5,0,1,0,1", "-1,0,0,1,0,1"})
    EXPECT_THAT(problems_of(kCubeNodes + kCubeElement +
                            "*SECTION_SOLID\n1,1\n*MAT_RIGID\n1,7.8e-6,210.0,0.3\n0\n0\n"
                            "*PART_INERTIA\nblock\n1,1,1\n1,2,3,4\n" +
                            tensor + "\n0,0,0\n"),
                HasSubstr("expected principal moments of inertia above zero"))
        << tensor;
}

TEST(ModelProblems, ASpringWithoutLengthHasNoDirection) {
  EXPECT_THAT(problems_of(kCube + "*PART\nspring\n2,2,2\n*SECTION_DISCRETE\n2\n0\n"
                                  "*MAT_SPRING_ELASTIC\n2,0.5\n*ELEMENT_DISCRETE\n11,2,6,0\n"),
              HasSubstr("line element 11: expected two ends apart"));
}

TEST(ModelProblems, SolidsOfACompositePart) {
  EXPECT_THAT(problems_of(kCubeNodes +
                          "*MAT_ELASTIC\n1,7.8e-6,210.0,0.3\n*PART_COMPOSITE\n"
                          "laminate\n1,2\n1,1.0\n" +
                          kCubeElement),
              HasSubstr("expected shells alone"));
}

TEST(ModelProblems, ASetThatNamesItself) {
  EXPECT_THAT(problems_of(kCube + "*SET_NODE_ADD\n1\n2\n*SET_NODE_ADD\n2\n1\n"),
              HasSubstr("itself among the sets it adds"));
}

TEST(ModelProblems, NumbersThatLeaveNoStableStep) {
  EXPECT_THAT(problems_of(kCubeNodes +
                          "*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n"
                          "1,7.8e-6,1e305,0.3\n" +
                          kCubeElement),
              HasSubstr("expected a finite mass and stable step above zero"));
}

TEST(ModelProblems, ACompositeOfNoLayers) {
  for (const char* layers : {"", "1,0.0\n"})
    EXPECT_THAT(
        problems_of(kCubeNodes + "*MAT_ELASTIC\n1,7.8e-6,210.0,0.3\n*PART_COMPOSITE\nsheet\n1,2\n" +
                    layers + "*ELEMENT_SHELL\n1,1,1,2,3,4\n"),
        HasSubstr("expected layers with a thickness"));
}

TEST(ModelProblems, AnInterlayerWithoutYieldStress) {
  EXPECT_THAT(problems_of(kCubeNodes +
                          "*PART\npane\n1,1,1\n*SECTION_SHELL\n1,16\n5.0\n"
                          "*MAT_LAMINATED_GLASS\n1,2.5e-6,70.0,0.22,0.06,0,0,0.1\n0.45\n0,1,0\n"
                          "*ELEMENT_SHELL\n1,1,1,2,3,4\n"),
              HasSubstr("field SYP: expected a positive yield stress"));
}

TEST(ModelProblems, ASpringInAPartOfBeams) {
  EXPECT_THAT(problems_of(kCube + "*PART\nbeams\n2,2,1\n*SECTION_BEAM\n2,1\n1,1,1,1\n"
                                  "*ELEMENT_DISCRETE\n11,2,6,7\n"),
              HasSubstr("expected beams alone in a part whose section bends"));
}

TEST(ModelProblems, AWallWithoutRadiusOrNormal) {
  for (const char* wall :
       {"_PLANAR\n0\n1,1,1,1,1,1,0.3\n", "_GEOMETRIC_SPHERE\n0\n0,0,-9,0,0,1,0.3\n0.0\n"})
    EXPECT_THAT(problems_of(kCube + "*RIGIDWALL" + wall),
                HasSubstr("a radius and a direction of its axis or normal"))
        << wall;
}

TEST(ModelProblems, ABrickThatIsInsideOutAtAPoint) {
  // corner 7 pushed through the middle: the volume stays positive
  std::string nodes = kCubeNodes;
  nodes.replace(nodes.find("7,10,10,10"), 10, "7,3,3,3");
  const std::string rest = "*PART\ncube\n1,1,1\n*MAT_ELASTIC\n1,7.8e-6,210.0,0.3\n" + kCubeElement;
  EXPECT_EQ(problems_of(nodes + rest + "*SECTION_SOLID\n1,1\n"), "none");
  EXPECT_THAT(problems_of(nodes + rest + "*SECTION_SOLID\n1,2\n"),
              HasSubstr("*ELEMENT_SOLID 1 of part 1: expected a positive Jacobian"));
}

TEST(ModelProblems, AStepBeyondTheStableOne) {
  for (const char* scale : {"-0.9", "15"})
    EXPECT_THAT(problems_of(kCube + "*CONTROL_TIMESTEP\n0," + scale + "\n"),
                HasSubstr("a multiple of the stable step in (0, 10]"));
}

TEST(ModelProblems, LawsThatElementsDoNotHaveAreNamed) {
  const std::string found = problems_of(
      kCubeNodes + "*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_NULL\n1,7.8e-6\n" + kCubeElement);
  EXPECT_THAT(found, HasSubstr("*MAT_NULL 1"));
  EXPECT_THAT(found, HasSubstr("a law that solid elements have"));
}

}  // namespace
}  // namespace crosswalk::fe
