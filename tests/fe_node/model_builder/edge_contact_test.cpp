// Contact between edges from the deck to the motion: what crosses between its nodes does not pass,
// momenta and energy are kept, and nothing near costs nothing.
#include "fe_node/contact/edge_contact.h"

#include <cmath>

#include <fmt/format.h>

#include "fe_node/contact/edge_pair.h"
#include "fe_node/solver.h"
#include "tests/fe_node/model_builder/built_deck.h"

namespace crosswalk::fe {
namespace {

TEST(EdgePair, ForcesBalanceAndARigidRotationSlipsNothing) {
  const EdgeEnds p{Vec3(-1, 0.2, 0.1), Vec3(1.5, -0.1, 0.3)},
      q{Vec3(0.1, -1, -0.2), Vec3(0.4, 1.2, 0)};
  const EdgePair pair = closest_pair(p, q);
  ASSERT_TRUE(pair.is_between && pair.carries_friction);
  EXPECT_NEAR(pair.u.dot((p[1] - p[0]).normalized()), 0, 1e-14);
  EXPECT_NEAR(pair.u.dot((q[1] - q[0]).normalized()), 0, 1e-14);
  const Vec3 along = (p[1] - p[0]).normalized();
  const Vec3 force = 3 * pair.u + 2 * along - 0.7 * pair.u.cross(along);
  const EdgeForces f = balanced_forces(pair, force);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t end = 0; end < 2; ++end) {
    sum += f[0][end] + f[1][end];
    moment += p[end].cross(f[0][end]) + q[end].cross(f[1][end]);
  }
  EXPECT_LT(sum.norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
  const Vec3 w(0.3, -0.5, 0.8), v(1, 2, 3);
  const auto moved = [&](const EdgeEnds& x) {
    return EdgeEnds{v + w.cross(x[0]), v + w.cross(x[1])};
  };
  EXPECT_LT(relative_velocity(pair, moved(p), moved(q)).norm(), 1e-13);
  // power of the forces is that of the force through the slip
  const EdgeEnds v_p{Vec3(1, -2, 0.5), Vec3(0.2, 0.4, -1)}, v_q{Vec3(0, 1, 1), Vec3(-1, 0.3, 2)};
  double power = 0;
  for (std::size_t end = 0; end < 2; ++end)
    power += f[0][end].dot(v_p[end]) + f[1][end].dot(v_q[end]);
  EXPECT_NEAR(power, force.dot(relative_velocity(pair, v_p, v_q)), 1e-13);
}

TEST(EdgePair, EndsAndParallelSegments) {
  const EdgePair end =
      closest_pair({Vec3(0, 0, 1), Vec3(1, 0, 1)}, {Vec3(2, -1, 0), Vec3(2, 1, 0)});
  EXPECT_FALSE(end.is_between);
  EXPECT_DOUBLE_EQ(end.along[0], 1);
  EXPECT_NEAR(end.distance, std::sqrt(2.0), 1e-14);
  const EdgePair side =
      closest_pair({Vec3(0, 0, 0), Vec3(1, 0, 0)}, {Vec3(0.2, 0.5, 0), Vec3(2, 0.5, 0)});
  EXPECT_NEAR(side.distance, 0.5, 1e-14);
  EXPECT_FALSE(side.carries_friction);
}

/// Two upright plates of 40 mm, mm, kg, ms, one crossing the other: their edges meet at a right
/// angle, `offset` beside the middles, a gap apart. Nodes 1..4 above, in the xz plane, 5..8 below,
/// in the yz plane.
std::string crossed_plates(double gap, double offset = 3) {
  return fmt::format(
             "*NODE\n1,-20,{0},{1}\n2,20,{0},{1}\n3,20,{0},{2}\n4,-20,{0},{2}\n"
             "5,{0},-20,0\n6,{0},20,0\n7,{0},20,-40\n8,{0},-20,-40\n",
             offset, gap, gap + 40) +
         "*ELEMENT_SHELL\n1,1,1,2,3,4\n2,2,5,6,7,8\n*PART\nupper\n1,1,1\n*PART\nlower\n2,1,1\n"
         "*SECTION_SHELL\n1,2\n2.0,2.0,2.0,2.0\n*MAT_ELASTIC\n1,7.8e-6,210.0,0.3\n"
         "*SET_NODE_LIST\n1\n1,2,3,4\n";
}
const std::string kFalling = "*INITIAL_VELOCITY\n1\n0,0,-5.0\n";
/// SOFT 2, DEPTH 5, friction `mu`.
std::string surfaces(double mu, int depth) {
  return fmt::format("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n{0},{0}\n\n2,0.1,0,0,0,{1}\n",
                     mu, depth);
}

struct Crossing {
  BuiltModel built;
  State state;
  Scratch scratch;
  double step;
  explicit Crossing(const std::string& text, int threads = 1)
      : built(model_of(text)),
        state(initial_state(built.model)),
        scratch(built.model, threads),
        step(0.5 * initial_stable_step(built.model)) {}
  template <class Watch>
  void until(double end, Watch&& watch) {
    while (state.time < end) {
      advance_step(built.model, state, scratch, step);
      watch();
    }
  }
  const NodeRecord& node(int id) const { return state.nodes[node_of(built.model, id)]; }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < state.nodes.size(); ++n)
      sum += built.model.mass[n] * state.nodes[n].velocity();
    return sum;
  }
  /// Of the upper edge over the lower one, where they cross, m.
  double gap() const { return 0.5 * (node(1).x[2] + node(2).x[2] - node(5).x[2] - node(6).x[2]); }
};

TEST(EdgeContact, CrossedEdgesBounce) {
  Crossing run(crossed_plates(3) + kFalling + surfaces(0, 5));
  ASSERT_EQ(run.built.model.contacts.size(), 2U);
  EXPECT_EQ(run.built.model.contacts[1]->name(), "contact 0, edges");
  const Vec3 momentum = run.momentum();
  double lowest = 1;
  run.until(2e-3, [&] { lowest = std::min(lowest, run.gap()); });
  EXPECT_GT(lowest, 1e-3);  // half of the two half thicknesses
  EXPECT_LT(lowest, 2e-3);
  EXPECT_GT(run.gap(), 2e-3);
  EXPECT_LT((run.momentum() - momentum).norm(), 1e-12 * momentum.norm());
  double upper = 0, lower = 0;
  for (int id = 1; id <= 4; ++id) {
    upper += run.node(id).v[2];
    lower += run.node(id + 4).v[2];
  }
  EXPECT_GT(upper, lower + 1);  // they part
  EXPECT_LT(std::abs(run.state.energies.balance_error()), 0.01);
}

TEST(EdgeContact, WithoutItTheyPass) {
  Crossing run(crossed_plates(3) + kFalling + surfaces(0, 2));
  EXPECT_EQ(run.built.model.contacts.size(), 1U);
  run.until(2e-3, [] {});
  EXPECT_LT(run.gap(), -1e-3);
}

TEST(EdgeContact, FrictionTakesWhatItBooks) {
  // the upper plate comes down and along its own edge
  Crossing run(crossed_plates(3) + "*INITIAL_VELOCITY\n1\n3.0,0,-5.0\n" + surfaces(0.4, 5));
  const Vec3 momentum = run.momentum();
  run.until(2e-3, [] {});
  EXPECT_GT(run.state.contacts[1].friction_dissipated, 0);
  EXPECT_LT((run.momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_GT(run.node(7).v[0] + run.node(8).v[0] + run.node(5).v[0] + run.node(6).v[0], 0);
  EXPECT_LT(std::abs(run.state.energies.balance_error()), 0.01);
}

TEST(EdgeContact, CrossedBarsOfAGeneralContactBounce) {
  const std::string bars =
      "*NODE\n1,-20,3,8\n2,20,3,8\n5,3,-20,0\n6,3,20,0\n*PART\nupper\n1,1,1\n*PART\nlower\n2,1,1\n"
      "*SECTION_BEAM\n1,3\n28.27433\n*MAT_ELASTIC\n1,7.8e-6,210.0,0.3\n"
      "*ELEMENT_BEAM\n1,1,1,2\n2,2,5,6\n*SET_NODE_LIST\n1\n1,2\n*SET_PART_LIST\n1\n1,2\n"
      "*CONTACT_AUTOMATIC_GENERAL\n1,0,2\n\n\n1,0.1\n";
  Crossing run(bars + kFalling);
  const Vec3 momentum = run.momentum();
  double lowest = 1;
  run.until(3e-3, [&] { lowest = std::min(lowest, run.gap()); });
  EXPECT_GT(lowest, 3e-3);  // two radii of 3 mm
  EXPECT_LT(lowest, 6e-3);
  EXPECT_GT(run.gap(), 6e-3);
  EXPECT_LT((run.momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT(std::abs(run.state.energies.balance_error()), 0.01);
}

TEST(EdgeContact, AnyNumberOfThreadsGivesTheSameBits) {
  Crossing one(crossed_plates(3) + kFalling + surfaces(0.4, 5)),
      four(crossed_plates(3) + kFalling + surfaces(0.4, 5), 4);
  one.until(1.5e-3, [] {});
  four.until(1.5e-3, [] {});
  for (std::size_t n = 0; n < one.state.nodes.size(); ++n)
    EXPECT_EQ(one.state.nodes[n].position(), four.state.nodes[n].position());
  EXPECT_EQ(one.state.contacts[1].values, four.state.contacts[1].values);
}

TEST(EdgeContact, FarEdgesAreNoPairs) {
  // 0.5 m apart, flying side by side: nothing is near and no new search is due
  Crossing run(crossed_plates(500) + "*INITIAL_VELOCITY\n0\n0,0,-5.0\n" + surfaces(0, 5));
  run.until(2e-4, [] {});
  const std::vector<double> at_first = run.state.contacts[1].values;
  run.until(2e-3, [] {});
  EXPECT_TRUE(run.state.contacts[1].indices.empty());
  EXPECT_EQ(run.state.contacts[1].values, at_first);
}

TEST(EdgeContact, OverlapAtTheStartDoesNotPush) {
  Crossing run(crossed_plates(1.2) + surfaces(0, 5));
  run.until(5e-4, [] {});
  EXPECT_LT(run.momentum().norm(), 1e-12);
  for (int id = 1; id <= 8; ++id) EXPECT_LT(run.node(id).velocity().norm(), 1e-9);
}

TEST(EdgeContact, FreeEdgesAreThoseOfOneFacet) {
  ContactSurface surface;
  for (const std::array<int, 4> nodes : {std::array{0, 1, 4, 3}, std::array{1, 2, 5, 4}}) {
    ContactFacet facet;
    facet.node = nodes;
    facet.is_two_sided = true;
    surface.facets.push_back(facet);
  }
  EXPECT_EQ(free_edges(surface).size(), 6U);  // 8 less the one between, counted twice
}

}  // namespace
}  // namespace crosswalk::fe
