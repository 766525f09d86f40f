// Shape measures on hexahedra whose values follow by hand.
#include "fe_node/generate/quality.h"

#include <cmath>

#include <gtest/gtest.h>

namespace crosswalk::fe::generate {
namespace {

HexCorners brick(double a, double b, double c) {
  return {Vec3(0, 0, 0), Vec3(a, 0, 0), Vec3(a, b, 0), Vec3(0, b, 0),
          Vec3(0, 0, c), Vec3(a, 0, c), Vec3(a, b, c), Vec3(0, b, c)};
}

TEST(HexQuality, Brick) {
  const HexCorners x = brick(2, 3, 4);
  EXPECT_NEAR(volume(x), 24, 1e-12);
  EXPECT_NEAR(scaled_jacobian(x), 1, 1e-12);
  EXPECT_NEAR(aspect_ratio(x), 2, 1e-12);
  EXPECT_NEAR(warpage(x), 0, 1e-12);
  EXPECT_NEAR(characteristic_length(x), 2, 1e-12);
}

TEST(HexQuality, ShearedBrickHasTheSineOfItsAngle) {
  HexCorners x = brick(1, 1, 1);
  for (int c = 4; c < 8; ++c) x[c].x() += 1;  // 45 degrees
  EXPECT_NEAR(scaled_jacobian(x), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(volume(x), 1, 1e-12);
}

TEST(HexQuality, FrustumVolume) {
  HexCorners x = brick(2, 2, 3);
  for (int c = 4; c < 8; ++c) x[c] = Vec3(1, 1, 3) + 0.5 * (x[c] - Vec3(1, 1, 3));
  EXPECT_NEAR(volume(x), 3.0 / 3 * (4 + 1 + 2), 1e-12);  // h/3 (A + B + sqrt(AB))
}

TEST(HexQuality, InvertedCornerIsNegative) {
  HexCorners x = brick(1, 1, 1);
  x[6] = Vec3(0.2, 0.2, 0.2);
  EXPECT_LT(scaled_jacobian(x), 0);
}

TEST(HexQuality, WarpageIsTheFoldOfTheFace) {
  HexCorners x = brick(1, 1, 1);
  x[6].z() += 0.5;
  x[4].z() += 0.5;  // the top folds along its other diagonal
  EXPECT_NEAR(warpage(x), std::acos(1.0 / 3.0), 1e-12);
}

}  // namespace
}  // namespace crosswalk::fe::generate
