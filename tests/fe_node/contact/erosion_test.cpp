// Contact surfaces whose elements fail.
#include <gtest/gtest.h>

#include "fe_node/contact/penalty.h"
#include "fe_node/contact/tied.h"
#include "tests/fe_node/box_model.h"

namespace crosswalk::fe {
namespace {

/// Three bricks on top of each other, 0.1 m each, and a free node above the stack.
struct Stack {
  Mesh mesh = box_mesh({1, 1, 3, {0.1, 0.1, 0.3}});
  int probe = mesh.node_count();
  std::vector<NodeRecord> nodes;
  std::vector<double> mass;
  FailedElements failed;
  ContactHistory history;
  std::unique_ptr<ContactInterface> contact;

  explicit Stack(InnerFaces inner) {
    mesh.position.push_back({0.05, 0.05, 0.32});
    mesh.node_id.push_back(DeckId{probe + 1});
    nodes.resize(mesh.node_count());
    mass.assign(mesh.node_count(), 1.0);
    for (int n = 0; n < mesh.node_count(); ++n) {
      nodes[n].set_position(mesh.position[n]);
      nodes[n].inverse_mass = 1;
    }
    PenaltySettings settings;
    settings.nominal_step = 1e-6;
    const ContactPart part{0, 1e6, 0, {}};
    const std::vector<int> probes{probe};
    contact = make_node_contact("c", ContactSurface::of_nodes(probes),
                                surface_of(mesh, {&part, 1}, inner), settings);
    contact->initialise(history, context(0));
  }
  ContactContext context(std::int64_t step) const {
    return {nodes, mass, {}, 1e-6 * static_cast<double>(step), 1e-6, step, 1, &failed};
  }
  /// Resultant on the probe with its node at the height z, moved there in one step.
  Vec3 force_at(double z, std::int64_t step) {
    nodes[probe].v[2] = (z - nodes[probe].x[2]) / 1e-6;
    nodes[probe].x[2] = z;
    ContactLoads loads;
    loads.on_body.resize(1);
    return contact->forces(context(step), history, loads).force;
  }
  void kill(int element) {
    std::vector<char>& dead = failed.is_dead[static_cast<std::size_t>(ElementKind::Hex8)];
    dead.resize(3, 0);
    dead[element] = 1;
    ++failed.count;
  }
};

TEST(Erosion, AFailedBrickUncoversTheOneBelow) {
  Stack stack(InnerFaces::Kept);
  EXPECT_GT(stack.force_at(0.299, 1).z(), 0);
  stack.kill(2);
  EXPECT_EQ(stack.force_at(0.299, 2).norm(), 0);  // its own top has gone
  EXPECT_EQ(stack.force_at(0.25, 3).norm(), 0);
  EXPECT_GT(stack.force_at(0.199, 4).z(), 0);  // the face between the two now carries
  stack.kill(1);
  EXPECT_EQ(stack.force_at(0.199, 5).norm(), 0);
  EXPECT_GT(stack.force_at(0.0995, 6).z(), 0);
}

TEST(Erosion, WithoutInnerFacesTheSurfaceOnlyVanishes) {
  Stack stack(InnerFaces::Left);
  EXPECT_GT(stack.force_at(0.299, 1).z(), 0);
  stack.kill(2);
  EXPECT_EQ(stack.force_at(0.299, 2).norm(), 0);
  EXPECT_NEAR(stack.force_at(0.199, 3).z(), 0, 1e-9);  // its sides may push it out sideways
}

TEST(Erosion, InnerFacesDoNotPushWhileTheyAreCovered) {
  Stack stack(InnerFaces::Kept);
  EXPECT_NEAR(stack.force_at(0.15, 1).z(), 0, 1e-9);  // its sides may push it out sideways
  EXPECT_NEAR(stack.force_at(0.199, 2).z(), 0, 1e-9);
}

TEST(Erosion, ATieToAFailedElementLetsGo) {
  Mesh mesh = box_mesh({1, 1, 1, {0.1, 0.1, 0.1}});
  mesh.position.push_back({0.05, 0.05, 0.1});
  std::vector<NodeRecord> nodes(mesh.position.size());
  const std::vector<double> mass(nodes.size(), 1.0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes[n].set_position(mesh.position[n]);
    nodes[n].inverse_mass = 1;
  }
  const ContactPart part{0, 1e6, 0, {}};
  const std::vector<int> tied{8};
  const auto contact = make_tied_contact("t", ContactSurface::of_nodes(tied),
                                         surface_of(mesh, {&part, 1}), {1e-6, 0});
  FailedElements failed;
  const ContactContext context{nodes, mass, {}, 0, 1e-6, 0, 1, &failed};
  ContactHistory history;
  contact->initialise(history, context);
  nodes[8].x[2] += 0.001;
  ContactLoads loads;
  EXPECT_LT(contact->forces(context, history, loads).force.z(), 0);
  failed.is_dead[static_cast<std::size_t>(ElementKind::Hex8)] = {1};
  failed.count = 1;
  EXPECT_EQ(contact->forces(context, history, loads).force.norm(), 0);
}

}  // namespace
}  // namespace crosswalk::fe
