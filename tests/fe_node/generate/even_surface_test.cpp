// The evened surface of the head: still one sphere, still symmetric, without narrow cells.
#include "fe_node/generate/even_surface.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace crosswalk::fe::generate {
namespace {

const HeadShape kShape({});

/// Shortest over longest height of a quad over its edges, over all quads of the skull's outside.
double narrowest(const CubedSphere& sphere) {
  double least = 1e300, most = 0;
  for (const auto& quad : sphere.quads()) {
    Vec3 x[4];
    for (int c = 0; c < 4; ++c) {
      const HeadShape::Ray ray = kShape.ray(sphere.direction(quad[c]));
      x[c] = ray.skull_outer * ray.direction;
    }
    const double area = 0.5 * (x[2] - x[0]).cross(x[3] - x[1]).norm();
    for (int c = 0; c < 4; ++c) {
      const double height = area / (x[(c + 1) % 4] - x[c]).norm();
      least = std::min(least, height);
      most = std::max(most, height);
    }
  }
  return least / most;
}

CubedSphere evened(int n) {
  CubedSphere sphere(n);
  sphere.set_directions(even_directions(sphere, kShape, 30));
  return sphere;
}

TEST(EvenSurface, NarrowCellsGrow) {
  const double before = narrowest(CubedSphere(10)), after = narrowest(evened(10));
  EXPECT_GT(after, 1.4 * before) << before << " " << after;
}

TEST(EvenSurface, BothHalvesAreMirrorImagesAndTheMidPlaneStays) {
  const CubedSphere sphere = evened(10);
  for (int s = 0; s < sphere.surface_size(); ++s) {
    const auto& [i, j, k] = sphere.lattice(s);
    const Vec3& u = sphere.direction(s);
    EXPECT_NEAR(u.norm(), 1, 1e-15);
    EXPECT_EQ(u, sphere.direction(sphere.surface_index(i, 10 - j, k)).cwiseProduct(Vec3(1, -1, 1)));
    if (j == 5) {
      EXPECT_EQ(u.y(), 0);
    }
  }
}

}  // namespace
}  // namespace crosswalk::fe::generate
