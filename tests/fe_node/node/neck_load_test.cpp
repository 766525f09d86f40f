// The load between head and neck against the momentum that it gives the head.
#include <gtest/gtest.h>

#include "fe_node/output/section_force.h"
#include "fe_node/own_head.h"
#include "tests/fe_node/node/node_fixture.h"

namespace crosswalk::fe {
namespace {

struct Momentum {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  ///< angular about the origin of W
};

/// Of the nodes of a cut, those of shells with their spin, and the rigid bodies that hold some of
/// them.
Momentum momentum_of(const Model& model, const SectionCut& cut, const State& state) {
  Momentum sum;
  std::vector<char> is_counted(model.bodies.size(), 0);
  for (int n : cut.nodes) {
    const int b = model.body_of_node[n];
    Vec3 x = state.nodes[n].position(), p = model.mass[n] * state.nodes[n].velocity();
    if (b >= 0) {
      if (is_counted[b]) continue;
      is_counted[b] = 1;
      const BodyState& body = state.bodies[b];
      x = body.X_WB.p;
      p = model.bodies[b].inertia.mass * body.V_WB.v;
      sum.angular += body.angular_momentum;
    } else if (model.has_rotations()) {
      sum.angular += model.inertia[n] * state.spin[n];
    }
    sum.linear += p;
    sum.angular += x.cross(p);
  }
  return sum;
}

TEST(NeckLoad, IsTheChangeOfTheHeadsMomentum) {
  // The generated head and neck turn about the torso, whose block stays where it is.
  FeConfig config = node_config("[windshield]\nmodel = \"rigid\"\n");
  config.partner_shapes.clear();
  const NodeModel node = build_node_model(config, {});
  const Model& model = node.built.model;
  const std::vector<int>& head =
      node.built.part_sets[require_part_set(node.built, kHeadParts)].second;
  const SectionCut cut = cut_round(model, head);
  Scratch scratch(model, 1);
  const SectionForce neck(model, cut, scratch);
  State state = initial_state(model, Pose{}, Twist{{4, 3, 2}, {0.5, 1, 0}});
  Momentum impulse;
  const Momentum before = momentum_of(model, cut, state);
  for (int step = 0; step < 400; ++step) {
    const StepReport report = compute_forces(model, state, scratch);
    for (const ContactReport& contact : scratch.contact_reports)
      ASSERT_EQ(contact.force.norm(), 0) << "step " << step;
    const double dt = next_step(model, state, report), kick = 0.5 * (state.last_dt + dt);
    const Wrench load = neck.about(Vec3::Zero(), state, scratch);
    impulse.linear += kick * load.f;
    impulse.angular += kick * load.tau;
    for (Twist& command : scratch.body_command) command = {};
    move(model, state, scratch, dt);
  }
  const Momentum after = momentum_of(model, cut, state);
  EXPECT_GT(impulse.linear.norm(), 1e-3);
  EXPECT_LT((after.linear - before.linear - impulse.linear).norm(), 1e-9 * impulse.linear.norm());
  EXPECT_LT((after.angular - before.angular - impulse.angular).norm(),
            1e-9 * impulse.angular.norm());
}

}  // namespace
}  // namespace crosswalk::fe
