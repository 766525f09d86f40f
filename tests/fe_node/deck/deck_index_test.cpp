#include "fe_node/deck/deck_index.h"

#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {
namespace {

const char* const kMesh =
    "*NODE\n       1             0.0\n       2             1.0\n       3             2.0\n"
    "       5             5.0\n"
    "*ELEMENT_SHELL\n      10       1       1       2       3\n      11       2       2       3    "
    "   5\n"
    "*DEFINE_BOX\n         1       0.5       9.0      -1.0       1.0      -1.0       1.0\n";

std::vector<int> members(const std::string& sets, SetKind kind, int id,
                         std::vector<std::string>* unknown = nullptr) {
  const Deck deck = sound(kMesh + sets);
  std::vector<int> out;
  for (const DeckId member : DeckIndex(deck).members(kind, DeckId(id), unknown))
    out.push_back(member.value);
  return out;
}

TEST(DeckIndex, FindsByUserNumber) {
  const Deck deck = sound(kMesh);
  const DeckIndex index(deck);
  EXPECT_DOUBLE_EQ(index.node(DeckId(5))->position.x(), 5);
  EXPECT_EQ(index.node(DeckId(4)), nullptr);
  EXPECT_EQ(index.node_index(DeckId(3)), 2);
}

TEST(DeckIndex, ListsRangesAndSums) {
  EXPECT_EQ(members("*SET_NODE\n1\n3,1,3\n", SetKind::Node, 1), (std::vector<int>{3, 1}));
  EXPECT_EQ(members("*SET_NODE_LIST_GENERATE\n1\n2,9\n", SetKind::Node, 1),
            (std::vector<int>{2, 3, 5}));
  EXPECT_EQ(
      members("*SET_NODE_ADD\n1\n2,3\n*SET_NODE\n2\n5\n*SET_NODE\n3\n1,5\n", SetKind::Node, 1),
      (std::vector<int>{5, 1}));
  EXPECT_EQ(members("*SET_PART_COLUMN\n1\n2\n1\n", SetKind::Part, 1), (std::vector<int>{2, 1}));
}

TEST(DeckIndex, SumsThatContainThemselvesEnd) {
  EXPECT_EQ(
      members("*SET_NODE_ADD\n1\n2\n*SET_NODE_ADD\n2\n1,3\n*SET_NODE\n3\n2\n", SetKind::Node, 1),
      (std::vector<int>{2}));
}

TEST(DeckIndex, GeneralRulesTakeAndGive) {
  EXPECT_EQ(members("*SET_NODE_GENERAL\n1\nPART,1\nDNODE,2\n", SetKind::Node, 1),
            (std::vector<int>{1, 3}));
  EXPECT_EQ(members("*SET_NODE_GENERAL\n1\nALL\n", SetKind::Node, 1),
            (std::vector<int>{1, 2, 3, 5}));
  EXPECT_EQ(members("*SET_NODE_GENERAL\n1\nBOX,1\n", SetKind::Node, 1),
            (std::vector<int>{2, 3, 5}));
  EXPECT_EQ(members("*SET_SHELL_GENERAL\n1\nPART,2\nELEM,10\n", SetKind::Shell, 1),
            (std::vector<int>{11, 10}));
}

TEST(DeckIndex, RulesItCannotFollowAreNamed) {
  std::vector<std::string> unknown;
  members("*SET_NODE_GENERAL\n4\nVOLUME,1\n", SetKind::Node, 4, &unknown);
  EXPECT_EQ(unknown, std::vector<std::string>{"set 4: GENERAL option VOLUME"});
}

}  // namespace
}  // namespace crosswalk::fe
