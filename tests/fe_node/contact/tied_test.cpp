#include "fe_node/contact/tied.h"

#include <gtest/gtest.h>

#include "tests/fe_node/plate_model.h"

namespace crosswalk::fe {
namespace {

/// A 2 x 2 plate and three nodes over it: two near enough to be tied, one far away.
struct TiedScene {
  Mesh mesh = plate_mesh({2, 2, 0.2, 0.2},
                         [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.1 * p.x() * p.y()); });
  std::vector<NodeRecord> nodes;
  std::vector<double> mass;
  std::unique_ptr<ContactInterface> contact;
  ContactHistory history;
  int first = 0;

  TiedScene() {
    first = mesh.node_count();
    for (const Vec3& p : {Vec3(0.04, 0.03, 0.008), Vec3(0.13, 0.06, -0.004), Vec3(0.1, 0.1, 0.1)}) {
      mesh.position.push_back(p);
      mesh.node_id.push_back(DeckId{mesh.node_count()});
    }
    nodes.resize(mesh.node_count());
    mass.assign(mesh.node_count(), 1.0);
    for (int n = 0; n < mesh.node_count(); ++n) {
      nodes[n].set_position(mesh.position[n]);
      nodes[n].inverse_mass = 1;
    }
    const ContactPart part{0, 1e6, 0.02, {}};
    const int list[] = {first, first + 1, first + 2};
    contact = make_tied_contact("t", ContactSurface::of_nodes(list), surface_of(mesh, {&part, 1}),
                                {1e-4, 0});
    contact->initialise(history, context());
  }
  ContactContext context() const { return {nodes, mass, {}, 0, 1e-4, 0, 1}; }
};

TEST(TiedContact, RigidMotionOfBothCostsNothing) {
  TiedScene scene;
  const Mat3 R = exp_rotation({0.4, -0.7, 1.1}).toRotationMatrix();
  for (int n = 0; n < scene.mesh.node_count(); ++n)
    scene.nodes[n].set_position(R * scene.mesh.position[n] + Vec3(1, 2, 3));
  ContactLoads loads;
  const ContactReport report = scene.contact->forces(scene.context(), scene.history, loads);
  EXPECT_EQ(report.active, 2);
  const double k = 0.25 * 0.5 / 1e-8;
  for (const NodalLoad& load : loads.nodal) EXPECT_LT(load.force.norm(), 1e-13 * k);
}

TEST(TiedContact, ForcesBalanceAndAreTheSlopeOfTheStoredEnergy) {
  TiedScene scene;
  for (int n = 0; n < scene.mesh.node_count(); ++n)
    scene.nodes[n].set_position(scene.mesh.position[n] +
                                2e-3 * Vec3(std::sin(3 * n), std::sin(5 * n), std::sin(7 * n)));
  ContactLoads loads;
  scene.contact->forces(scene.context(), scene.history, loads);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  std::vector<Vec3> force(scene.nodes.size(), Vec3::Zero());
  double scale = 0;
  for (const NodalLoad& load : loads.nodal) {
    sum += load.force;
    moment += scene.nodes[load.node].position().cross(load.force);
    force[load.node] += load.force;
    scale += load.force.norm();
  }
  EXPECT_LT(sum.norm(), 1e-13 * scale);
  EXPECT_LT(moment.norm(), 1e-13 * scale);
  auto stored = [&] {
    ContactLoads none;
    return scene.contact->forces(scene.context(), scene.history, none).stored;
  };
  const double h = 1e-7;
  for (int n = 0; n < scene.mesh.node_count(); ++n)
    for (int axis = 0; axis < 3; ++axis) {
      double& x = scene.nodes[n].x[axis];
      const double kept = x;
      x = kept + h;
      const double up = stored();
      x = kept - h;
      const double down = stored();
      x = kept;
      EXPECT_NEAR(force[n][axis], -(up - down) / (2 * h), 1e-5 * scale);
    }
}

}  // namespace
}  // namespace crosswalk::fe
