// A head that the generator did not write: the same model renumbered, retitled, in other units and
// axes moves as the generated one does, and what its mapping gets wrong is said at once.
#include "fe_node/own_head.h"

#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/error.h"
#include "fe_node/deck/deck_writer.h"
#include "fe_node/deck/keyword_reader.h"
#include "fe_node/generate/deck_export.h"
#include "fe_node/part_selection.h"
#include "tests/fe_node/node/foreign_deck.h"
#include "tests/fe_node/node/node_fixture.h"

namespace crosswalk::fe {
namespace {

const char* const kNoPane = "[windshield]\nmodel = \"rigid\"\n";

std::string numbers(const Vec3& v) {
  return fmt::format("[{:.9f}, {:.9f}, {:.9f}]", v.x(), v.y(), v.z());
}

struct Foreign {
  std::filesystem::path file;
  std::string mapping;  ///< TOML
};

/// Writes the foreign deck and the tables that map it.
Foreign write_foreign(const FeConfig& generated) {
  generate::HeadNeckSpec spec = generated.head_neck.spec;
  spec.units = UnitSystem::MmKgMs;
  const generate::HeadNeck made = generate::build_head_neck(spec);
  const Deck deck = generate::to_deck(made.draft, spec.units);
  Foreign foreign;
  foreign.file = std::filesystem::path(testing::TempDir()) /
                 fmt::format("foreign_head_{}.k", getpid());  // tests run side by side
  write_deck(foreign.file, foreign_deck(deck));
  foreign.mapping = fmt::format(
      "{}[head_neck]\ndeck = \"{}\"\nunits = \"mm-kg-ms\"\njoint_mm = {}\n"
      "forward_axis = \"-y\"\nup_axis = \"x\"\nskull_nodes = \"CRANIUM INSIDE\"\n"
      "head_parts = \"{}\"\nbrain_parts = \"{}\"\nsurface_parts = \"HUM_SCALP, HUM_FACE, {}\"\n",
      kNoPane, foreign.file.string(), numbers(1e3 * foreign_axes() * made.landmarks.c7_t1),
      foreign_parts(deck, "head"), foreign_parts(deck, "brain"), foreign_part(DeckId(6000)).value);
  return foreign;
}

/// The blocks by title, by number and by title again.
void map_blocks(FeConfig& config) {
  for (InterfaceSpec& interface : config.interfaces) {
    if (interface.body == "torso_up") interface.part = "RIGID T2-T3";
    if (interface.body == "clavicle_l") interface.part = "707002";
    if (interface.body == "clavicle_r") interface.part = "SHOULDER R";
  }
}

TEST(OwnHead, MovesAsTheGeneratedOneItWasMadeFrom) {
  const FeConfig generated = node_config(kNoPane);
  const Foreign foreign = write_foreign(generated);
  {
    std::ifstream file(foreign.file);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(text.find("crosswalk"), std::string::npos);  // nothing tells where it comes from
  }
  FeConfig own = node_config(foreign.mapping);
  map_blocks(own);
  const Twist push{Vec3(500, 2000, 500), Vec3(1000, 0, 2000)};
  DrivenNode a(generated, push, {}), b(own, push, {});
  const FeReply from_a = a.advance(60), from_b = b.advance(60);
  ASSERT_EQ(a.sink.samples.size(), b.sink.samples.size());
  const HeadSample &x = a.sink.samples.back(), &y = b.sink.samples.back();
  const double moved = (x.X_WH.p - a.sink.samples.front().X_WH.p).norm();
  EXPECT_GT(moved, 1e-7);  // ten times what is allowed below
  EXPECT_GT(from_a.internal, 1e-3);
  // Ten digits of a coordinate on a card, 1e-7 of the head's size, leave this.
  EXPECT_LT((x.X_WH.p - y.X_WH.p).norm(), 1e-8);
  EXPECT_LT((x.X_WH.q.coeffs() - y.X_WH.q.coeffs()).norm(), 1e-7);
  EXPECT_LT((x.V_WH.v - y.V_WH.v).norm(), 1e-4 * x.V_WH.v.norm());
  EXPECT_NEAR(from_a.internal, from_b.internal, 1e-5 * from_a.internal);
  for (std::size_t k = 0; k < from_a.loads.size(); ++k)
    EXPECT_LT((from_a.loads[k].impulse - from_b.loads[k].impulse).norm(),
              1e-5 * from_a.loads[0].impulse.norm());
}

TEST(OwnHead, EverythingThatTheMappingMissesIsSaid) {
  const Foreign foreign = write_foreign(node_config(kNoPane));
  FeConfig config = node_config(foreign.mapping);  // blocks not mapped
  config.head_neck.names.brain = "HUM_CEREBRUM_LEFT, HUM_CORTEX";
  config.head_neck.names.skull = "skull";
  try {
    read_own_deck(config);
    FAIL();
  } catch (const UserError& error) {
    const std::string text = error.what();
    for (const char* part : {"interfaces.torso_up.part", "interfaces.clavicle_l.part",
                             "`HUM_CORTEX`", "head_neck.skull_nodes", "`skull`", "the deck has"})
      EXPECT_THAT(text, testing::HasSubstr(part));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("`HUM_CEREBRUM_LEFT`")));
  }
}

TEST(OwnHead, BlockThatDeformsIsRefused) {
  const Foreign foreign = write_foreign(node_config(kNoPane));
  FeConfig config = node_config(foreign.mapping);
  map_blocks(config);
  config.interfaces.front().part = "HUM_SCALP";
  try {
    read_own_deck(config);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("*MAT_RIGID"));
    EXPECT_THAT(error.what(), testing::HasSubstr("which deforms"));
  }
}

TEST(OwnHead, NodeSetCanBeABlock) {
  const Foreign foreign = write_foreign(node_config(kNoPane));
  Deck deck = read_deck(foreign.file).deck;
  DeckSet set;
  set.id = DeckId(77);
  set.title = "LEFT MUSCLE ENDS";
  set.ids = {deck.nodes[0].id, deck.nodes[1].id, deck.nodes[2].id};
  deck.sets.push_back(set);
  FeConfig config = node_config(foreign.mapping);
  map_blocks(config);
  for (InterfaceSpec& interface : config.interfaces)
    if (interface.body == "clavicle_l") interface.part = "LEFT MUSCLE ENDS";
  adapt_deck(deck, config.head_neck, config.interfaces);
  ASSERT_EQ(deck.nodal_rigid_bodies.size(), 1u);
  EXPECT_EQ(deck.nodal_rigid_bodies[0].title, "block_clavicle_l");
  EXPECT_EQ(deck.nodal_rigid_bodies[0].node_set, DeckId(77));
}

}  // namespace
}  // namespace crosswalk::fe
