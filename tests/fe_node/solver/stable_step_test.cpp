// The nodal stable step and nodal mass scaling on meshes of unequal elements, against the exact
// largest frequency.
#include "fe_node/stable_step.h"

#include <gtest/gtest.h>

#include "tests/fe_node/exact_step.h"
#include "tests/fe_node/solid_models.h"

namespace crosswalk::fe {
namespace {

const Elastic kFluidLike = Elastic::from_young(1000, 1e6, 0.49);

/// Three layers of cells of 1 m, the middle one squeezed to a tenth and sheared along x.
Model layered(SolidForm form, double shear) {
  return solid_model(form, {2, 2, 3, {2, 2, 3}}, kFluidLike, without_viscosity(),
                     [shear](const Vec3& p) {
                       const double z = p.z() > 1.5 ? p.z() - 0.9 : p.z();
                       return Vec3(p.x() + (p.z() > 1.5 ? 0.1 * shear : 0.0), p.y(), z);
                     });
}

double least_element_step(const Model& model) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& block : model.blocks)
    for (int e = 0; e < block->element_count(); ++e)
      least = std::min(least, block->initial_stable_step(e));
  return least;
}

class LayeredSolid : public testing::TestWithParam<SolidForm> {};

TEST_P(LayeredSolid, NodalStepLiesBetweenTheWorstElementsAndTheExactOne) {
  for (const double shear : {0.0, 3.0}) {
    Model model = layered(GetParam(), shear);
    model.finish();
    const double nodal = initial_stable_step(model), exact = exact_stable_step(model);
    EXPECT_LE(nodal, exact * (1 + 1e-4)) << shear;
    // a layer with a tenth of the mass lies between two whole ones
    EXPECT_GE(nodal, 1.9 * least_element_step(model)) << shear;
    State state = initial_state(model);
    Scratch scratch(model, 2);
    EXPECT_NEAR(compute_forces(model, state, scratch).stable_step, nodal, 1e-9 * nodal) << shear;
  }
}

TEST_P(LayeredSolid, MassIsAddedWhereTheStepLacksIt) {
  Model plain = layered(GetParam(), 3.0);
  plain.finish();
  const double wanted = 1.5 * initial_stable_step(plain);
  double element_wise = 0;
  for (int e = 0; e < plain.blocks[0]->element_count(); ++e) {
    const double lacking = wanted / plain.blocks[0]->initial_stable_step(e);
    if (lacking > 1)
      element_wise +=
          (lacking * lacking - 1) * plain.blocks[0]->corners() * plain.blocks[0]->corner_mass(e);
  }
  Model scaled = layered(GetParam(), 3.0);
  scaled.settings.mass_scaling_step = wanted;
  scaled.finish();
  EXPECT_NEAR(initial_stable_step(scaled), wanted, 1e-9 * wanted);
  EXPECT_LE(wanted, exact_stable_step(scaled) * (1 + 1e-4));
  const double added = scaled.added_mass[0];
  EXPECT_NEAR(scaled.total_mass() - plain.total_mass(), added, 1e-9 * added);
  EXPECT_GT(added, 0);
  EXPECT_LT(added, element_wise);
}

INSTANTIATE_TEST_SUITE_P(Solid, LayeredSolid,
                         testing::Values(SolidForm::OnePointBrick, SolidForm::FullBrick,
                                         SolidForm::Wedge, SolidForm::Tet, SolidForm::NodalTet),
                         [](const auto& item) { return std::string(name_of(item.param)); });

// A layer between two prescribed plates moves nothing; a free plate has the mass of its neighbours.
TEST(StableStep, NodesThatFollowAMotionBoundNothing) {
  for (const BodyRole role : {BodyRole::Prescribed, BodyRole::Free}) {
    Model model = layered(SolidForm::OnePointBrick, 0.0);
    for (int first : {9, 18}) {  // the two faces of the thin layer
      RigidBody plate;
      plate.name = "plate";
      plate.role = role;
      for (int n = first; n < first + 9; ++n) plate.nodes.push_back(n);
      model.bodies.push_back(plate);
    }
    model.finish();
    const double of_thick_cells = model.blocks[0]->initial_stable_step(0);
    if (role == BodyRole::Prescribed)
      EXPECT_NEAR(initial_stable_step(model), of_thick_cells, 1e-9 * of_thick_cells);
    else
      EXPECT_LT(initial_stable_step(model), 0.5 * of_thick_cells);
    EXPECT_LE(initial_stable_step(model), exact_stable_step(model) * (1 + 1e-4));
  }
}

// The scaled mass of a tied face goes to the facet's corners, and the step holds.
TEST(StableStep, ATieKeepsTheStep) {
  Model model = layered(SolidForm::OnePointBrick, 0.0);
  model.tied.push_back({.node = 0, .count = 2, .master = {1, 3}, .weight = {0.5, 0.5}});
  model.settings.mass_scaling_step = 1.2 * initial_stable_step(model);
  model.finish();
  const double wanted = model.settings.mass_scaling_step;
  EXPECT_NEAR(initial_stable_step(model), wanted, 1e-9 * wanted);
  State state = initial_state(model);
  Scratch scratch(model, 1);
  EXPECT_NEAR(compute_forces(model, state, scratch).stable_step, wanted, 1e-9 * wanted);
}

}  // namespace
}  // namespace crosswalk::fe
