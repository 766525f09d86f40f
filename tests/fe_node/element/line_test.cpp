#include "fe_node/element/line.h"

#include <gtest/gtest.h>

#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

/// Nodes on the x axis, chained by lines, each of mass 1 kg.
Model chain(const std::vector<double>& x, const LineProperties& properties) {
  Model model;
  model.mesh.parts.push_back({DeckId{1}, "line", false});
  ElementTable& lines = model.mesh.table(ElementKind::Line2);
  std::vector<int> all;
  for (std::size_t n = 0; n < x.size(); ++n) {
    model.mesh.position.push_back({x[n], 0, 0});
    model.mesh.node_id.push_back(DeckId{model.mesh.node_count()});
    if (n == 0) continue;
    lines.nodes.insert(lines.nodes.end(), {static_cast<int>(n) - 1, static_cast<int>(n)});
    lines.part.push_back(0);
    lines.id.push_back(DeckId{lines.size()});
    all.push_back(lines.size() - 1);
  }
  model.point_mass.assign(x.size(), 1.0);
  model.blocks.push_back(make_line_block(model.mesh, 0, all, properties));
  return model;
}

std::vector<Vec3> force_with_end_at(Model& model, const Vec3& end) {
  model.finish();
  State state = initial_state(model);
  state.nodes.back().set_position(end);
  Scratch scratch(model, 1);
  compute_forces(model, state, scratch);
  return nodal_forces(model, scratch);
}

TEST(Line, TrussPullsAlongItsAxisAndACableDoesNotPush) {
  Model truss = chain({0, 2}, {ElasticLine{1000}});
  const std::vector<Vec3> pulled = force_with_end_at(truss, {3, 4, 0});
  EXPECT_NEAR((pulled[0] - 1000 * 1.5 * Vec3(0.6, 0.8, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR((pulled[0] + pulled[1]).norm(), 0, 1e-12);
  Model cable = chain({0, 2}, {ElasticLine{.axial_stiffness = 1000, .is_tension_only = true}});
  EXPECT_EQ(force_with_end_at(cable, {1, 0, 0})[0], Vec3::Zero());
}

TEST(Line, SlackLengthIsTakenUpFirst) {
  LineProperties properties{CurveLine{.force = Curve({0, 1}, {0, 100}, Curve::Outside::LastSlope),
                                      .is_tension_only = true}};
  properties.slack = {0.5};
  Model loose = chain({0, 2}, properties);
  EXPECT_EQ(force_with_end_at(loose, {2.4, 0, 0})[0], Vec3::Zero());
  Model taut = chain({0, 2}, properties);
  EXPECT_NEAR(force_with_end_at(taut, {3, 0, 0})[0].x(), 50, 1e-12);
}

TEST(Line, AStrandCarriesOneForceThroughItsViaPoints) {
  LineProperties properties{ElasticLine{300}};
  properties.strands = {{0, 1}};
  Model strand = chain({0, 1, 3}, properties);
  const std::vector<Vec3> force = force_with_end_at(strand, {4, 0, 0});  // 3 to 4: strain 1/3
  EXPECT_NEAR(force[0].x(), 100, 1e-10);
  EXPECT_NEAR(force[1].x(), 0, 1e-10);
  EXPECT_NEAR(force[2].x(), -100, 1e-10);
}

// Two masses on a spring: period 2 pi sqrt(m / 2 k); energy is kept.
TEST(Line, SpringOscillatesAtItsFrequency) {
  Model model = chain({0, 1}, {ElasticLine{.axial_stiffness = 50}});
  model.start_velocities.push_back({{0}, {-0.1, 0, 0}});
  model.start_velocities.push_back({{1}, {0.1, 0, 0}});
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  const double period = 2 * M_PI / std::sqrt(2 * 50.0);
  const int steps = 1000;
  StepReport report;
  for (int i = 0; i < steps; ++i) report = advance_step(model, state, scratch, period / steps);
  EXPECT_NEAR(state.nodes[1].x[0], 1, 1e-4);
  EXPECT_NEAR(state.nodes[1].v[0], 0.1, 1e-4);
  EXPECT_NEAR(report.stable_step, 2 / 10.0, 1e-12);
  EXPECT_LT(std::abs(state.energies.balance_error()), 1e-3);
}

// The closed forms of the law at chosen points.
TEST(HillMuscle, PassiveAndActiveForces) {
  HillMuscle muscle{.area = 1e-4,
                    .peak_stress = 5e5,
                    .passive_strain = 0.375,
                    .passive_exponent = 6,
                    .maximum_rate = 5};
  const auto force = [&](double stretch, double rate) {
    return muscle.answer({0.2, 0.2 * (stretch - 1), 0.2 * rate, 0.0}).force;
  };
  EXPECT_EQ(force(0.9, 0), 0);
  EXPECT_NEAR(force(1.375, 0), 50, 1e-9);
  EXPECT_NEAR(force(1.1, 0), 50 * std::expm1(1.6) / std::expm1(6.0), 1e-9);
  muscle.activation = Curve({0}, {0.5});
  EXPECT_NEAR(force(1.0, 0), 25, 1e-9);
  EXPECT_NEAR(force(1.0, -2.5), 25 * 0.5 / 3, 1e-9);
  EXPECT_NEAR(force(0.75, 5), 25 * std::exp(-1.0) * 16 / 11, 1e-9);
  EXPECT_EQ(force(1.0, -5), 0);
}

}  // namespace
}  // namespace crosswalk::fe
