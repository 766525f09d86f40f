#include "fe_node/deck/deck.h"

#include <gtest/gtest.h>

namespace crosswalk::fe {
namespace {

SolidElement solid(std::initializer_list<int> nodes) {
  SolidElement element{.id = DeckId(1), .part = DeckId(1), .nodes = {}, .source = {}};
  std::size_t i = 0;
  for (const int node : nodes) element.nodes[i++] = DeckId(node);
  return element;
}

std::vector<int> nodes_of(const ShapedSolid& shaped) {
  std::vector<int> out;
  for (int i = 0; i < shaped.count; ++i)
    out.push_back(shaped.nodes[static_cast<std::size_t>(i)].value);
  return out;
}

TEST(SolidShape, TellsDegenerateHexahedra) {
  EXPECT_EQ(solid_shape(solid({1, 2, 3, 4, 5, 6, 7, 8})).shape, SolidShape::Hex8);
  const ShapedSolid wedge = solid_shape(solid({1, 2, 3, 4, 5, 5, 6, 6}));
  EXPECT_EQ(wedge.shape, SolidShape::Penta6);
  EXPECT_EQ(nodes_of(wedge), (std::vector<int>{1, 5, 2, 4, 6, 3}));
  const ShapedSolid side = solid_shape(solid({1, 2, 3, 3, 5, 6, 7, 7}));
  EXPECT_EQ(nodes_of(side), (std::vector<int>{1, 2, 3, 5, 6, 7}));
  EXPECT_EQ(solid_shape(solid({1, 2, 3, 4, 5, 5, 5, 5})).shape, SolidShape::Pyramid5);
  const ShapedSolid tet = solid_shape(solid({1, 2, 3, 4, 4, 4, 4, 4}));
  EXPECT_EQ(tet.shape, SolidShape::Tet4);
  EXPECT_EQ(nodes_of(tet), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(nodes_of(solid_shape(solid({1, 2, 3, 3, 4, 4, 4, 4}))), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(solid_shape(solid({1, 2, 3, 4, 5, 6, 7, 8, 9, 10})).shape, SolidShape::Tet10);
  EXPECT_EQ(solid_shape(solid({1, 2, 3, 4})).shape, SolidShape::Tet4);
  EXPECT_EQ(solid_shape(solid({1, 1, 3, 4, 5, 6, 7, 8})).shape, SolidShape::Other);
}

TEST(UnitFactors, DerivedUnitsAreTheFieldsOnes) {
  const UnitFactors kilo = unit_factors(UnitSystem::MmKgMs);
  EXPECT_DOUBLE_EQ(kilo.force(), 1e3);     // kN
  EXPECT_NEAR(kilo.stress(), 1e9, 1e-3);   // GPa
  EXPECT_NEAR(kilo.density(), 1e9, 1e-3);  // kg/mm3
  EXPECT_DOUBLE_EQ(kilo.energy(), 1);      // J
  const UnitFactors tonne = unit_factors(UnitSystem::MmTonneS);
  EXPECT_DOUBLE_EQ(tonne.force(), 1);                                           // N
  EXPECT_NEAR(tonne.stress(), 1e6, 1e-6);                                       // MPa
  EXPECT_NEAR(unit_factors(UnitSystem::InchSlinchS).stress(), 6894.757, 1e-3);  // psi
  EXPECT_EQ(unit_system_from("mm-kg-ms"), UnitSystem::MmKgMs);
  EXPECT_EQ(unit_system_from("kg"), UnitSystem::Unknown);
}

TEST(DeckCurve, OffsetThenScale) {
  DeckCurve curve;
  curve.x_scale = 2;
  curve.x_offset = 1;
  curve.y_scale = -1;
  curve.points = {{0, 3}, {1, 4}};
  EXPECT_EQ(scaled_points(curve), (std::vector<std::pair<double, double>>{{2, -3}, {4, -4}}));
}

TEST(Contact, KindsByKeyword) {
  EXPECT_EQ(contact_named("AUTOMATIC_SURFACE_TO_SURFACE").kind, ContactKind::SurfaceToSurface);
  EXPECT_EQ(contact_named("TIED_NODES_TO_SURFACE_CONSTRAINED_OFFSET").kind,
            ContactKind::TiedNodesToSurface);
  EXPECT_TRUE(contact_named("TIED_NODES_TO_SURFACE_OFFSET").has_offset);
  EXPECT_TRUE(contact_named("ERODING_NODES_TO_SURFACE").is_eroding);
  EXPECT_EQ(contact_named("AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE_TIEBREAK").kind,
            ContactKind::OneWaySurfaceToSurface);
  EXPECT_EQ(contact_named("DRAWBEAD").kind, ContactKind::Unsupported);
}

TEST(Deck, PlacesDoNotCountInComparisons) {
  Deck a, b;
  a.nodes.emplace_back().source = {.file = 0, .line = 3};
  b.nodes.emplace_back().source = {.file = 2, .line = 9};
  EXPECT_EQ(a, b);
  b.nodes[0].position.x() = 1;
  EXPECT_NE(a, b);
}

}  // namespace
}  // namespace crosswalk::fe
