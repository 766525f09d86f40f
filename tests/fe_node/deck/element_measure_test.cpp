#include "fe_node/deck/element_measure.h"

#include <vector>

#include <gtest/gtest.h>

namespace crosswalk::fe {
namespace {

std::vector<Vec3> box(double a, double b, double c) {
  return {{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}, {0, 0, c}, {a, 0, c}, {a, b, c}, {0, b, c}};
}

TEST(ElementMeasure, VolumesOfTheFourShapes) {
  const std::vector<Vec3> hex = box(2, 3, 4);
  EXPECT_DOUBLE_EQ(solid_measure(SolidShape::Hex8, hex).size, 24);
  EXPECT_DOUBLE_EQ(solid_measure(SolidShape::Hex8, hex).worst, 1);
  const std::vector<Vec3> wedge{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}, {2, 0, 4}, {0, 3, 4}};
  EXPECT_DOUBLE_EQ(solid_measure(SolidShape::Penta6, wedge).size, 12);
  const std::vector<Vec3> pyramid{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {1, 1, 4}};
  EXPECT_DOUBLE_EQ(solid_measure(SolidShape::Pyramid5, pyramid).size, 8);
  const std::vector<Vec3> tet{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
  EXPECT_DOUBLE_EQ(solid_measure(SolidShape::Tet4, tet).size, 4);
}

TEST(ElementMeasure, InsideOutIsNegative) {
  std::vector<Vec3> hex = box(1, 1, 1);
  std::swap(hex[1], hex[3]);
  std::swap(hex[5], hex[7]);
  EXPECT_DOUBLE_EQ(solid_measure(SolidShape::Hex8, hex).size, -1);
}

TEST(ElementMeasure, FarFromTheOriginIsAsGood) {
  std::vector<Vec3> hex = box(1e-3, 1e-3, 1e-3);
  for (Vec3& x : hex) x += Vec3(1e3, -1e3, 1e3);
  // Positions near 1e3 hold 1e-3 edges to 1e-13 / 1e-3.
  EXPECT_NEAR(solid_measure(SolidShape::Hex8, hex).size, 1e-9, 1e-18);
}

TEST(ElementMeasure, AConcaveCornerShows) {
  std::vector<Vec3> hex = box(1, 1, 1);
  hex[0] = {0.7, 0.7, 0.7};
  EXPECT_LT(solid_measure(SolidShape::Hex8, hex).worst, 0);
}

TEST(ElementMeasure, Shells) {
  const std::vector<Vec3> quad{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}};
  EXPECT_DOUBLE_EQ(shell_measure(quad).size, 6);
  const std::vector<Vec3> triangle{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
  EXPECT_DOUBLE_EQ(shell_measure(triangle).size, 3);
  const std::vector<Vec3> crossed{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {2, 3, 0}};
  EXPECT_LE(shell_measure(crossed).worst, 0);
}

}  // namespace
}  // namespace crosswalk::fe
