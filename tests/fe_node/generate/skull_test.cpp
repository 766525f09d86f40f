// The skull's sandwich: bending of diploe bricks with tables on their faces against the closed
// form.
#include <cmath>

#include <gtest/gtest.h>

#include "fe_node/generate/deck_export.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/primitives.h"
#include "fe_node/generate/tissues.h"
#include "fe_node/model_builder/model_builder.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

using generate::ModelDraft;
namespace part = generate::part;

constexpr double kThickness = 6.5e-3, kOuter = 1.8e-3, kInner = 1.4e-3;  // m, parietal bone
constexpr double kPoisson = 0.22;

/// A strip of skull, outer table above; brick layers through the thickness.
ModelDraft strip(int layers) {
  constexpr int kLong = 4, kWide = 2;
  ModelDraft draft;
  const generate::Grid grid = generate::add_block(
      draft.mesh, {kLong, kWide, layers},
      [&](int a, int b, int c) -> Vec3 {
        return {0.008 * a, 0.008 * b, kThickness * (static_cast<double>(c) / layers - 0.5)};
      },
      part::kDiploe);
  for (const auto& [level, id, thickness] :
       {std::tuple(layers, part::kOuterTable, kOuter), std::tuple(0, part::kInnerTable, kInner)})
    for (int b = 0; b < kWide; ++b)
      for (int a = 0; a < kLong; ++a)
        draft.mesh.quads.push_back({{grid.at(a, b, level), grid.at(a + 1, b, level),
                                     grid.at(a + 1, b + 1, level), grid.at(a, b + 1, level)},
                                    id,
                                    thickness});
  for (const generate::PartSpec& spec : generate::head_tissues())
    if (spec.id == part::kDiploe || spec.id == part::kOuterTable || spec.id == part::kInnerTable)
      draft.parts.push_back(spec);
  return draft;
}

/// Energy of cylindrical bending by `curvature`, plane stress through the thickness, J/m2; and of
/// hourglass control.
std::pair<double, double> bending_energy(int layers, double curvature) {
  BuiltModel built =
      build_model(generate::to_deck(strip(layers), UnitSystem::MmTonneS, {}), BuildOptions{});
  built.model.finish();
  State state = initial_state(built.model);
  Scratch scratch(built.model, 1);
  compute_forces(built.model, state, scratch);
  constexpr double kStep = 1e-7;
  const double k = curvature / kStep;
  for (int n = 0; n < built.model.mesh.node_count(); ++n) {
    const Vec3& p = built.model.mesh.position[n];
    const double thinning = 0.5 * kPoisson / (1 - kPoisson) * p.z() * p.z();
    state.nodes[n].set_velocity(k * Vec3(-p.x() * p.z(), 0, 0.5 * p.x() * p.x() + thinning));
    state.spin[n] = Vec3(0, -k * p.x(), 0);
  }
  move(built.model, state, scratch, kStep);
  compute_forces(built.model, state, scratch);
  constexpr double kArea = 0.032 * 0.016;
  return {state.energies.internal / kArea, state.energies.hourglass() / kArea};
}

/// Third of the cubes' difference: integral of z^2 from a to b.
double second_moment(double a, double b) { return (b * b * b - a * a * a) / 3; }

TEST(Skull, TablesCarryTheBendingOfTheSandwich) {
  constexpr double kCurvature = 0.02;  // 1/m; strain 6.5e-5, elastic
  const double h = 0.5 * kThickness, stretch = 1 / (1 - kPoisson * kPoisson);
  const double tables =
      stretch * (15e9 * second_moment(h - kOuter, h) + 12e9 * second_moment(-h, -h + kInner));
  const double bricks = stretch * 1e9 * second_moment(-h, h);
  const double between = stretch * 1e9 * second_moment(-h + kInner, h - kOuter);
  const double sandwich = tables + between;
  EXPECT_NEAR(sandwich, 286, 3);  // N m
  for (const int layers : {2, 3}) {
    const auto [internal, hourglass] = bending_energy(layers, kCurvature);
    const double D = 2 * (internal + hourglass) / (kCurvature * kCurvature);
    // One-point bricks leave out their own layers' bending, 1 / layers^2 of it.
    const double ours = tables + bricks * (1 - 1.0 / (layers * layers));
    EXPECT_NEAR(D / ours, 1, 0.01) << layers;
    EXPECT_LT(hourglass, 0.01 * internal) << layers;
    EXPECT_NEAR(D / sandwich, 1, 0.08) << layers;  // what is counted double, and what is left out
  }
}

}  // namespace
}  // namespace crosswalk::fe
