#include "fe_node/contact/pair.h"

#include <limits>

#include <gtest/gtest.h>

#include "fe_node/contact/broad_phase.h"
#include "fe_node/contact/surface.h"
#include "tests/fe_node/box_model.h"
#include "tests/fe_node/plate_model.h"

namespace crosswalk::fe {
namespace {

const FacetCorners kSquare{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
const FacetCorners kWarped{Vec3(0, 0, 0.1), Vec3(1, 0.1, -0.1), Vec3(1.2, 1, 0.2), Vec3(0, 1, 0)};
const FacetCorners kTriangle{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0.5), Vec3(0, 1, 0.5)};

/// A repeatable number in (-1, 1).
double noise(int i) { return std::sin(12.9898 * i + 0.3) * std::cos(78.233 * i); }
Vec3 noise3(int i) { return {noise(3 * i), noise(3 * i + 1), noise(3 * i + 2)}; }

TEST(Segment, FindsFaceEdgesAndCorners) {
  const struct {
    Vec3 p, point;
    double distance;
  } cases[] = {{{0.3, 0.4, 0.2}, {0.3, 0.4, 0}, 0.2},    {{0.3, 0.4, -0.2}, {0.3, 0.4, 0}, 0.2},
               {{1.5, 0.5, 0}, {1, 0.5, 0}, 0.5},        {{0.5, -0.3, 0.4}, {0.5, 0, 0}, 0.5},
               {{1.3, 1.4, 0}, {1, 1, 0}, 0.5},          {{-0.3, -0.4, 0}, {0, 0, 0}, 0.5},
               {{0.5, 0.5, 0}, {0.5, 0.5, 0}, 0},        {{1 + 1e-12, 0.5, 0}, {1, 0.5, 0}, 1e-12},
               {{1 - 1e-12, 0.5, 0.1}, {1, 0.5, 0}, 0.1}};
  for (const auto& c : cases) {
    const Projection found = closest_point(c.p, kSquare, false);
    EXPECT_LT((found.point - c.point).norm(), 2e-12);
    EXPECT_NEAR(found.distance, c.distance, 1e-12);
    EXPECT_NEAR(found.normal.z(), 1, 1e-14);
  }
}

TEST(Segment, WeightsGiveThePointAndNoPointIsNearer) {
  for (const auto& [x, is_triangle] :
       {std::pair{kSquare, false}, std::pair{kWarped, false}, std::pair{kTriangle, true}})
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = Vec3(0.5, 0.5, 0) + 1.5 * noise3(i);
      const Projection found = closest_point(p, x, is_triangle);
      Vec3 point = Vec3::Zero();
      double sum = 0;
      for (int c = 0; c < 4; ++c) {
        point += found.weight[c] * x[c];
        sum += found.weight[c];
        EXPECT_GE(found.weight[c], -1e-14);
      }
      EXPECT_NEAR(sum, 1, 1e-14);
      EXPECT_LT((point - found.point).norm(), 1e-14);
      EXPECT_NEAR((p - found.point).norm(), found.distance, 1e-14);
      const DistanceBounds bounds = distance_bounds(p, x);
      EXPECT_LE(bounds.least, found.distance + 1e-14);
      EXPECT_GE(bounds.most, found.distance - 1e-14);
      for (int k = 0; k < 20; ++k) {  // random points of the facet are no nearer
        const Vec3 w = (noise3(7 * i + k) + Vec3::Ones()) / 2;
        const Vec3 centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
        const Vec3 q =
            (w[0] * x[k % 4] + w[1] * x[(k + 1) % 4] + w[2] * (is_triangle ? x[k % 3] : centre)) /
            w.sum();
        EXPECT_GE((p - q).norm(), found.distance - 1e-12);
      }
    }
}

TEST(Segment, WeightGradientsReproduceThePlane) {
  for (int sector = 0; sector < 4; ++sector) {
    const std::array<Vec3, 4> g = weight_gradients(kWarped, false, sector);
    EXPECT_LT((g[0] + g[1] + g[2] + g[3]).norm(), 1e-14);
    const Vec3 centre = 0.25 * (kWarped[0] + kWarped[1] + kWarped[2] + kWarped[3]);
    for (const Vec3& q :
         {Vec3(kWarped[sector] - centre), Vec3(kWarped[(sector + 1) % 4] - centre)}) {
      Vec3 sum = Vec3::Zero();
      for (int i = 0; i < 4; ++i) sum += kWarped[i] * g[i].dot(q);
      EXPECT_LT((sum - q).norm(), 1e-14);
    }
  }
}

TEST(Pair, ForcesBalanceAndTheirPowerIsThatOfTheRelativeVelocity) {
  for (const auto& [x, is_triangle] : {std::pair{kWarped, false}, std::pair{kTriangle, true}})
    for (int i = 0; i < 50; ++i) {
      const Vec3 p = Vec3(0.5, 0.4, 0.3) + 0.6 * noise3(i);
      const Projection projection = closest_point(p, x, is_triangle);
      const PairFrame frame = pair_frame(x, is_triangle, projection,
                                         (p - projection.point).normalized(), projection.distance);
      Vec3 force = noise3(i + 1000);
      if (!frame.carries_friction) force = frame.u * frame.u.dot(force);
      const PairForces f = balanced_forces(frame, force);
      Vec3 sum = f.on_node, moment = p.cross(f.on_node);
      std::array<Vec3, 4> velocity;
      const Vec3 node_velocity = noise3(i + 2000);
      double power = f.on_node.dot(node_velocity);
      for (int c = 0; c < 4; ++c) {
        sum += f.on_corner[c];
        moment += x[c].cross(f.on_corner[c]);
        velocity[c] = noise3(10 * i + c + 3000);
        power += f.on_corner[c].dot(velocity[c]);
      }
      EXPECT_LT(sum.norm(), 1e-14);
      EXPECT_LT(moment.norm(), 1e-13);
      EXPECT_NEAR(power, force.dot(relative_velocity(frame, node_velocity, velocity)), 1e-13);
    }
}

TEST(Pair, RigidMotionOfBothSlipsNothing) {
  const Vec3 p(0.4, 0.5, 0.3), w(0.3, -0.2, 0.5), v(1, 2, 3);
  const Projection projection = closest_point(p, kWarped, false);
  const PairFrame frame = pair_frame(kWarped, false, projection,
                                     (p - projection.point).normalized(), projection.distance);
  std::array<Vec3, 4> velocity;
  for (int c = 0; c < 4; ++c) velocity[c] = v + w.cross(kWarped[c]);
  EXPECT_LT(relative_velocity(frame, v + w.cross(p), velocity).norm(), 1e-14);
}

TEST(Pair, StickIsElasticAndSlipDissipatesExactlyMuN) {
  PairFrame frame;
  frame.u = Vec3::UnitZ();
  const PairLaw law{1e5, 0, 0.4, 0.3, 1e9};  // slips at the dynamic coefficient
  Vec3 friction = Vec3::Zero();
  const double penetration = 1e-3, normal = 100, dt = 1e-6;
  double dissipated = 0;
  PairAnswer answer;
  for (int i = 0; i < 1000; ++i) {
    answer = touch(law, frame, penetration, {2, 0, 0}, friction, dt);
    friction = answer.friction;
    dissipated += answer.friction_dissipated;
  }
  EXPECT_NEAR(friction.x(), -0.3 * normal, 1e-9);
  EXPECT_NEAR(answer.stored, 0.5 * 1e5 * 1e-6 + 0.5 * 900 / 1e5, 1e-12);
  // the path of 2 mm less the 0.3 mm of elastic stick
  EXPECT_NEAR(dissipated, 30 * (2e-3 - 0.3e-3), 30 * 2e-6);
  const PairAnswer back = touch(law, frame, penetration, {-2, 0, 0}, friction, 1e-5);
  EXPECT_NEAR(back.friction_dissipated, 0, 1e-15);  // sticking again
}

TEST(Pair, DampingNeverPullsTheSurfacesTogether) {
  PairFrame frame;
  frame.u = Vec3::UnitZ();
  const PairLaw law{1e5, 100, 0, 0, 0};
  EXPECT_EQ(touch(law, frame, 1e-6, {0, 0, 5}, Vec3::Zero(), 1e-6).force.norm(), 0);
  const PairAnswer closing = touch(law, frame, 1e-3, {0, 0, -1}, Vec3::Zero(), 1e-6);
  EXPECT_NEAR(closing.force.z(), 200, 1e-9);
  EXPECT_NEAR(closing.damping_dissipated, 100 * 1e-6, 1e-12);
}

TEST(BroadPhase, GridFindsWhatBruteForceFinds) {
  std::vector<Box3> boxes(300);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = 3 * noise3(i);
    boxes[i].add(p);
    boxes[i].add(p + 0.3 * noise3(i + 500));
  }
  Box3 region;
  region.add(Vec3(-2, -2, -3));
  region.add(Vec3(2, 3, 2));
  const BoxGrid grid(boxes, region);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = 3 * noise3(i + 9000);
    std::vector<int> found, expected;
    grid.find(p, found);
    if (region.contains(p))
      for (int b = 0; b < 300; ++b)
        if (boxes[b].contains(p)) expected.push_back(b);
    EXPECT_EQ(found, expected);
    hits += static_cast<int>(found.size());
  }
  EXPECT_GT(hits, 20);
}

TEST(BroadPhase, BoxesBeyondAllNumbersHideNoOthers) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(),
                   kFar = std::numeric_limits<double>::infinity();
  std::vector<Box3> boxes(4);
  boxes[0].add({0, 0, 0});
  boxes[0].add({1, 1, 1});
  boxes[1].low = Vec3::Constant(kNone), boxes[1].high = Vec3::Constant(kNone);
  boxes[2].low = Vec3::Constant(-kFar), boxes[2].high = Vec3::Constant(kFar);
  boxes[3].low = Vec3::Zero(), boxes[3].high = {kFar, 1, 1};
  Box3 region;
  region.add({-1, -1, -1});
  region.add({2, 2, 2});
  std::vector<int> found;
  BoxGrid(boxes, region).find({0.5, 0.5, 0.5}, found);
  EXPECT_EQ(found, (std::vector<int>{0, 2, 3}));
  found.clear();
  region.high.x() = kFar;  // a node has left: the run is stopped elsewhere
  BoxGrid(boxes, region).find({0.5, 0.5, 0.5}, found);
  EXPECT_TRUE(found.empty());
}

TEST(Surface, SkinOfABrickHasItsOuterFacesLookingOut) {
  const Box box{3, 4, 5, {3, 4, 5}};
  const Mesh mesh = box_mesh(box);
  const ContactPart part{0, 1e9, 0, {}};
  const ContactSurface skin = surface_of(mesh, {&part, 1});
  EXPECT_EQ(skin.facets.size(), 2u * (3 * 4 + 4 * 5 + 5 * 3));
  EXPECT_EQ(skin.nodes.size(), 4u * 5 * 6 - 2u * 3 * 4);
  for (const ContactFacet& facet : skin.facets) {
    const FacetCorners x{mesh.position[facet.node[0]], mesh.position[facet.node[1]],
                         mesh.position[facet.node[2]], mesh.position[facet.node[3]]};
    const Vec3 centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    EXPECT_GT((x[2] - x[0]).cross(x[3] - x[1]).dot(centre - Vec3(1.5, 2, 2.5)), 0);
    EXPECT_NEAR(facet.stiffness, 1e9, 1);  // K A^2 / V of a unit cube
    EXPECT_FALSE(facet.is_two_sided);
  }
}

TEST(Surface, ShellsTakeThePlaceOfTheFacesTheyCover) {
  Mesh mesh = box_mesh({2, 2, 1, {2, 2, 1}});
  ElementTable& quads = mesh.table(ElementKind::Quad4);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const int a = 9 + 3 * j + i;
      quads.nodes.insert(quads.nodes.end(), {a, a + 1, a + 4, a + 3});
      quads.part.push_back(1);
      quads.id.push_back(DeckId{100 + quads.size()});
    }
  mesh.parts.push_back({DeckId{2}, "skin", false});
  const ContactPart parts[] = {{0, 1e9, 0, {}}, {1, 1e9, 0.1, {}}};
  const ContactSurface skin = surface_of(mesh, parts);
  EXPECT_EQ(skin.facets.size(), 4u + 4u + 8u);
  int shells = 0;
  for (const ContactFacet& facet : skin.facets) shells += facet.is_two_sided ? 1 : 0;
  EXPECT_EQ(shells, 4);
  for (const ContactNode& node : skin.nodes)
    EXPECT_EQ(node.half_thickness, node.node >= 9 ? 0.05 : 0);
}

}  // namespace
}  // namespace crosswalk::fe
