// Elements in single precision against the same ones in double: any place, any speed, any rest of a
// last register.
#include <gtest/gtest.h>

#include "fe_node/element/hex8_full.h"
#include "fe_node/solver.h"
#include "tests/fe_node/plate_model.h"
#include "tests/fe_node/solid_models.h"

namespace crosswalk::fe {
namespace {

constexpr double kYoungs = 10e9;
const Elastic kBone = Elastic::from_young(1800, kYoungs, 0.3);

ElementControls in(Precision precision) { return {.precision = precision}; }

/// The forces of the same state in both precisions differ by `tolerance` newton at most.
void expect_alike(const Model& exact, const Model& rounded, const State& state, double tolerance) {
  State first = state, second = initial_state(rounded);
  second.nodes = first.nodes;
  second.spin = first.spin;
  first.last_dt = second.last_dt = state.last_dt;
  Scratch one(exact, 1), other(rounded, 1);
  compute_forces(exact, first, one);
  compute_forces(rounded, second, other);
  const std::vector<Vec3> force = nodal_forces(exact, one), near = nodal_forces(rounded, other);
  double largest = 0;
  for (int n = 0; n < exact.mesh.node_count(); ++n) {
    largest = std::max(largest, force[n].norm());
    EXPECT_LT((force[n] - near[n]).norm(), tolerance) << n;
    const Vec3 moment = sum_of_rows(exact.tiles.moment_rows, one.moment_rows.data(), n);
    EXPECT_LT((moment - sum_of_rows(rounded.tiles.moment_rows, other.moment_rows.data(), n)).norm(),
              tolerance)
        << n;
  }
  EXPECT_GT(largest, 1000 * tolerance);
  EXPECT_NEAR(second.energies.internal, first.energies.internal, 1e-4 * first.energies.internal);
  EXPECT_NEAR(second.element_limit.stable_step, first.element_limit.stable_step,
              1e-4 * first.element_limit.stable_step);
}

/// Far from the origin, fast, turned by a radian and strained by some 1e-3.
void displace(State& state) {
  const Mat3 R = exp_rotation({0.3, -0.8, 0.5}).toRotationMatrix();
  for (std::size_t n = 0; n < state.nodes.size(); ++n) {
    const auto k = static_cast<double>(n);
    NodeRecord& node = state.nodes[n];
    const Vec3 u = 2e-6 * Vec3(std::sin(5 * k), std::cos(3 * k), std::sin(7 * k));
    node.set_position(Vec3(30, -20, 10) + R * (node.position() + u));
    node.set_velocity(Vec3(12, 3, -5) + 1e5 * (R * u));
  }
}

class SingleSolid : public testing::TestWithParam<std::tuple<SolidForm, int>> {};

TEST_P(SingleSolid, ForcesAreThoseOfDoubleToRoundOff) {
  const auto [form, count] = GetParam();
  const Box box{count, 1, 1, {0.002 * count, 0.002, 0.002}};
  Model exact = solid_model(form, box, kBone, in(Precision::Double));
  Model rounded = solid_model(form, box, kBone, in(Precision::Single));
  exact.finish();
  rounded.finish();
  EXPECT_NEAR(rounded.total_mass(), exact.total_mass(), 1e-6 * exact.total_mass());
  EXPECT_DOUBLE_EQ(rounded.added_mass[0], 0);
  State state = initial_state(exact);
  displace(state);
  // stress to 4e-7 of the modulus, on 1 mm2 a node
  expect_alike(exact, rounded, state, 4e-7 * kYoungs * 1e-6 * 4);
}

// Counts that fill registers of four, eight and sixteen, and such that do not.
INSTANTIATE_TEST_SUITE_P(Forms, SingleSolid,
                         testing::Combine(testing::Values(SolidForm::OnePointBrick,
                                                          SolidForm::FullBrick),
                                          testing::Values(1, 5, 8, 11, 16, 37)));

class SingleShell : public testing::TestWithParam<std::tuple<ElementKind, ShellIntegration, int>> {
};

TEST_P(SingleShell, ForcesAreThoseOfDoubleToRoundOff) {
  const auto [kind, integration, count] = GetParam();
  const Plate plate{count, 1, 0.002 * count, 0.002, kind};
  ShellSection section = uniform_section(ShellElastic{1800, kYoungs, 0.3}, 1e-3, 3);
  section.integration = integration;
  Model exact = plate_model(plate, section, in(Precision::Double));
  Model rounded = plate_model(plate, section, in(Precision::Single));
  exact.finish();
  rounded.finish();
  EXPECT_NEAR(rounded.total_mass(), exact.total_mass(), 1e-6 * exact.total_mass());
  State state = initial_state(exact);
  displace(state);
  for (std::size_t n = 0; n < state.spin.size(); ++n)
    state.spin[n] = 100 * Vec3(std::sin(2.0 * static_cast<double>(n)), 1, 0.5);
  state.last_dt = 1e-7;
  // increments carry no cancellation: to some 1e-6 of the stress, 1e-3 of the modulus
  expect_alike(exact, rounded, state, 1e-5 * 1e-3 * kYoungs * 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Forms, SingleShell,
                         testing::Combine(testing::Values(ElementKind::Quad4),
                                          testing::Values(ShellIntegration::OnePoint,
                                                          ShellIntegration::Full),
                                          testing::Values(1, 5, 8, 11, 16, 37)));
INSTANTIATE_TEST_SUITE_P(Triangles, SingleShell,
                         testing::Combine(testing::Values(ElementKind::Tri3),
                                          testing::Values(ShellIntegration::OnePoint),
                                          testing::Values(1, 6, 17)));

TEST(SinglePrecision, GivesTheSameBitsForAnyNumberOfThreads) {
  const Box box{37, 5, 5, {0.074, 0.01, 0.01}};
  Model model = box_model(box, Viscoelastic::from_single_term(1040, 2.19e9, 6e3, 1.2e3, 80),
                          in(Precision::Single));
  for (int n = 0; n < model.mesh.node_count(); ++n)
    model.start_velocities.push_back({{n}, Vec3(0, 0, 30).cross(model.mesh.position[n])});
  model.finish();
  const auto end_after_steps = [&](int threads) {
    State state = initial_state(model);
    Scratch scratch(model, threads);
    for (int i = 0; i < 200; ++i)
      advance_step(model, state, scratch, 0.9 * initial_stable_step(model));
    return state;
  };
  const State one = end_after_steps(1), two = end_after_steps(2);
  EXPECT_EQ(one.history, two.history);
  for (std::size_t n = 0; n < one.nodes.size(); ++n)
    EXPECT_EQ(one.nodes[n].position(), two.nodes[n].position());
}

}  // namespace
}  // namespace crosswalk::fe
