// Generated windshields: size, mass, normals and numbering.
#include "fe_node/generate/windshield.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "common/error.h"
#include "fe_node/generate/mass_report.h"
#include "fe_node/generate/part_ids.h"

namespace crosswalk::fe::generate {
namespace {

TEST(Windshield, FiveMillimetresGiveTheSizeOfThePaper) {
  WindshieldSpec spec;
  spec.cell = 0.005;
  const ModelDraft draft = build_windshield(spec);
  // 54 000 nodes and 58 000 elements there [yu2020, App. A]; the pane's size is not published.
  EXPECT_NEAR(static_cast<double>(draft.mesh.nodes.size()), 54e3, 6e3);
  EXPECT_NEAR(static_cast<double>(draft.mesh.quads.size()), 58e3, 8e3);
}

TEST(Windshield, WeighsItsAreaTimesItsPlies) {
  WindshieldSpec spec;
  spec.cell = 0.020;
  const double area = spec.width * 0.88685;  // between (1070, 990) and (1840, 1430)
  EXPECT_NEAR(inertia_of(build_windshield(spec), {part::kWindshield}, false).mass,
              area * spec.panel_thickness * 7850, 1e-3);
  spec.kind = WindshieldKind::Laminated;
  EXPECT_NEAR(inertia_of(build_windshield(spec), {part::kWindshield}, false).mass, area * 11.336,
              1e-2);
}

TEST(Windshield, NormalsPointOutwardsAndUp) {
  WindshieldSpec spec;
  spec.cell = 0.050;
  spec.sagitta = 0.04;
  const ModelDraft draft = build_windshield(spec);
  const auto& x = draft.mesh.nodes;
  for (const Quad& quad : draft.mesh.quads) {
    const Vec3 normal =
        (x[quad.node[2]] - x[quad.node[0]]).cross(x[quad.node[3]] - x[quad.node[1]]);
    EXPECT_GT(normal.z(), 0);
    EXPECT_LT(normal.normalized().x(), -0.2);
  }
}

TEST(Windshield, LaminateRuleFillsTheThickness) {
  WindshieldSpec spec;
  spec.kind = WindshieldKind::Laminated;
  spec.cell = 0.1;
  const Deck deck = generate_windshield(spec);
  ASSERT_EQ(deck.integrations.size(), 1u);
  double sum = 0, moment = 0;
  for (const IntegrationPoint& row : deck.integrations[0].rows) {
    sum += row.weight;
    moment += row.weight * row.position * row.position;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  const double pvb = spec.pvb_thickness / (2 * spec.glass_thickness + spec.pvb_thickness);
  EXPECT_NEAR(moment, (1 - pvb * pvb * pvb) / 3, 1e-12);  // bending, but for the interlayer's own
}

TEST(Windshield, GlassIsIntegratedFullyAndSheetAtOnePoint) {
  WindshieldSpec spec;
  spec.cell = 0.1;
  for (const auto& [kind, elform] :
       {std::pair{WindshieldKind::Laminated, 16}, std::pair{WindshieldKind::Panel, 2}}) {
    spec.kind = kind;
    const Deck deck = generate_windshield(spec);
    const auto pane = std::find_if(deck.parts.begin(), deck.parts.end(),
                                   [](const Part& part) { return part.title == "windshield"; });
    ASSERT_NE(pane, deck.parts.end());
    const auto section = std::find_if(deck.sections.begin(), deck.sections.end(),
                                      [&](const Section& s) { return s.id == pane->section; });
    ASSERT_NE(section, deck.sections.end());
    EXPECT_EQ(std::get<SectionShell>(section->law).formulation, elform);
  }
}

/// A head of somebody's own: numbers where the generators' lie, and beyond.
Deck own_deck() {
  Deck deck;
  deck.units = UnitSystem::MmKgMs;
  deck.nodes.resize(1);
  deck.nodes[0].id = DeckId(5'000'000);
  deck.shells.resize(1);
  deck.shells[0].id = DeckId(7'000'000);
  deck.parts.resize(1);
  deck.parts[0].id = DeckId(part::kWindshield);
  deck.materials.resize(1);
  deck.materials[0].id = DeckId(part::kBlockBuck);
  deck.sets.resize(1);
  deck.sets[0].kind = SetKind::Part;
  deck.sets[0].id = DeckId(8003);
  deck.sets[0].title = "skin";
  deck.sets[0].ids = {DeckId(part::kWindshield)};
  return deck;
}

TEST(Windshield, JoinsADeckClearOfItsNumbers) {
  Deck deck = own_deck();
  WindshieldSpec spec;
  spec.cell = 0.1;
  spec.units = deck.units;
  join_windshield(deck, spec, "skin", 0.3);
  const auto are_unique = [](const auto& records) {
    std::set<int> ids;
    for (const auto& record : records)
      if (!ids.insert(record.id.value).second) return false;
    return true;
  };
  EXPECT_TRUE(are_unique(deck.nodes));
  EXPECT_TRUE(are_unique(deck.shells));
  EXPECT_TRUE(are_unique(deck.parts));
  EXPECT_TRUE(are_unique(deck.materials));
  EXPECT_TRUE(are_unique(deck.sets));
  EXPECT_EQ(deck.nodes.front().id, DeckId(5'000'000));  // the head's nodes stay first
  ASSERT_EQ(deck.contacts.size(), 1u);
  EXPECT_EQ(deck.contacts[0].slave.id, DeckId(8003));
  std::set<int> parts;
  for (const Part& p : deck.parts) parts.insert(p.id.value);
  for (const ShellElement& shell : deck.shells)
    EXPECT_TRUE(shell.id == DeckId(7'000'000) || parts.count(shell.part.value) > 0);
  for (const DeckSet& set : deck.sets)
    for (const DeckId id : set.ids) EXPECT_TRUE(parts.count(id.value)) << set.title;
}

TEST(Windshield, HeadSurfaceThatIsNotThereIsNamed) {
  Deck deck = own_deck();
  WindshieldSpec spec;
  spec.cell = 0.1;
  EXPECT_THROW(join_windshield(deck, spec, "scalp", 0.3), UserError);
}

}  // namespace
}  // namespace crosswalk::fe::generate
