// Neck flesh folded between skull base and torso: no cell loses its volume or turns inside out.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "common/units.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/quality.h"
#include "fe_node/validate/head_draft.h"

namespace crosswalk::fe::validate {
namespace {

namespace part = generate::part;

/// Flesh alone on the torso block, the skull base on its top carried sideways on a shrinking arc
/// about the block and turned with it.
struct Fold {
  double angle = 0, shortening = 0, time = 0;
};

/// Least true volume of a cell over its own, at the end and half-way.
double least_volume(const generate::ModelDraft& draft, const Fold& fold) {
  const double radius = generate::inertia_of(draft, {rigid_skull_part()}, false).com.z();
  DeckCase deck(draft, UnitSystem::MmTonneS);
  Points along[3], turn;
  constexpr int kPoints = 100;
  const auto place = [&](double share) -> Vec3 {
    const double a = fold.angle * share, r = radius * (1 - fold.shortening * share);
    return {0, -r * std::sin(a), r * std::cos(a)};
  };
  // Smooth start: share = (1 - cos) / 2 of the time.
  const auto share_at = [&](double t) { return 0.5 - 0.5 * std::cos(kPi * t / fold.time); };
  for (int i = 0; i <= kPoints; ++i) {
    const double t = fold.time * i / kPoints, h = 1e-6;
    const Vec3 v = (place(share_at(t + h)) - place(share_at(t - h))) / (2 * h);
    for (int axis = 0; axis < 3; ++axis) along[axis].emplace_back(t, v[axis]);
    turn.emplace_back(t, fold.angle * (share_at(t + h) - share_at(t - h)) / (2 * h));
  }
  const Points rest{{0, 0}, {fold.time, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    deck.guide_part(rigid_skull_part(), axis, along[axis]);
    deck.guide_part(rigid_skull_part(), 3 + axis, axis == 0 ? turn : rest);
    deck.guide_part(part::kBlockTorsoUp, axis, rest);
    deck.guide_part(part::kBlockTorsoUp, 3 + axis, rest);
  }
  deck.end_at(fold.time);
  DeckRun run(deck.deck, std::filesystem::path(testing::TempDir()) / "folded_flesh", {});
  double least = 1;
  run.run(fold.time, 0.5 * fold.time, [&](const State& state) {
    for (const generate::Hex& hex : draft.mesh.hexes) {
      if (hex.part != part::kFlesh) continue;
      generate::HexCorners now;
      for (int c = 0; c < 8; ++c) now[c] = state.nodes[run.node_of(hex.node[c])].position();
      least = std::min(
          least, generate::volume(now) / generate::volume(generate::corners_of(draft.mesh, hex)));
    }
  });
  EXPECT_LT(std::abs(run.state().energies.balance_error()), 0.02);
  return least;
}

TEST(Flesh, FoldedOntoTheTorsoEveryCellKeepsItsVolume) {
  const generate::HeadNeck whole = generate::build_head_neck({});
  const generate::ModelDraft flesh =
      extract(whole.draft, {part::kFlesh, part::kBlockTorsoUp, rigid_skull_part()});
  EXPECT_GT(least_volume(flesh, {.angle = 80 * kDegree, .shortening = 0.3, .time = 0.03}), 0.5);
}

}  // namespace
}  // namespace crosswalk::fe::validate
