// Contact geometry against closed forms; ellipsoid pairs against a brute-force search of normals.
#include "mb_node/surface_contact.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/units.h"
#include "tests/common/subject_fixture.h"

namespace crosswalk::mb {
namespace {

const Vec3 kAxes(0.12, 0.07, 0.2);
const Mat3 kRotation = exp_rotation({0.4, -0.9, 0.6}).toRotationMatrix();

PosedEllipsoid sphere(const Vec3& p, double r) { return {p, Mat3::Identity(), Vec3::Constant(r)}; }

double surface_residual(const PosedEllipsoid& e, const Vec3& point) {
  return (point - e.centre).dot(e.A.inverse() * (point - e.centre)) - 1;
}

TEST(Overlap, OfASphereWithAPlaneIsRadiusMinusHeight) {
  const auto o = overlap_with_plane(sphere({1, 2, 0.07}, 0.1), Vec3::UnitZ(), Vec3::Zero());
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->depth, 0.03, 1e-15);
  EXPECT_NEAR((o->point - Vec3(1, 2, -0.03)).norm(), 0, 1e-15);
  EXPECT_FALSE(overlap_with_plane(sphere({1, 2, 0.101}, 0.1), Vec3::UnitZ(), Vec3::Zero()));
}

TEST(Overlap, OfAnEllipsoidWithAPlaneTouchesAtItsLowestPoint) {
  const PosedEllipsoid e({0, 0, 0.05}, kRotation, kAxes);
  const auto o = overlap_with_plane(e, Vec3::UnitZ(), Vec3::Zero());
  ASSERT_TRUE(o);
  EXPECT_NEAR(surface_residual(e, o->point), 0, 1e-12);
  EXPECT_NEAR(o->point.z(), -o->depth, 1e-15);
}

TEST(Overlap, OfSphereAndCylinderIsTheGapOfTheirAxes) {
  const Vec3 axis = Vec3(1, 2, 0.5).normalized();
  const Vec3 away = axis.unitOrthogonal();
  const auto o =
      overlap_with_cylinder(sphere(0.3 * axis + 0.14 * away, 0.1), Vec3::Zero(), axis, 0.06);
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->depth, 0.02, 1e-12);
  EXPECT_NEAR((o->normal - away).norm(), 0, 1e-9);
  EXPECT_FALSE(overlap_with_cylinder(sphere(0.17 * away, 0.1), Vec3::Zero(), axis, 0.06));
}

TEST(Overlap, OfEllipsoidAndCylinderIsTheShortestWayOut) {
  const PosedEllipsoid e({0.12, 0.03, 0}, kRotation, kAxes);
  const auto o = overlap_with_cylinder(e, Vec3::Zero(), Vec3::UnitZ(), 0.05);
  ASSERT_TRUE(o);
  double best = 1e9;
  for (int i = 0; i < 100000; ++i) {
    const double a = 2 * kPi * i / 100000;
    const Vec3 n(std::cos(a), std::sin(a), 0);
    best = std::min(best, std::sqrt(n.dot(e.A * n)) + 0.05 - e.centre.dot(n));
  }
  EXPECT_NEAR(o->depth, best, 1e-9);
}

TEST(Overlap, OfTwoSpheresIsTheSumOfRadiiMinusDistance) {
  const Vec3 d = Vec3(0.1, -0.05, 0.08);
  const auto o = overlap_with_ellipsoid(sphere(d, 0.1), sphere(Vec3::Zero(), 0.06));
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->depth, 0.16 - d.norm(), 1e-13);
  EXPECT_NEAR((o->normal - d.normalized()).norm(), 0, 1e-9);
  EXPECT_FALSE(overlap_with_ellipsoid(sphere(2 * d, 0.1), sphere(Vec3::Zero(), 0.06)));
}

TEST(Overlap, OfEllipsoidsIsTheShortestWayOut) {
  for (const Vec3& centre :
       {Vec3(0.15, 0.05, 0.03), Vec3(0.02, 0.16, 0.2), Vec3(-0.1, 0.0, 0.28)}) {
    const PosedEllipsoid first(centre, kRotation, kAxes);
    const PosedEllipsoid second(Vec3::Zero(), Mat3::Identity(), {0.08, 0.15, 0.1});
    const auto o = overlap_with_ellipsoid(first, second);
    double best = 1e9;
    const int n = 500;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double z = -1 + 2 * (i + 0.5) / n, a = 2 * kPi * j / n, r = std::sqrt(1 - z * z);
        const Vec3 u(r * std::cos(a), r * std::sin(a), z);
        best = std::min(
            best, std::sqrt(u.dot(first.A * u)) + std::sqrt(u.dot(second.A * u)) - centre.dot(u));
      }
    }
    if (best <= 0) {
      EXPECT_FALSE(o);
      continue;
    }
    ASSERT_TRUE(o);
    EXPECT_NEAR(o->depth, best, 2e-5);  // resolution of the search
    EXPECT_NEAR(surface_residual(first, o->point), 0, 1e-12);
  }
}

class SedanFront : public testing::Test {
 protected:
  VehicleFront front = load_front("generic_sedan_buck");
  std::vector<FrontChain> chains = convex_chains(front);
  std::optional<FrontOverlap> touch(const PosedEllipsoid& e) {
    std::optional<FrontOverlap> found;
    count = 0;
    for (const FrontChain& chain : chains) {
      if (const auto o = overlap_with_front(e, front, chain, {})) {
        found = o;
        ++count;
      }
    }
    return found;
  }
  std::string component(const FrontOverlap& o) { return front.facets[o.facet].component; }
  int count = 0;
};

TEST_F(SedanFront, SplitsIntoConvexChains) {
  // Lower bumper; bumper; grille to the rear edge of the hood; cowl; glass.
  ASSERT_EQ(chains.size(), 5u);
  EXPECT_EQ(chains[2].facets.size(), 5u);
  EXPECT_TRUE(chains[0].is_open_begin && chains[0].is_open_end);
  EXPECT_FALSE(chains[2].is_open_begin || chains[2].is_open_end);
  EXPECT_TRUE(chains[4].is_open_end);
}

TEST_F(SedanFront, SphereOnTheHoodHasTheDepthAlongItsNormal) {
  const FrontFacet& hood = front.facets[11];
  ASSERT_EQ(hood.component, "hood");
  const Eigen::Vector2d centre = 0.5 * (hood.begin + hood.end) + 0.07 * hood.normal;
  const auto o = touch(sphere({0.2, centre.x(), centre.y()}, 0.1));
  ASSERT_TRUE(o);
  EXPECT_EQ(count, 1);
  EXPECT_EQ(component(*o), "hood");
  EXPECT_NEAR(o->overlap.depth, 0.03, 1e-12);
}

TEST_F(SedanFront, SphereAtTheNoseTouchesItsVertex) {
  // In the cone of normals of vertex (88, 730): the way out is from the vertex to the centre.
  const Eigen::Vector2d vertex(-0.088, 0.730);
  const Eigen::Vector2d n = (front.facets[8].normal + front.facets[9].normal).normalized();
  ASSERT_EQ(front.facets[8].component, "hood_edge");
  const Eigen::Vector2d centre = vertex + 0.09 * n;
  const auto o = touch(sphere({0, centre.x(), centre.y()}, 0.1));
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->overlap.depth, 0.01, 1e-9);
  EXPECT_NEAR(o->overlap.normal.y(), n.x(), 1e-9);
}

TEST_F(SedanFront, DepthIsContinuousAlongTheFront) {
  // A head-sized ellipsoid carried along the hood edge at constant overlap of its path.
  double before = -1;
  for (double s = 0; s < 1; s += 1e-3) {
    const Vec3 p(0, 0.02 - 0.3 * s, 0.70 + 0.17 * s);
    const PosedEllipsoid e(p, kRotation, {0.1, 0.08, 0.09});
    const auto o = touch(e);
    const double depth = o ? o->overlap.depth : 0;
    if (before >= 0) {
      EXPECT_LT(std::abs(depth - before), 1e-3) << s;
    }
    before = depth;
  }
}

TEST_F(SedanFront, ARoofGoesOnLevelBehindTheGlass) {
  // Over the upper edge of the glass and on: the depth changes by no more than the way, and behind
  // the edge it is that in a plane at the edge's height.
  const Eigen::Vector2d edge = front.facets.back().end;
  const Vec3 on_edge(0, edge.x(), edge.y()), way(0, -0.5, 0.02);
  double before = -1;
  for (double s = 0; s < 1; s += 1e-3) {
    const PosedEllipsoid e(on_edge + Vec3(0, 0.06, 0.03) + s * way, kRotation, {0.1, 0.08, 0.09});
    const auto o = touch(e);
    ASSERT_TRUE(o) << s;
    if (before >= 0) {
      EXPECT_LE(std::abs(o->overlap.depth - before), 1.01e-3 * way.norm()) << s;
    }
    if (s > 0.8) {
      EXPECT_NEAR(o->overlap.depth, overlap_with_plane(e, Vec3::UnitZ(), on_edge)->depth, 1e-12);
    }
    before = o->overlap.depth;
  }
}

TEST_F(SedanFront, IsLeftAtTheSides) {
  const FrontFacet& hood = front.facets[11];
  const Eigen::Vector2d centre = 0.5 * (hood.begin + hood.end);
  EXPECT_TRUE(touch(sphere({0.69, centre.x(), centre.y()}, 0.05)));
  EXPECT_FALSE(touch(sphere({0.71, centre.x(), centre.y()}, 0.05)));
}

TEST_F(SedanFront, MovesWithTheCar) {
  const Pose X_WF{exp_rotation({0.05, 0, 0}), Vec3(0.1, 3, 0.02)};
  const FrontFacet& glass = front.facets.back();
  const Eigen::Vector2d centre = 0.5 * (glass.begin + glass.end) + 0.05 * glass.normal;
  const auto o = [&] {
    for (const FrontChain& chain : chains) {
      const auto found = overlap_with_front(sphere(X_WF * Vec3(0, centre.x(), centre.y()), 0.08),
                                            front, chain, X_WF);
      if (found) return found;
    }
    return std::optional<FrontOverlap>();
  }();
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->overlap.depth, 0.03, 1e-12);
  EXPECT_NEAR(
      (X_WF.R().transpose() * o->overlap.normal - Vec3(0, glass.normal.x(), glass.normal.y()))
          .norm(),
      0, 1e-12);
}

}  // namespace
}  // namespace crosswalk::mb
