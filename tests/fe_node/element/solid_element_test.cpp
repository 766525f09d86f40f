// What every solid element must do: one list of properties over all of them.
#include <gtest/gtest.h>

#include "fe_node/solver.h"
#include "tests/fe_node/energy_slope.h"
#include "tests/fe_node/exact_step.h"
#include "tests/fe_node/solid_models.h"

namespace crosswalk::fe {
namespace {

const Elastic kStiff = Elastic::from_young(1000, 1e6, 0.3);

class EverySolid : public testing::TestWithParam<SolidForm> {
 protected:
  Model wavy_box(const SolidLaw& law = kStiff) const {
    Model model = solid_model(GetParam(), {3, 3, 3, {1, 1, 1}}, law, without_viscosity(),
                              [](const Vec3& p) { return wavy(p); });
    model.finish();
    return model;
  }
};

std::vector<Vec3> forces_at(const Model& model, State& state) {
  Scratch scratch(model, 1);
  compute_forces(model, state, scratch);
  return nodal_forces(model, scratch);
}

/// Outer nodes are those of faces of the unwarped unit box: the first 64 nodes stand in its order.
bool is_inner(int n) {
  if (n >= 64) return true;  // centres of pyramids
  const int i = n % 4, j = n / 4 % 4, k = n / 16;
  return i % 3 != 0 && j % 3 != 0 && k % 3 != 0;
}

TEST_P(EverySolid, PatchCarriesConstantStress) {
  const Model model = wavy_box();
  State state = initial_state(model);
  Mat3 F;
  F << 1.1, 0.05, -0.02, 0.1, 0.95, 0.03, 0.02, -0.06, 1.04;
  for (NodeRecord& node : state.nodes) node.set_position(F * node.position());
  const std::vector<Vec3> force = forces_at(model, state);
  for (std::size_t n = 0; n < force.size(); ++n)
    if (is_inner(static_cast<int>(n))) {
      EXPECT_LT(force[n].norm(), 1e-8);  // of about 1e5 N
    }
  SolidStep<double> step;
  const Mat3 back = F.inverse();
  for (int k = 0; k < 9; ++k) {
    step.F(k / 3, k % 3) = F(k / 3, k % 3);
    step.F_inverse(k / 3, k % 3) = back(k / 3, k % 3);
    step.F_rate(k / 3, k % 3) = 0;
  }
  step.J = F.determinant();
  const Symmetric<double> s = cauchy_stress(kStiff.update<double>(step, nullptr).P, step.F, step.J);
  const StepContext context{state.nodes, {}, 0, 0, true};
  for (int e = 0; e < model.blocks[0]->element_count(); e += 7) {
    const ElementSample sample = model.blocks[0]->sample(context, state.history[0], e);
    EXPECT_NEAR(sample.stress(0, 0), s.xx, 1e-6 * 1e6);
    EXPECT_NEAR(sample.stress(1, 2), s.yz, 1e-6 * 1e6);
  }
}

TEST_P(EverySolid, RigidRotationGivesNoStress) {
  const Model model = wavy_box();
  State state = initial_state(model, {exp_rotation({0.5, 1.4, -2}), {3, 2, 1}});
  for (const Vec3& f : forces_at(model, state)) EXPECT_LT(f.norm(), 1e-8);
}

/// Any deformed place: forces are minus the slope of the energy, hourglass energy included.
TEST_P(EverySolid, ForcesAreTheSlopeOfTheEnergyAndBalance) {
  const Model model = wavy_box();
  State state = initial_state(model);
  for (std::size_t n = 0; n < state.nodes.size(); ++n)
    state.nodes[n].set_position(state.nodes[n].position() +
                                0.02 * Vec3(std::sin(5.0 * static_cast<double>(n)),
                                            std::cos(3.0 * static_cast<double>(n)),
                                            std::sin(7.0 * static_cast<double>(n))));
  Scratch scratch(model, 1);
  compute_forces(model, state, scratch);
  const std::vector<Vec3> force = nodal_forces(model, scratch);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t n = 0; n < force.size(); ++n) {
    sum += force[n];
    moment += state.nodes[n].position().cross(force[n]);
  }
  EXPECT_LT(sum.norm(), 1e-9);
  EXPECT_LT(moment.norm(), 1e-9);
  const auto energy = [&] {
    compute_forces(model, state, scratch);
    return state.energies.internal + state.energies.hourglass_stored;
  };
  expect_slope(state, force, energy, 1e-6, 1e-3, 5);  // forces are of order 1e5 N
}

/// The estimate against the largest frequency of the assembled stiffness and mass.
TEST_P(EverySolid, StableStepIsBelowTheExactOneAndNotWasteful) {
  for (const double poisson : {0.0, 0.3, 0.499}) {
    Model model = solid_model(GetParam(), {2, 1, 1, {2, 1, 0.7}},
                              Elastic::from_young(1000, 1e6, poisson), without_viscosity());
    model.finish();
    const double exact = exact_stable_step(model);
    const double estimate = initial_stable_step(model);
    EXPECT_LE(estimate, exact * (1 + 1e-4)) << poisson;
    EXPECT_GE(estimate, 0.4 * exact) << poisson;
  }
}

TEST_P(EverySolid, MassIsThatOfItsVolume) {
  const Model model = wavy_box();
  double volume = 0;
  for (int e = 0; e < model.blocks[0]->element_count(); ++e)
    volume += model.blocks[0]->element_volume(e);
  EXPECT_NEAR(model.total_mass(), 1000 * volume, 1e-9 * model.total_mass());
  EXPECT_NEAR(volume, 1, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Solid, EverySolid,
                         testing::Values(SolidForm::OnePointBrick, SolidForm::FullBrick,
                                         SolidForm::Wedge, SolidForm::Pyramid, SolidForm::Tet,
                                         SolidForm::NodalTet),
                         [](const auto& item) { return std::string(name_of(item.param)); });

TEST(SolidElements, ANodalTetLooksTheSameForAnyNumberOfThreads) {
  Model model = solid_model(SolidForm::NodalTet, {4, 4, 4, {0.1, 0.1, 0.1}}, kStiff);
  model.start_velocities.push_back({{0, 3, 7, 30, 50}, {4, -3, 2}});
  model.finish();
  std::vector<State> ends;
  for (int threads : {1, 3}) {
    State state = initial_state(model);
    Scratch scratch(model, threads);
    const double dt = 0.8 * initial_stable_step(model);
    for (int i = 0; i < 30; ++i) advance_step(model, state, scratch, dt);
    ends.push_back(state);
  }
  for (std::size_t n = 0; n < ends[0].nodes.size(); ++n)
    EXPECT_EQ(ends[0].nodes[n].position(), ends[1].nodes[n].position());
}

TEST(SolidElements, AFailedElementIsFlaggedAndCarriesNothing) {
  Plastic weak{1000, 1e9, 4e8, YieldStress(HardeningCurve::linear(1e6, 0)), 0, 0.05};
  for (SolidForm form :
       {SolidForm::OnePointBrick, SolidForm::FullBrick, SolidForm::Tet, SolidForm::NodalTet}) {
    Model model = solid_model(form, {2, 1, 1, {2, 1, 1}}, weak, without_viscosity());
    model.finish();
    State state = initial_state(model);
    Scratch scratch(model, 1);
    compute_forces(model, state, scratch);
    state.last_dt = 1;
    for (NodeRecord& node : state.nodes) {  // isochoric stretch in one step
      const Vec3 x = node.position(),
                 y(1.2 * x.x(), x.y() / std::sqrt(1.2), x.z() / std::sqrt(1.2));
      node.set_velocity(y - x);
      node.set_position(y);
    }
    compute_forces(model, state, scratch);
    const int count = model.blocks[0]->element_count();
    EXPECT_EQ(scratch.failed.count, count) << name_of(form);
    for (int e = 0; e < count; ++e)
      EXPECT_TRUE(scratch.failed.contains(model.blocks[0]->kind(), e)) << name_of(form);
    for (const Vec3& f : nodal_forces(model, scratch)) EXPECT_EQ(f.norm(), 0);
  }
}

}  // namespace
}  // namespace crosswalk::fe
