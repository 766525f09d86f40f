// The deck of a run with the motion of its blocks moves the head as the run did.
#include <filesystem>

#include <gtest/gtest.h>

#include "fe_node/deck/keyword_reader.h"
#include "fe_node/output/head_motion.h"
#include "fe_node/own_head.h"
#include "tests/fe_node/node/node_fixture.h"

namespace crosswalk::fe {
namespace {

struct Drive {
  Vec3 centre;  ///< of the head, deck axes, from its place at the start
  Twist V;
  double time = 0;
  std::int64_t steps = 0;
};

Drive motion_of(const HeadMotion& head, const State& state, const Pose& X_WD) {
  const HeadSample sample = head.sample(state, 0, {}, 1);
  const Quat q_DW = X_WD.q.conjugate();
  return {q_DW * Vec3(sample.X_WH.p - X_WD.p) - head.frame().p,
          {q_DW * sample.V_WH.v, q_DW * sample.V_WH.w},
          state.time,
          state.step};
}

HeadMotion head_of(const BuiltModel& built) {
  const int skull = built.model.mesh.find_node_set(kSkullNodes);
  const Inertia inertia =
      inertia_of_parts(built.model, built.part_sets[built.part_set(kHeadParts)].second);
  return HeadMotion(built.model, built.model.mesh.node_sets[skull].nodes,
                    Pose{Quat::Identity(), inertia.com});
}

/// The deck run for as long as the node was.
Drive solved(const std::filesystem::path& path, double end, Precision precision) {
  const ReadDeck read = read_deck(path, {});
  EXPECT_TRUE(read.problems.errors.empty());
  EXPECT_TRUE(read.deck.missing_includes.empty());
  BuildOptions options;
  options.precision = precision;
  BuiltModel built = build_model(read.deck, options);
  finish_model(built);
  State state = initial_state(built.model);
  Scratch scratch(built.model, 1);
  while (state.time < end * (1 - 1e-12)) {
    const StepReport report = compute_forces(built.model, state, scratch);
    move(built.model, state, scratch, next_step(built.model, state, report));
  }
  return motion_of(head_of(built), state, Pose{});
}

class BlockMotion : public testing::TestWithParam<Precision> {};

TEST_P(BlockMotion, DrivenDeckMovesTheHeadAsTheRunDid) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      (GetParam() == Precision::Double ? "block_motion" : "block_motion_single");
  std::filesystem::remove_all(folder);
  constexpr int kWindows = 60;
  Drive coupled;
  {
    FeConfig config = node_config("block_motion = true\n[windshield]\nmodel = \"rigid\"\n");
    config.gravity = 9.80665;
    config.precision = GetParam();
    // Torso pushed and turned about all axes at once.
    DrivenNode run(config, {Vec3(200, -350, 120), Vec3(900, -1500, 700)}, {}, Vec3(0, -5, 0),
                   folder);
    const HeadMotion head = head_of(run.node.built());
    const Pose X_WD = head.sample(run.node.state(), 0, {}, 1).X_WH * head.frame().inverse();
    run.advance(kWindows);
    coupled = motion_of(head, run.node.state(), X_WD);
  }
  const Drive deck = solved(folder / "model" / "driven.k", kWindows * 20e-6, GetParam());
  EXPECT_EQ(deck.steps, coupled.steps);
  EXPECT_NEAR(deck.time, coupled.time, 1e-12);
  EXPECT_GT(coupled.V.v.norm(), 0.01);
  // The deck stands elsewhere in space: elements in single precision round otherwise there.
  const bool is_double = GetParam() == Precision::Double;
  EXPECT_LT((deck.centre - coupled.centre).norm(), is_double ? 1e-6 * coupled.centre.norm() : 1e-9);
  EXPECT_LT((deck.V.v - coupled.V.v).norm(), is_double ? 1e-6 * coupled.V.v.norm() : 1e-4);
  EXPECT_LT((deck.V.w - coupled.V.w).norm(), is_double ? 1e-6 * coupled.V.w.norm() : 2e-3);
}

INSTANTIATE_TEST_SUITE_P(In, BlockMotion, testing::Values(Precision::Double, Precision::Single),
                         [](const auto& in) {
                           return in.param == Precision::Double ? "Double" : "Single";
                         });

}  // namespace
}  // namespace crosswalk::fe
