#include "fe_node/contact/rigid_surface.h"

#include <gtest/gtest.h>

#include "common/units.h"
#include "fe_node/solver.h"
#include "tests/fe_node/box_model.h"

namespace crosswalk::fe {
namespace {

TEST(RigidShape, DepthAndNormalOfEachKind) {
  const Penetration plane = penetration(RigidPlane{{0, 0, 1}, {0, 0, 1}}, {5, 5, 0.7});
  EXPECT_NEAR(plane.depth, 0.3, 1e-15);
  const RigidFacet facet{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 3, 0.25};
  EXPECT_NEAR(penetration(facet, {1, 1, -0.1}).depth, 0.1, 1e-15);
  EXPECT_LT(penetration(facet, {1, 1, 0.1}).depth, 0);
  EXPECT_LT(penetration(facet, {2.1, 1, -0.1}).depth, -1e9);
  EXPECT_LT(penetration(facet, {1, 1, -0.3}).depth, -1e9);
  const RigidEllipsoid ellipsoid{{exp_rotation({0, 0, kPi / 2}), {1, 0, 0}}, {0.3, 0.2, 0.1}};
  const Penetration tip = penetration(ellipsoid, {1, 0.29, 0});  // its long axis lies along y
  EXPECT_NEAR(tip.depth, 0.01, 1e-12);
  EXPECT_LT((tip.normal - Vec3::UnitY()).norm(), 1e-12);
  const Penetration side = penetration(RigidCylinder{{0, 0, 0}, {0, 0, 1}, 0.5}, {0, 0.4, 7});
  EXPECT_NEAR(side.depth, 0.1, 1e-15);
  EXPECT_LT((side.normal - Vec3::UnitY()).norm(), 1e-15);
}

/// A soft cube of side 0.1 m and 1 kg over a horizontal plane that belongs to a follower body.
Model cube_over_plane(const RigidPatch& patch, double friction) {
  const Box box{2, 2, 2, {0.1, 0.1, 0.1}};
  Model model = box_model(box, Elastic::from_young(1000, 5e6, 0.3), without_viscosity());
  RigidBody ground;
  ground.name = "ground";
  ground.role = BodyRole::Follower;
  model.bodies.push_back(ground);
  std::vector<int> nodes;
  for (int n = 0; n < model.mesh.node_count(); ++n) nodes.push_back(n);
  model.contacts.push_back(
      make_rigid_surface_contact({"cube on ground", 0, nodes, {patch}, friction}));
  return model;
}

std::vector<int> all_nodes(const Model& model) {
  std::vector<int> nodes;
  for (int n = 0; n < model.mesh.node_count(); ++n) nodes.push_back(n);
  return nodes;
}

Vec3 mean_velocity(const Model& model, const State& state) {
  Vec3 p = Vec3::Zero();
  for (int n = 0; n < model.mesh.node_count(); ++n) p += model.mass[n] * state.nodes[n].velocity();
  return p / model.total_mass();
}

TEST(RigidSurface, SlidingBlockIsSlowedByMuG) {
  Model model = cube_over_plane({"ground", {RigidPlane{}}, PenaltyLaw{0.02, 2e-4, 0.5}}, 0.3);
  model.settings.gravity = {0, 0, -kStandardGravity};
  model.start_velocities.push_back({all_nodes(model), {2, 0, 0}});
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  const double dt = 0.5 * initial_stable_step(model);
  while (state.time < 0.4) advance_step(model, state, scratch, dt);
  const Vec3 v = mean_velocity(model, state);
  EXPECT_NEAR(v.x(), 2 - 0.3 * kStandardGravity * state.time, 0.02);
  EXPECT_NEAR(v.y(), 0, 1e-9);
  // Weight is carried, and every joule lost went into friction.
  EXPECT_NEAR(state.energies.contact_dissipated, 0.5 * (4 - v.x() * v.x()), 0.03);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
  while (state.time < 0.9) advance_step(model, state, scratch, dt);
  EXPECT_LT(mean_velocity(model, state).norm(), 0.01);  // it has stopped and stays
}

TEST(RigidSurface, ElasticBounceGivesTheEnergyBack) {
  Model model = cube_over_plane({"ground", {RigidPlane{}}, PenaltyLaw{0.1, 1e-4, 0.0}}, 0);
  model.start_velocities.push_back({all_nodes(model), {0, 0, -1}});
  model.finish();
  State state = initial_state(model, {Quat::Identity(), {0, 0, 0.001}});
  Scratch scratch(model, 1);
  const double dt = 0.3 * initial_stable_step(model);
  double impulse = 0;
  while (state.time < 0.02) {
    advance_step(model, state, scratch, dt);
    impulse += dt * scratch.contact_reports[0].force.z();
    EXPECT_NEAR(scratch.body_wrench[0].f.z(), -scratch.contact_reports[0].force.z(), 1e-9);
  }
  EXPECT_NEAR(mean_velocity(model, state).z(), impulse - 1, 1e-9);
  EXPECT_GT(mean_velocity(model, state).z(), 0.8);  // the rest vibrates
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
  EXPECT_EQ(state.energies.contact_stored, 0);
}

TEST(RigidSurface, CharacteristicIsFollowedUpAndDown) {
  // The plane is pushed against a cube that is held: force against depth is the curve's, and
  // unloading comes down to the permanent depth.
  const CharacteristicLaw law{Curve({0, 0.01, 0.02}, {0, 500, 800}, Curve::Outside::LastSlope), 0.5,
                              1};
  Model model = cube_over_plane({"glass", {RigidPlane{}}, law}, 0);
  for (int n : all_nodes(model)) model.fixed.push_back({n, {true, true, true}, {}});
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  const auto force_at = [&](double depth) {
    state.bodies[0].X_WB.p.z() = depth;
    compute_forces(model, state, scratch);
    return scratch.contact_reports[0].force.z();
  };
  EXPECT_EQ(force_at(-0.001), 0);
  state.step = 1;  // initialised
  EXPECT_NEAR(force_at(0.005), 250, 1e-9);
  EXPECT_NEAR(force_at(0.015), 650, 1e-9);
  EXPECT_EQ(scratch.contact_reports[0].active, 9);
  EXPECT_NEAR(force_at(0.012), 650 * (0.012 - 0.0075) / 0.0075, 1e-9);
  EXPECT_EQ(force_at(0.007), 0);
  EXPECT_NEAR(force_at(0.02), 800, 1e-9);
}

TEST(RigidSurface, NodesInsideAtTheStartAreLeftAlone) {
  Model model = cube_over_plane({"ground", {RigidPlane{{0, 0, 0.04}, {0, 0, 1}}}, PenaltyLaw{}}, 0);
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  compute_forces(model, state, scratch);
  EXPECT_EQ(scratch.contact_reports[0].active, 0);
}

}  // namespace
}  // namespace crosswalk::fe
