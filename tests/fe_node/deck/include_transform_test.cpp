// *INCLUDE_TRANSFORM: numbers, units and place of an included file.
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include <unistd.h>

#include "fe_node/deck/deck_references.h"
#include "fe_node/deck/deck_writer.h"
#include "fe_node/deck/renumber.h"
#include "tests/fe_node/deck/deck_text.h"
#include "tests/source_folder.h"

namespace crosswalk::fe {
namespace {

namespace fs = std::filesystem;

class IncludeTransform : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("cw_transform_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  /// `inner` behind the cards that follow the file name, and `more` of the including deck.
  ReadDeck included(const std::string& inner, const std::string& cards,
                    const std::string& more = "") {
    file("inner.k", inner);
    return read_deck(file("top.k", "*KEYWORD\n*INCLUDE_TRANSFORM\ninner.k\n" + cards + more));
  }
  fs::path folder_;
};

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Decks with records of every kind: the corpus of the fuzzer, as far as it reads without errors.
std::vector<std::string> sample_decks() {
  std::vector<std::string> out;
  const fs::path corpus = source_folder() / "tests/fe_node/deck/fuzz/corpus";
  for (const auto& entry : fs::directory_iterator(corpus)) {
    const std::string text = text_of(entry.path());
    if (text.find("*INCLUDE") != std::string::npos) continue;
    if (read_text(text).problems.errors.empty()) out.push_back(text);
  }
  return out;
}

TEST_F(IncludeTransform, WithoutChangesItIsAPlainInclude) {
  int compared = 0;
  for (const std::string& text : sample_decks()) {
    const ReadDeck transformed = included(text, "");
    const ReadDeck plain = read_deck(file("plain.k", "*KEYWORD\n*INCLUDE\ninner.k\n"));
    EXPECT_TRUE(transformed.deck == plain.deck) << text;
    EXPECT_EQ(all_problems(transformed.problems), all_problems(plain.problems));
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

constexpr IdOffsets kOffsets{.node = 1'000'000,
                             .element = 2'000'000,
                             .part = 3'000'000,
                             .material = 4'000'000,
                             .set = 5'000'000,
                             .curve = 6'000'000,
                             .definition = 7'000'000,
                             .other = 8'000'000};

int offset_of(Named kind) {
  switch (kind) {
    case Named::Node:
      return kOffsets.node;
    case Named::Part:
      return kOffsets.part;
    case Named::Material:
    case Named::EquationOfState:
      return kOffsets.material;
    case Named::Curve:
      return kOffsets.curve;
    case Named::NodeSet:
    case Named::PartSet:
    case Named::ShellSet:
    case Named::SolidSet:
    case Named::BeamSet:
    case Named::DiscreteSet:
    case Named::SegmentSet:
      return kOffsets.set;
    case Named::Axes:
    case Named::Vector:
    case Named::SpringOrientation:
    case Named::Box:
      return kOffsets.definition;
    default:
      return kOffsets.other;
  }
}

std::vector<std::pair<Named, int>> references_of(const Deck& deck) {
  std::vector<std::pair<Named, int>> out;
  for_each_reference(deck, [&](const Reference& reference) {
    out.emplace_back(reference.kind, reference.id.value);
  });
  return out;
}

TEST(Renumber, ReachesEveryReference) {
  long checked = 0;
  std::map<Named, long> seen;
  for (const std::string& text : sample_decks()) {
    Deck deck = read_text(text).deck;
    const auto before = references_of(deck);
    ASSERT_TRUE(renumber(deck, kOffsets)) << text;
    const auto after = references_of(deck);
    ASSERT_EQ(after.size(), before.size()) << text;
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(after[i].first, before[i].first);
      EXPECT_EQ(after[i].second, before[i].second + offset_of(before[i].first))
          << named_word(before[i].first) << " in\n"
          << text;
      ++seen[before[i].first];
      ++checked;
    }
  }
  EXPECT_GT(checked, 100);
  EXPECT_GE(seen.size(), 10U);
}

TEST(Renumber, BackwardsGivesTheSameDeck) {
  IdOffsets back = kOffsets;
  for (int* value : {&back.node, &back.element, &back.part, &back.material, &back.set, &back.curve,
                     &back.definition, &back.other})
    *value = -*value;
  for (const std::string& text : sample_decks()) {
    const std::string before = deck_text(read_text(text).deck);
    Deck deck = read_text(text).deck;
    ASSERT_TRUE(renumber(deck, kOffsets));
    ASSERT_TRUE(renumber(deck, back));
    // a nodal rigid body that names no set has its own number written out
    if (before.find("NODAL_RIGID_BODY") == std::string::npos) {
      EXPECT_EQ(deck_text(deck), before);
    }
  }
}

TEST_F(IncludeTransform, EveryKindOfIdMoves) {
  const std::string inner =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n"
      "*ELEMENT_SHELL\n5,6,1,2,3,4\n"
      "*PART\np\n6,7,8,0,9\n*SECTION_SHELL\n7,2\n1.0\n*HOURGLASS\n9,4\n"
      "*MAT_PIECEWISE_LINEAR_PLASTICITY\n8,7.8e-6,210.,0.3,0.2\n0,0,-10\n\n\n"
      "*DEFINE_CURVE\n10\n0,0.2\n1,0.3\n*DEFINE_BOX\n11,0,1,0,1,0,1\n"
      "*SET_NODE_LIST\n12\n1,2,3,4\n*SET_SHELL_GENERAL\n13\nPART,6\nDSHELL,5\n"
      "*SET_NODE_GENERAL\n14\nBOX,11\n*SET_NODE_LIST_GENERATE\n15\n1,4\n"
      "*BOUNDARY_SPC_SET_ID\n16,fixed\n12,0,1\n"
      "*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID\n17,all\n6,0,3\n\n\n"
      "*DATABASE_HISTORY_NODE\n4\n*DATABASE_HISTORY_SHELL\n5\n"
      "*CONSTRAINED_NODAL_RIGID_BODY\n12\n";
  const ReadDeck read =
      included(inner, "1000000,2000000,3000000,4000000,5000000,6000000,7000000\n8000000\n\n\n");
  EXPECT_EQ(all_problems(read.problems), "");
  const Deck& d = read.deck;
  EXPECT_EQ(d.nodes[3].id.value, 1000004);
  EXPECT_EQ(d.shells[0].id.value, 2000005);
  EXPECT_EQ(d.shells[0].nodes[2].value, 1000003);
  EXPECT_EQ(d.shells[0].nodes[4].value, 0);
  EXPECT_EQ(d.parts[0].id.value, 3000006);
  EXPECT_EQ(d.parts[0].section.value, 8000007);
  EXPECT_EQ(d.parts[0].material.value, 4000008);
  EXPECT_EQ(d.parts[0].hourglass.value, 8000009);
  const auto& steel = std::get<mat::PiecewiseLinearPlasticity>(d.materials[0].law);
  EXPECT_EQ(steel.stress_curve.value, -6000010);
  EXPECT_EQ(d.curves[0].id.value, 6000010);
  EXPECT_EQ(d.boxes[0].id.value, 7000011);
  EXPECT_EQ(d.sets[0].ids[0].value, 1000001);
  EXPECT_EQ(d.sets[1].general[0].ids[0].value, 3000006);
  EXPECT_EQ(d.sets[1].general[1].ids[0].value, 2000005);
  EXPECT_EQ(d.sets[2].general[0].ids[0].value, 7000011);
  EXPECT_EQ(d.sets[3].ranges[0].second.value, 1000004);
  EXPECT_EQ(d.spcs[0].id.value, 8000016);
  EXPECT_EQ(d.spcs[0].target.value, 5000012);
  EXPECT_EQ(d.contacts[0].id.value, 8000017);
  EXPECT_EQ(d.contacts[0].slave.id.value, 3000006);
  EXPECT_EQ(d.histories[0].id.value, 1000004);
  EXPECT_EQ(d.histories[1].id.value, 2000005);
  EXPECT_EQ(d.nodal_rigid_bodies[0].id.value, 3000012);
  EXPECT_EQ(d.nodal_rigid_bodies[0].node_set.value, 5000012);
}

TEST_F(IncludeTransform, NestedOffsetsAdd) {
  file("deep.k", "*NODE\n1,1,0,0\n*INCLUDE\nplain.k\n");
  file("plain.k", "*NODE\n2,0,0,0\n");
  const ReadDeck read =
      included("*NODE\n1,0,0,0\n*INCLUDE_TRANSFORM\ndeep.k\n10\n", "100\n", "*NODE\n1,0,0,0\n");
  EXPECT_EQ(all_problems(read.problems), "");
  std::vector<int> ids;
  for (const DeckNode& node : read.deck.nodes) ids.push_back(node.id.value);
  EXPECT_EQ(ids, (std::vector<int>{1, 101, 111, 112}));
  EXPECT_TRUE(read.deck.place(read.deck.nodes[2].source).file.ends_with("deep.k"));
  EXPECT_EQ(read.deck.nodes[2].source.line, 2);
}

TEST_F(IncludeTransform, RowsActInTheirOrder) {
  // a node at (1, 0, 0): twice as far, a quarter turn about z, then 10 along x
  const std::string inner = "*NODE\n1,1,0,0\n*DEFINE_VECTOR\n3,0,0,0,1,0,0\n";
  const ReadDeck read = included(inner, "\n\n\n5\n",
                                 "*DEFINE_TRANSFORMATION\n5\nSCALE,2,2,2\n"
                                 "ROTATE,0,0,1,0,0,0,90\nTRANSL,10,0,0\n");
  EXPECT_EQ(all_problems(read.problems), "");
  EXPECT_LT((read.deck.nodes[0].position - Vec3(10, 2, 0)).norm(), 1e-12);
  EXPECT_LT((read.deck.vectors[0].head - Vec3(10, 2, 0)).norm(), 1e-12);
  // the other order: moved first, it turns about a farther place
  const ReadDeck other = included(inner, "\n\n\n5\n",
                                  "*DEFINE_TRANSFORMATION\n5\nTRANSL,10,0,0\n"
                                  "ROTATE,0,0,1,0,0,0,90\n");
  EXPECT_LT((other.deck.nodes[0].position - Vec3(0, 11, 0)).norm(), 1e-12);
}

TEST_F(IncludeTransform, PointsTravelWithTheRowsBeforeTheirUse) {
  // axis through (1, 0, 0) along z; carried to (1, 5, 0) before the turn
  const std::string point =
      "*DEFINE_TRANSFORMATION\n5\nPOINT,1,1,0,0\nPOINT,2,1,0,3\nTRANSL,0,5,0\nROTATE,1,2,180\n";
  const ReadDeck read = included("*NODE\n1,0,0,0\n", "\n\n\n5\n", point);
  EXPECT_EQ(all_problems(read.problems), "");
  EXPECT_LT((read.deck.nodes[0].position - Vec3(2, 5, 0)).norm(), 1e-12);
  const ReadDeck along = included("*NODE\n1,0,0,0\n", "\n\n\n5\n",
                                  "*DEFINE_TRANSFORMATION\n5\nPOINT,1,0,0,0\nPOINT,2,0,0,3\n"
                                  "TRANSL2ND,1,2,7\n");
  EXPECT_LT((along.deck.nodes[0].position - Vec3(0, 0, 7)).norm(), 1e-12);
  // the frame x y to the frame y -x at (4, 0, 0)
  const ReadDeck frames = included("*NODE\n1,1,2,3\n", "\n\n\n5\n",
                                   "*DEFINE_TRANSFORMATION\n5\nPOINT,1,0,0,0\nPOINT,2,1,0,0\n"
                                   "POINT,3,0,1,0\nPOINT,4,4,0,0\nPOINT,5,4,1,0\nPOINT,6,3,0,0\n"
                                   "POS6P,1,2,3,4,5,6\n");
  EXPECT_EQ(all_problems(frames.problems), "");
  EXPECT_LT((frames.deck.nodes[0].position - Vec3(2, 1, 3)).norm(), 1e-12);
}

TEST_F(IncludeTransform, InertiaAndVelocityTurn) {
  const std::string inner =
      "*PART_INERTIA\nb\n1,1,1\n1.0,0,0,5.0\n10.,1.,2.,20.,3.,30.\n4.0,0,0,0,0,0.5\n";
  const ReadDeck read =
      included(inner, "\n\n\n5\n", "*DEFINE_TRANSFORMATION\n5\nROTATE,0,0,1,0,0,0,90\n");
  EXPECT_EQ(all_problems(read.problems), "");
  const PartInertia& body = *read.deck.parts[0].inertia;
  EXPECT_LT((body.center - Vec3(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((body.velocity - Vec3(0, 4, 0)).norm(), 1e-12);
  EXPECT_LT((body.angular_velocity - Vec3(0, 0, 0.5)).norm(), 1e-12);
  // about z by 90 degrees: x and y change places, xy its sign, xz becomes yz, yz becomes -xz
  EXPECT_NEAR(body.ixx, 20, 1e-12);
  EXPECT_NEAR(body.iyy, 10, 1e-12);
  EXPECT_NEAR(body.izz, 30, 1e-12);
  EXPECT_NEAR(body.ixy, -1, 1e-12);
  EXPECT_NEAR(body.iyz, 2, 1e-12);
  EXPECT_NEAR(body.ixz, -3, 1e-12);
}

TEST_F(IncludeTransform, UnitFactorsKnowTheDimensions) {
  // mm, t, s into m, kg, s
  const std::string inner =
      "$ crosswalk: unit_system=mm-t-s\n*NODE\n1,1000,0,0\n*MAT_ELASTIC\n1,7.8e-9,2.1e5,0.3\n"
      "*MAT_VISCOELASTIC\n2,1e-9,2000.,1.0,0.5,50.\n"
      "*MAT_LOW_DENSITY_FOAM\n3,1e-10,2.0,7\n\n"
      "*DEFINE_CURVE\n7\n0,0\n0.5,3.0\n*DEFINE_CURVE\n8\n0,0\n1,9810.\n*LOAD_BODY_Z\n8\n"
      "*ELEMENT_MASS\n4,1,0.002\n*CONTROL_TERMINATION\n0.1\n*INITIAL_VELOCITY\n0\n500.,0,0\n";
  const ReadDeck read =
      included(inner, "\n\n1000.,1.,0.001\n", "$ crosswalk: unit_system=m-kg-s\n");
  EXPECT_EQ(all_problems(read.problems), "");
  const Deck& d = read.deck;
  EXPECT_EQ(d.units, UnitSystem::MKgS);
  EXPECT_NEAR(d.nodes[0].position.x(), 1, 1e-12);
  EXPECT_NEAR(d.materials[0].density, 7800, 1e-9);
  EXPECT_NEAR(std::get<mat::Elastic>(d.materials[0].law).youngs, 2.1e11, 1);
  EXPECT_NEAR(std::get<mat::Viscoelastic>(d.materials[1].law).shear_short, 1e6, 1e-6);
  EXPECT_NEAR(std::get<mat::Viscoelastic>(d.materials[1].law).decay, 50, 1e-12);
  EXPECT_NEAR(scaled_points(d.curves[0])[1].first, 0.5, 1e-12);
  EXPECT_NEAR(scaled_points(d.curves[0])[1].second, 3e6, 1e-6);
  EXPECT_NEAR(scaled_points(d.curves[1])[1].second, 9.81, 1e-12);
  EXPECT_NEAR(d.masses[0].mass, 2, 1e-12);
  EXPECT_NEAR(*d.control.end_time, 0.1, 1e-15);
  EXPECT_NEAR(d.initial_velocities[0].velocity.x(), 0.5, 1e-12);
}

TEST_F(IncludeTransform, ACurveOfTwoQuantitiesIsRefused) {
  const ReadDeck read = included(
      "*DEFINE_CURVE\n8\n0,0\n1,1\n*LOAD_BODY_Z\n8\n*LOAD_NODE_POINT\n1,1,8\n*NODE\n1,0,0,0\n",
      "\n\n1000.,1.,0.001\n");
  ASSERT_EQ(read.problems.errors.total(), 1);
  EXPECT_THAT(read.problems.errors.kept()[0].text(), testing::HasSubstr("two different"));
}

TEST_F(IncludeTransform, WhatCannotBeDoneIsTold) {
  const auto errors = [&](const std::string& inner, const std::string& cards,
                          const std::string& more = "") {
    const ReadDeck read = included(inner, cards, more);
    return all_problems(read.problems);
  };
  using testing::HasSubstr;
  EXPECT_THAT(errors("*NODE\n1,0,0,0\n", "\n\n\n5\n"), HasSubstr("found none with the number 5"));
  EXPECT_THAT(errors("*NODE\n1,0,0,0\n", "\n\n-1.\n"), HasSubstr("a positive factor"));
  EXPECT_THAT(errors("*NODE\n9,0,0,0\n", "2147483640\n"), HasSubstr("an id outside"));
  EXPECT_THAT(errors("*NODE\n9,0,0,0\n", "\n\n\n5\n", "*DEFINE_TRANSFORMATION\n5\nMIRROR,1,0,0\n"),
              HasSubstr("'MIRROR'"));
  EXPECT_THAT(errors("*NODE\n9,0,0,0\n", "\n\n\n5\n", "*DEFINE_TRANSFORMATION\n5\nSCALE,-1,1,1\n"),
              HasSubstr("keeps volumes positive"));
  EXPECT_THAT(errors("*NODE\n9,0,0,0\n", "\n\n\n5\n", "*DEFINE_TRANSFORMATION\n5\nROTATE,1,2,9\n"),
              HasSubstr("a POINT 1 before its use"));
  EXPECT_THAT(errors("*DEFINE_BOX\n1,0,1,0,1,0,1\n", "\n\n\n5\n",
                     "*DEFINE_TRANSFORMATION\n5\nROTATE,0,0,1,0,0,0,9\n"),
              HasSubstr("a box along the global axes"));
  EXPECT_THAT(errors("*BOUNDARY_SPC_NODE\n1,0,1\n*NODE\n1,0,0,0\n", "\n\n\n5\n",
                     "*DEFINE_TRANSFORMATION\n5\nROTATE,0,0,1,0,0,0,9\n"),
              HasSubstr("warning"));
  EXPECT_THAT(errors("*MAT_FU_CHANG_FOAM\n1,1e-9,1.0\n\n\n\n", "\n\n1.,1.,10.\n"),
              HasSubstr("unknown units"));
  EXPECT_THAT(errors("$ crosswalk: unit_system=mm-t-s\n*NODE\n1,0,0,0\n", "\n",
                     "*CONTROL_UNITS\nm,sec,kg\n"),
              HasSubstr("unit_system=mm-t-s"));
}

TEST_F(IncludeTransform, AMissingFileIsListed) {
  const ReadDeck read = read_deck(file("top.k", "*INCLUDE_TRANSFORM\nshoes.k\n   8000000\n\n\n"));
  EXPECT_TRUE(read.problems.errors.empty());
  ASSERT_EQ(read.deck.missing_includes.size(), 1U);
  EXPECT_EQ(read.deck.missing_includes[0].name, "shoes.k");
  EXPECT_TRUE(read.deck.unread.empty());
}

}  // namespace
}  // namespace crosswalk::fe
