// Tiebreak contact from the deck to the motion: the load at which it fails in pull and in shear,
// momenta and energy of the failure, ordinary contact afterwards.
#include <cmath>

#include <fmt/format.h>

#include "common/error.h"
#include "fe_node/solver.h"
#include "tests/fe_node/model_builder/built_deck.h"

namespace crosswalk::fe {
namespace {

constexpr double kYoungs = 1e8, kDensity = 1000, kSide = 0.2, kHeight = 0.1;  // SI

/// A brick upon the middle of a broader one: nodes 1..8 below z = 0, 101..108 above, layers from
/// below. The four tied nodes are alike, so that they carry equal shares and fail together.
std::string two_blocks() {
  std::string nodes = "*NODE\n", elements = "*ELEMENT_SOLID\n";
  for (const int block : {0, 1}) {
    int id = 100 * block;
    const double side = (block == 0 ? 1.5 : 1.0) * kSide;
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
          nodes += fmt::format("{},{},{},{}\n", ++id, side * (i - 0.5), side * (j - 0.5),
                               kHeight * (k + block - 1));
    const int n = 100 * block;
    elements += fmt::format("{0},{1},{2},{3},{5},{4},{6},{7},{9},{8}\n", n + 1, block + 1, n + 1,
                            n + 2, n + 3, n + 4, n + 5, n + 6, n + 7, n + 8);
  }
  return nodes + elements +
         fmt::format(
             "*PART\nbelow\n1,1,1\n*PART\nabove\n2,1,1\n*SECTION_SOLID\n1,1\n"
             "*MAT_ELASTIC\n1,{},{},0.0\n",
             kDensity, kYoungs) +
         "*SET_NODE_LIST_GENERATE\n1\n1,4\n*SET_NODE_LIST_GENERATE\n2\n105,108\n"
         "*SET_NODE_LIST_GENERATE\n3\n1,108\n*SET_NODE_LIST_GENERATE\n4\n101,104\n";
}
/// Stress limits of pull and shear.
std::string stress_limits(double normal, double shear) {
  return fmt::format("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK\n2,1,3,3\n\n\n2,{},{}\n",
                     normal, shear);
}
/// The upper end moves evenly in direction 1 or 3, the lower one stands.
std::string drawn(int direction, double speed) {
  return fmt::format(
      "*BOUNDARY_SPC_SET\n1,0,1,1,1\n*DEFINE_CURVE\n9\n0,{}\n1,{}\n"
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n2,{},0,9\n",
      speed, speed, direction);
}

class Blocks {
 public:
  explicit Blocks(const std::string& text, double step_share = 0.5)
      : built_(model_of(text,
                        [] {
                          BuildOptions options;
                          options.units = UnitSystem::MKgS;
                          return options;
                        }())),
        state_(initial_state(built_.model)),
        scratch_(built_.model, 1),
        step_(step_share * initial_stable_step(built_.model)) {}

  template <class Watch>
  void run(double time, Watch&& watch) {
    const double end = state_.time + time;
    while (state_.time < end) {
      advance_step(built_.model, state_, scratch_, step_);
      watch(scratch_.contact_reports[0]);
    }
  }
  void run(double time) {
    run(time, [](const ContactReport&) {});
  }
  NodeRecord& node(int id) { return state_.nodes[node_of(built_.model, id)]; }
  State& state() { return state_; }
  const ContactReport& report() const { return scratch_.contact_reports[0]; }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (int n = 0; n < built_.model.mesh.node_count(); ++n)
      sum += built_.model.mass[n] * state_.nodes[n].velocity();
    return sum;
  }
  Vec3 velocity_of(int block) const {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (int n = 0; n < built_.model.mesh.node_count(); ++n)
      if ((built_.model.mesh.node_id[n].value > 100) == (block == 1)) {
        sum += built_.model.mass[n] * state_.nodes[n].velocity();
        mass += built_.model.mass[n];
      }
    return sum / mass;
  }

 private:
  BuiltModel built_;
  State state_;
  Scratch scratch_;
  double step_;
};

constexpr double kSpeed = 1e-2;  // m/s: waves change the stress by rho c v = 3 kPa at a time

/// The largest force while drawn slowly; the tie is gone at the end.
double failure_load(Blocks& blocks) {
  double largest = 0;
  blocks.run(
      0.5, [&](const ContactReport& report) { largest = std::max(largest, report.force.norm()); });
  EXPECT_EQ(blocks.report().active, 0);
  return largest;
}

TEST(Tiebreak, FailsAtItsStressInPull) {
  const double limit = 2e5;
  Blocks blocks(two_blocks() + stress_limits(limit, 4e4) + drawn(3, kSpeed));
  EXPECT_NEAR(failure_load(blocks) / (limit * kSide * kSide), 1, 0.02);
}

TEST(Tiebreak, FailsAtItsStressInShear) {
  const double limit = 2e5;
  // all nodes move along x alone: a uniform shear
  Blocks blocks(two_blocks() + stress_limits(1e5, limit) + drawn(1, kSpeed) +
                "*BOUNDARY_SPC_SET\n3,0,0,1,1\n");
  EXPECT_NEAR(failure_load(blocks) / (limit * kSide * kSide), 1, 0.02);
}

TEST(Tiebreak, NodesFailAtTheirForce) {
  const double limit = 2000;
  Blocks blocks(
      two_blocks() +
      fmt::format("*CONTACT_TIEBREAK_NODES_TO_SURFACE\n4,1,4,3\n\n\n{},{},2,2\n", limit, limit) +
      drawn(3, kSpeed));
  EXPECT_NEAR(failure_load(blocks), 4 * limit, 0.02 * 4 * limit);
}

TEST(Tiebreak, PressingNeverBreaks) {
  Blocks blocks(two_blocks() + stress_limits(1e3, 1e3) + drawn(3, -kSpeed));
  blocks.run(0.1);
  EXPECT_EQ(blocks.report().active, 4);
  EXPECT_GT(blocks.report().force.z(), 10 * 1e3 * kSide * kSide);  // far beyond the limit of pull
}

TEST(Tiebreak, LimitsJoinAsSquares) {
  TiebreakLimits limits;
  limits.normal = 3;
  limits.shear = 5;
  TieLoad load;
  load.normal = Vec3(0, 0, 1);
  load.stiffness = 2;
  const auto broken = [&](double pull, double slide) {
    load.stretch = 0.5 * Vec3(0, slide, pull);
    return limits.are_reached(load, 1.0);
  };
  EXPECT_TRUE(broken(3.001, 0));
  EXPECT_FALSE(broken(2.999, 0));
  EXPECT_FALSE(broken(-100, 4.99));
  EXPECT_TRUE(broken(3 * 0.61, 5 * 0.8));
  EXPECT_FALSE(broken(3 * 0.59, 5 * 0.8));
}

TEST(Tiebreak, FailureKeepsMomentaAndEnergyAndLeavesContact) {
  Blocks blocks(two_blocks() + stress_limits(5e4, 5e4), 0.1);
  const auto throw_upper = [&](double speed) {
    for (int id = 101; id <= 108; ++id) blocks.node(id).set_velocity({0, 0, speed});
  };
  throw_upper(2);  // a wave of rho c v / 2 = 316 kPa
  const Vec3 momentum = blocks.momentum();
  blocks.run(4e-3);
  EXPECT_EQ(blocks.report().active, 0);
  EXPECT_GT(blocks.node(101).x[2] - blocks.node(5).x[2], 1e-3);
  EXPECT_LT((blocks.momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT(std::abs(blocks.state().energies.balance_error()), 0.02);
  EXPECT_GT(blocks.state().energies.contact_dissipated, 0);
  // thrown back on the lower block it bounces
  throw_upper(-0.5);
  const Vec3 before = blocks.momentum();
  double lowest = 1;
  int touching = 0;
  blocks.run(4e-2, [&](const ContactReport& report) {
    touching = std::max(touching, report.active);
    lowest = std::min(lowest, blocks.node(101).x[2] - blocks.node(5).x[2]);
  });
  EXPECT_GE(touching, 4);
  EXPECT_GT(lowest, -0.1 * kHeight);
  EXPECT_GT(blocks.velocity_of(1).z(), blocks.velocity_of(0).z());
  EXPECT_LT((blocks.momentum() - before).norm(), 1e-12 * before.norm());
}

TEST(Tiebreak, WhatCannotBeRunIsNamed) {
  const auto problems = [](const std::string& contact) -> std::string {
    try {
      Blocks blocks(two_blocks() + contact);
    } catch (const UserError& error) {
      return error.problems()[0].text();
    }
    return "none";
  };
  using testing::HasSubstr;
  const std::string automatic = "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK\n2,1,3,3\n\n\n";
  EXPECT_EQ(problems(automatic + "2,1.,1.\n"), "none");
  EXPECT_THAT(problems(automatic + "9,1.,1.\n"), HasSubstr("OPTION 2"));
  EXPECT_THAT(problems(automatic + "2,0,0\n"), HasSubstr("a positive limit"));
  EXPECT_THAT(problems("*CONTACT_TIEBREAK_SURFACE_TO_SURFACE\n2,1,3,3\n\n\n1.,1.,5\n"),
              HasSubstr("TBLCID"));
  EXPECT_THAT(problems("*CONTACT_TIEBREAK_SURFACE_TO_SURFACE\n4,1,4,3\n\n\n1.,1.\n"),
              HasSubstr("a surface on the slave side"));
}

}  // namespace
}  // namespace crosswalk::fe
