// Tetrahedra, full bricks and beams against closed forms.
#include <numbers>

#include <gtest/gtest.h>

#include "fe_node/element/beam.h"
#include "fe_node/element/shell.h"
#include "tests/fe_node/run_until.h"
#include "tests/fe_node/solid_models.h"

namespace crosswalk::fe {
namespace {

/// Sag of the tip of a soft cantilever under its own weight over that of Timoshenko's beam. The
/// load is damped.
double sag_ratio(SolidForm form, double bulk) {
  constexpr double kShear = 1e5, kDensity = 1000, kGravity = 1.0, L = 0.1, h = 0.02;
  const Box box{20, 1, 4, {L, 0.005, h}};
  const double youngs = 9 * bulk * kShear / (3 * bulk + kShear);
  Model model = solid_model(form, box, Elastic::from_bulk(kDensity, bulk, kShear));
  int tip = 0;
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const Vec3& p = model.mesh.position[n];
    if (p.x() < 1e-9) model.fixed.push_back({n, {true, true, true}, {}});
    if ((p - Vec3(L, 0, 0.5 * h)).norm() < (model.mesh.position[tip] - Vec3(L, 0, 0.5 * h)).norm())
      tip = n;
  }
  model.settings.gravity = {0, 0, -kGravity};
  model.settings.mass_damping = 60;
  model.finish();
  State state = initial_state(model);
  run_until(model, state, 0.15, 0.9, [] {});
  const double bending = kDensity * kGravity * std::pow(L, 4) / (8 * youngs * h * h / 12);
  const double shear = kDensity * kGravity * L * L / (2 * 5.0 / 6 * kShear);
  return (model.mesh.position[tip].z() - state.nodes[tip].x[2]) / (bending + shear);
}

// Bending costs no volume, K / G = 1e3. The full brick is held back only by the shear that its
// straight edges need, a few per cent on four cubes across. Linear tetrahedra are stiff in bending
// at any bulk modulus, by a fifth to a quarter on this grid; the plain one locks on top of that by
// more than half, the one with pressures averaged at the nodes by no more than another tenth.
TEST(FeElements, NearIncompressibleBendingDoesNotLock) {
  constexpr double kTissue = 1e8, kSoft = 2e5;  // of G = 1e5: Poisson ratios 0.4995 and 0.29
  EXPECT_NEAR(sag_ratio(SolidForm::FullBrick, kTissue), 1, 0.08);
  const double of_grid = sag_ratio(SolidForm::Tet, kSoft);
  EXPECT_GT(of_grid, 0.7);
  EXPECT_LT(sag_ratio(SolidForm::Tet, kTissue), 0.5);
  EXPECT_NEAR(sag_ratio(SolidForm::NodalTet, kTissue), of_grid, 0.1 * of_grid);
}

/// Confined column of near-incompressible tissue pushed at one end with a speed v.
struct Column {
  double speed = 0, pressure = 0;
};
Column pushed_column(SolidForm form) {
  constexpr double kBulk = 2.19e9, kShear = 1e3, kDensity = 1040, kV = 0.1, kLength = 0.2;
  const Box box{100, 1, 1, {kLength, 0.002, 0.002}};
  Model model = solid_model(form, box, Elastic::from_bulk(kDensity, kBulk, kShear));
  GuidedNodes push;
  push.curve = Curve({0}, {kV});
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const Vec3& p = model.mesh.position[n];
    model.fixed.push_back({n, {false, true, true}, {}});
    if (p.x() < 1e-9) push.nodes.push_back(n);
  }
  model.guided.push_back(push);
  model.finish();
  State state = initial_state(model);
  const double c = std::sqrt((kBulk + 4.0 / 3 * kShear) / kDensity);
  // half the plateau passes the middle of the column
  Column out;
  const ElementBlock& block = *model.blocks[0];
  int middle = 0;
  for (int e = 0; e < block.element_count(); ++e) {
    const StepContext context{state.nodes, {}, 0, 0, false};
    if (std::abs(block.sample(context, state.history[0], e).centre.x() - 0.5 * kLength) <
        std::abs(block.sample(context, state.history[0], middle).centre.x() - 0.5 * kLength))
      middle = e;
  }
  const double plateau = kDensity * c * kV;
  double arrival = 0, sum = 0;
  int count = 0;
  run_until(model, state, 0.9 * kLength / c, 0.9, [&] {
    const StepContext context{state.nodes, {}, state.time, 0, false};
    const double p = -block.sample(context, state.history[0], middle).stress.trace() / 3;
    if (arrival == 0 && p > 0.5 * plateau) arrival = state.time;
    if (state.time > 0.65 * kLength / c) {
      sum += p;
      ++count;
    }
  });
  out.speed = 0.5 * kLength / arrival / c;
  out.pressure = sum / count / plateau;
  return out;
}

// p = rho c v behind a front at c = sqrt((K + 4/3 G) / rho): no element may stiffen or soften the
// bulk of tissue with K / G = 2e6. The front is some elements wide: 2 % of a hundred.
TEST(FeElements, PressureWaveRunsThroughNearIncompressibleTissue) {
  for (SolidForm form :
       {SolidForm::OnePointBrick, SolidForm::FullBrick, SolidForm::Tet, SolidForm::NodalTet}) {
    const Column column = pushed_column(form);
    EXPECT_NEAR(column.speed, 1, 0.03) << name_of(form);
    EXPECT_NEAR(column.pressure, 1, 0.02) << name_of(form);
  }
}

// One layer of one-point bricks between two shells on its faces, as a skull's diploe between its
// tables. Per width D = E_f (t c^2 / 2 + t^3 / 6) + E_c c^3 / 12, and a cantilever strip swings at
// 3.5160 / 2 pi sqrt(D / (m L^4)) [blevins1979, table 8-1]. A one-point brick has no bending of its
// own but what hourglass control lends it: that leaves the core's 2 % of D open, the core's shear
// takes 1 % of the frequency, the grid 0.5 %.
TEST(FeElements, OneBrickBetweenTwoShellsBendsAsASandwich) {
  constexpr double kFace = 15e9, kCore = 1e9, kT = 0.002, kC = 0.006, kL = 0.2, kWidth = 0.01;
  constexpr double kFaceDensity = 2100, kCoreDensity = 1300;
  const Box box{20, 1, 1, {kL, kWidth, kC}};
  Model model =
      solid_model(SolidForm::OnePointBrick, box, Elastic::from_young(kCoreDensity, kCore, 0));
  model.mesh.parts.push_back({DeckId{2}, "tables", false});
  ElementTable& quads = model.mesh.table(ElementKind::Quad4);
  std::vector<int> shells;
  for (int k : {0, 1})
    for (int i = 0; i < box.nx; ++i) {
      quads.nodes.insert(quads.nodes.end(), {box.node(i, 0, k), box.node(i + 1, 0, k),
                                             box.node(i + 1, 1, k), box.node(i, 1, k)});
      quads.part.push_back(1);
      quads.id.push_back(DeckId{100 + quads.size()});
      shells.push_back(quads.size() - 1);
    }
  model.blocks.push_back(
      make_shell_block(model.mesh, ElementKind::Quad4, 1, shells,
                       uniform_section(ShellElastic{kFaceDensity, kFace, 0}, kT, 3), {}));
  for (int j : {0, 1})
    for (int k : {0, 1})
      model.fixed.push_back({box.node(0, j, k), {true, true, true}, {true, true, true}});
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const double s = model.mesh.position[n].x() / kL;
    model.start_velocities.push_back({{n}, {0, 0, 1e-2 * s * s * (3 - s) / 2}});
  }
  model.finish();
  State state = initial_state(model);
  const double D = kFace * (kT * kC * kC / 2 + kT * kT * kT / 6) + kCore * kC * kC * kC / 12;
  const double mass = 2 * kFaceDensity * kT + kCoreDensity * kC;
  const double exact = 3.5160 / (2 * std::numbers::pi) * std::sqrt(D / mass) / (kL * kL);
  const int tip = box.node(20, 0, 0);
  double last = 0, first_time = 0, last_time = 0;
  int crossings = 0;
  run_until(model, state, 3.2 / exact, 0.9, [&] {
    const double w = state.nodes[tip].x[2];
    if (state.step > 2 && w * last < 0) {
      const double time = state.time - state.last_dt * w / (w - last);
      if (crossings++ == 0) first_time = time;
      last_time = time;
    }
    last = w;
  });
  EXPECT_NEAR(0.5 * (crossings - 1) / (last_time - first_time), exact, 0.03 * exact);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

/// Beams along x from the origin, clamped there.
Model beam_cantilever(int count, double length, const BeamSection& section) {
  Model model;
  model.mesh.parts.push_back({DeckId{1}, "beam", false});
  ElementTable& lines = model.mesh.table(ElementKind::Line2);
  std::vector<int> all;
  for (int n = 0; n <= count; ++n) {
    model.mesh.position.push_back({length * n / count, 0, 0});
    model.mesh.node_id.push_back(DeckId{n + 1});
    if (n == 0) continue;
    lines.nodes.insert(lines.nodes.end(), {n - 1, n});
    lines.part.push_back(0);
    lines.id.push_back(DeckId{n});
    all.push_back(n - 1);
  }
  model.blocks.push_back(
      make_beam_block(model.mesh, 0, all, section, std::vector<Vec3>(count, Vec3::UnitY())));
  model.fixed.push_back({0, {true, true, true}, {true, true, true}});
  return model;
}

// f1 = 3.5160 / 2 pi sqrt(E I / (rho A L^4)) [blevins1979, table 8-1] in both planes; slender, so
// shear and the enlarged rotary inertia are below 1 %. The start is nearly the first mode.
TEST(FeElements, BeamCantileverFrequencies) {
  const BeamSection section = rectangular_beam(7850, 210e9, 0.3, 0.01, 0.02);
  for (int axis : {1, 2}) {
    Model model = beam_cantilever(20, 1.0, section);
    for (int n = 0; n <= 20; ++n) {
      const double s = n / 20.0;
      model.start_velocities.push_back({{n}, 1e-2 * s * s * (3 - s) / 2 * Vec3::Unit(axis)});
    }
    model.finish();
    State state = initial_state(model);
    const double I = axis == 1 ? section.inertia_tt : section.inertia_ss;
    const double exact = 3.5160 / (2 * std::numbers::pi) *
                         std::sqrt(section.youngs_modulus * I / (section.density * section.area));
    double last = 0, first_time = 0, last_time = 0;
    int crossings = 0;
    run_until(model, state, 2.2 / exact, 0.9, [&] {
      const double w = state.nodes[20].x[axis];
      if (state.step > 2 && w * last < 0) {
        const double time = state.time - state.last_dt * w / (w - last);
        if (crossings++ == 0) first_time = time;
        last_time = time;
      }
      last = w;
    });
    EXPECT_NEAR(0.5 * (crossings - 1) / (last_time - first_time), exact, 0.01 * exact) << axis;
    EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
  }
}

// The elastica under a tip load of F L^2 / (E I) = 2: w/L 0.49346, u/L 0.16064 [mattiasson1981,
// table 1].
TEST(FeElements, BeamBendsFarAsTheElastica) {
  constexpr double kE = 1e9, kT = 0.02, kDensity = 1000, kWidth = 0.1;
  const BeamSection section = rectangular_beam(kDensity, kE, 0, kWidth, kT);
  const double EI = kE * section.inertia_ss;
  Model model = beam_cantilever(20, 1.0, section);
  model.nodal_forces.push_back({{20}, Vec3::UnitZ(), Curve({0.0, 0.3}, {0.0, 1.0}), 2 * EI});
  model.settings.mass_damping = 2 * 3.516 * std::sqrt(EI / (kDensity * section.area));
  model.finish();
  State state = initial_state(model);
  run_until(model, state, 0.6, 0.9, [] {});
  EXPECT_NEAR(state.nodes[20].x[2], 0.49346, 0.01 * 0.49346);
  EXPECT_NEAR(1 - state.nodes[20].x[0], 0.16064, 0.02 * 0.16064);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

// An angled beam tumbles freely through space: momenta to round-off, energy to the step's error.
TEST(FeElements, BeamInFreeFlightKeepsMomentaAndEnergy) {
  Model model = beam_cantilever(8, 1.0, tubular_beam(7850, 210e9, 0.3, 0.02, 0.015));
  model.fixed.clear();
  model.start_velocities.push_back({{8}, {3, 5, 2}});
  model.finish();
  State state = initial_state(model, {}, {{1, 2, 3}, {4, -10, 5}});
  auto momenta = [&] {
    Vec6 sum = Vec6::Zero();
    for (int n = 0; n <= 8; ++n) {
      const Vec3 p = model.mass[n] * state.nodes[n].velocity();
      sum.head<3>() += p;
      sum.tail<3>() += state.nodes[n].position().cross(p) + model.inertia[n] * state.spin[n];
    }
    return sum;
  };
  Vec6 start = Vec6::Zero();
  double worst = 0;
  run_until(model, state, 0.3, 0.8, [&] {
    if (state.step == 1) start = momenta();
    worst = std::max(worst, std::abs(state.energies.balance_error()));
  });
  EXPECT_LT((momenta() - start).head<3>().norm(), 1e-11 * start.head<3>().norm());
  EXPECT_LT((momenta() - start).tail<3>().norm(), 1e-11 * start.tail<3>().norm());
  EXPECT_LT(worst, 0.01);
}

// Without loads or losses the full brick and the nodal tetrahedron keep energy and momenta too.
TEST(FeElements, FreeSolidsKeepMomentaAndEnergy) {
  for (SolidForm form : {SolidForm::FullBrick, SolidForm::NodalTet}) {
    const Box box{2, 2, 2, {0.1, 0.1, 0.1}};
    Model model = solid_model(form, box, Elastic::from_young(1000, 1e6, 0.45), without_viscosity());
    for (int n = 0; n < model.mesh.node_count(); ++n) {
      const Vec3 r = model.mesh.position[n] - Vec3(0.05, 0.05, 0.05);
      model.start_velocities.push_back(
          {{n}, Vec3(3, 1, 2) + Vec3(20, 10, -30).cross(r) + 10 * r.x() * r});
    }
    model.finish();
    State state = initial_state(model);
    const auto momenta = [&] {
      Vec6 sum = Vec6::Zero();
      for (int n = 0; n < model.mesh.node_count(); ++n) {
        const Vec3 p = model.mass[n] * state.nodes[n].velocity();
        sum.head<3>() += p;
        sum.tail<3>() += state.nodes[n].position().cross(p);
      }
      return sum;
    };
    const Vec6 start = momenta();
    double worst = 0;
    run_until(model, state, 5e3 * initial_stable_step(model), 0.9,
              [&] { worst = std::max(worst, std::abs(state.energies.balance_error())); });
    const Vec6 change = momenta() - start;
    EXPECT_LT(change.head<3>().norm(), 1e-11 * start.head<3>().norm()) << name_of(form);
    EXPECT_LT(change.tail<3>().norm(), 1e-11 * start.head<3>().norm()) << name_of(form);
    EXPECT_LT(worst, 0.01) << name_of(form);
  }
}

}  // namespace
}  // namespace crosswalk::fe
