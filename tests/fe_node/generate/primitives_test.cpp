// The cubed sphere against its own counts and the volume of the ellipsoid it fills.
#include "fe_node/generate/primitives.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "common/units.h"
#include "fe_node/generate/quality.h"

namespace crosswalk::fe::generate {
namespace {

// A brain-like body, mm: half-axes 79, 69, 78 up, 50 down.
Vec3 brain_like(const Vec3& p) { return {79 * p.x(), 69 * p.y(), (p.z() > 0 ? 78 : 50) * p.z()}; }
const double kVolume = 4.0 / 3.0 * kPi * 79 * 69 * 0.5 * (78 + 50);

MeshDraft ball(int n) {
  MeshDraft draft;
  add_ball(draft, CubedSphere(n), brain_like, [](const BallCell&) { return 1; });
  return draft;
}

TEST(CubedSphere, CountsFollowFromTheLattice) {
  for (const int n : {8, 10, 18}) {
    const MeshDraft draft = ball(n);
    const int layers = radial_layers(n);
    EXPECT_EQ(draft.hexes.size(), n * n * n + 6 * n * n * layers);
    EXPECT_EQ(draft.nodes.size(), (n + 1) * (n + 1) * (n + 1) + layers * (6 * n * n + 2));
  }
}

TEST(CubedSphere, VolumeConvergesToTheEllipsoid) {
  double last_error = 1;
  for (const int n : {6, 8, 12}) {
    const double v = hex_quality(ball(n)).front().volume;
    const double error = 1 - v / kVolume;
    EXPECT_GT(error, 0);                                             // chords lie inside
    EXPECT_LT(error, 1.1 * kPi * kPi / (8.0 * n * n) * 2.0 + 1e-3);  // two sagittas of angle pi/2n
    EXPECT_LT(error, last_error);
    last_error = error;
  }
}

TEST(CubedSphere, WorstCornerDoesNotDependOnRefinement) {
  for (const int n : {6, 8, 12}) {
    const PartQuality q = hex_quality(ball(n)).front();
    EXPECT_GT(q.min_scaled_jacobian, 0.45);
    EXPECT_LT(q.max_aspect, 6.0);
  }
}

TEST(CubedSphere, MidPlaneStaysPlane) {
  const CubedSphere sphere(10);
  for (int k = 0; k <= 10; ++k)
    for (int i = 0; i <= 10; ++i) EXPECT_EQ(sphere.core_position(i, 5, k).y(), 0.0);
}

TEST(CubedSphere, SurfaceIsClosedAndFacesOutwards) {
  const CubedSphere sphere(6);
  std::map<std::pair<int, int>, int> edges;  // directed edge -> count
  for (const auto& quad : sphere.quads()) {
    Vec3 centre = Vec3::Zero();
    for (const int s : quad) centre += sphere.direction(s);
    const Vec3 normal = (sphere.direction(quad[2]) - sphere.direction(quad[0]))
                            .cross(sphere.direction(quad[3]) - sphere.direction(quad[1]));
    EXPECT_GT(normal.dot(centre), 0);
    for (int c = 0; c < 4; ++c) ++edges[{quad[c], quad[(c + 1) % 4]}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

TEST(AddLayer, SharesTheInnerNodesAndMeshesOnlyTheChosenQuads) {
  const CubedSphere sphere(4);
  MeshDraft draft;
  const auto inner = add_ball(
      draft, sphere, [](const Vec3& p) { return p; }, [](const BallCell&) { return 1; });
  const std::size_t before = draft.hexes.size();
  const auto outer = add_layer(
      draft, sphere, inner, [](int quad) { return quad < 16; },
      [&](int s) { return Vec3(1.1 * sphere.direction(s)); }, 2);
  EXPECT_EQ(draft.hexes.size() - before, 16u);
  EXPECT_EQ(std::count_if(outer.begin(), outer.end(), [](int id) { return id >= 0; }), 25);
  EXPECT_GT(hex_quality(draft).back().min_scaled_jacobian, 0.8);
}

TEST(SquareToDisc, EdgesLieOnTheCircleAndNothingFolds) {
  for (double t = -1; t <= 1; t += 0.25) {
    EXPECT_NEAR(square_to_disc(1, t).norm(), 1.0, 1e-12);
    EXPECT_NEAR(square_to_disc(t, -1).norm(), 1.0, 1e-12);
  }
  EXPECT_EQ(square_to_disc(0, 0), Vec3::Zero());
}

}  // namespace
}  // namespace crosswalk::fe::generate
