// The coupling boundary against the monolithic solution: a soft bar on a rigid body that is either
// part of the finite-element model or advanced outside, once per window.
#include <gtest/gtest.h>

#include "fe_node/boundary.h"
#include "tests/fe_node/box_model.h"

namespace crosswalk::fe {
namespace {

constexpr double kMoment = 0.002;  // kg m2, of a sphere: constant in W

/// A bar of 0.3 kg along z whose lower end is rigid; the upper end has a sideways velocity.
Model bar(BodyRole role, double body_mass) {
  const Box box{2, 2, 10, {0.04, 0.04, 0.2}};
  Model model = box_model(box, Elastic::from_young(1000, 2e6, 0.3));
  RigidBody body;
  body.role = role;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 2; ++i) body.nodes.push_back(box.node(i, j, 0));
  if (role == BodyRole::Free) {
    body.own = Inertia::of_point(body_mass, {0.02, 0.02, 0});
    body.own.about_com = kMoment * Mat3::Identity();
  }
  model.bodies.push_back(body);
  std::vector<int> upper;
  for (int n = 0; n < model.mesh.node_count(); ++n)
    if (model.mesh.position[n].z() > 0.09) upper.push_back(n);
  model.start_velocities.push_back({upper, {2.0, 1.0, 0.5}});
  model.finish();
  return model;
}

/// Momentum of the free nodes.
Vec3 momentum(const Model& model, const State& state) {
  Vec3 p = Vec3::Zero();
  for (int n = 0; n < model.mesh.node_count(); ++n)
    if (model.body_of_node[n] < 0) p += model.mass[n] * state.nodes[n].velocity();
  return p;
}

/// One free body with an isotropic inertia, advanced like the multibody side does in the scheme.
struct FreeBody {
  double mass = 0;
  BodyMotion motion;
  Vec6 carry = Vec6::Zero(), bias = Vec6::Zero();
  Vec6 inverse() const {
    Vec6 w;
    w << Vec3::Constant(1 / mass), Vec3::Constant(1 / kMoment);
    return w;
  }
};

struct Outcome {
  Vec3 tip, p;
  double largest_gap = 0;
  double work_fe = 0, work_mb = 0;
};

Outcome run_coupled(double body_mass, std::int64_t window_ns, double end) {
  Model model = bar(BodyRole::Driven, 0);
  State state = initial_state(model);
  FreeBody mb;
  mb.motion.X_WB.p = {0.02, 0.02, 0};
  const Boundary boundary{{0}, 1};
  const std::vector<Inertia> blocks =
      rebase_bodies(boundary, {{"body", mb.motion, {}, true}}, model, state);
  mb.mass =
      body_mass + blocks[0].mass;  // its moment about the body's own centre is 1e-5: neglected
  Scratch scratch(model, 1);
  FeGrant grant;
  grant.id.window_ns = window_ns;
  const double H = grant.id.length_s();
  grant.mobility = 1.05 * mb.inverse().asDiagonal().toDenseMatrix();
  Outcome outcome;
  const int windows = static_cast<int>(std::lround(end / H));
  for (int w = 0; w < windows; ++w) {
    const Vec6 V_n = stack(mb.motion.V_WB);
    const Vec6 V_0 = V_n + mb.inverse().cwiseProduct(mb.carry);
    const Vec6 change = H * mb.inverse().cwiseProduct(mb.bias);
    grant.id.window = w;
    grant.drives = {{mb.motion.X_WB, twist_from(V_0), change, mb.bias}};
    const WindowLoads reply = advance_window(model, boundary, grant, state, scratch);
    outcome.work_mb += (mb.carry + H * mb.bias).dot(V_n + 0.5 * (V_0 + change - V_n));
    mb.motion.V_WB = twist_from(V_0 + change);
    mb.motion.X_WB.p += H * mb.motion.V_WB.v;
    mb.motion.X_WB.q = exp_rotation(H * mb.motion.V_WB.w) * mb.motion.X_WB.q;
    mb.carry = reply.loads[0].impulse - H * mb.bias;
    mb.bias = reply.loads[0].impulse / H;
    outcome.largest_gap = std::max(outcome.largest_gap, reply.loads[0].gap_position.norm());
  }
  outcome.tip = state.nodes.back().position();
  outcome.p = momentum(model, state) + mb.mass * mb.motion.V_WB.v + mb.carry.head<3>();
  outcome.work_fe = state.energies.interface_work;
  return outcome;
}

Vec3 run_monolithic(double body_mass, double end) {
  const Model model = bar(BodyRole::Free, body_mass);
  State state = initial_state(model);
  Scratch scratch(model, 1);
  const int steps = static_cast<int>(std::ceil(end / (0.5 * initial_stable_step(model))));
  for (int i = 0; i < steps; ++i) advance_step(model, state, scratch, end / steps);
  return state.nodes.back().position();
}

TEST(Coupling, FollowsTheMonolithicSolutionForHeavyAndLightBodies) {
  constexpr double kEnd = 0.1;
  const Model model = bar(BodyRole::Driven, 0);
  const Vec3 p0 = momentum(model, initial_state(model));
  for (double body_mass : {15.0, 1.0, 0.1}) {
    const Vec3 reference = run_monolithic(body_mass, kEnd);
    for (std::int64_t window_ns : {20000, 100000}) {
      const Outcome outcome = run_coupled(body_mass, window_ns, kEnd);
      SCOPED_TRACE(testing::Message() << body_mass << " kg, " << window_ns << " ns");
      // The tip travels 60 to 200 mm; first-order outer stepping at H leaves tens of micrometres,
      // the light body a millimetre.
      EXPECT_LT((outcome.tip - reference).norm(), body_mass < 0.5 ? 2e-3 : 4e-4);
      EXPECT_LT((outcome.p - p0).norm(), 1e-10 * p0.norm());
      EXPECT_LT(outcome.largest_gap, 1e-4);
      EXPECT_NEAR(outcome.work_fe + outcome.work_mb, 0, 0.01 * std::abs(outcome.work_fe));
    }
  }
}

TEST(Coupling, BlockMassMovesToTheBodyWhole) {
  Model model = bar(BodyRole::Driven, 0);
  const double all = model.total_mass();
  const Pose X_WD{exp_rotation({0, 0, 0.5}), {1, 2, 3}};
  State state = initial_state(model, X_WD);
  const State before = state;
  InterfaceBody partner{"body", {{exp_rotation({0.2, 0, 0}), {1.1, 2, 2.9}}, {}}, {}, true};
  const std::vector<Inertia> blocks = rebase_bodies({{0}, 1}, {partner}, model, state);
  double free_mass = 0, tied = 0;
  Vec3 first_moment = Vec3::Zero();
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const bool is_tied = model.body_of_node[n] == 0;
    (is_tied ? tied : free_mass) += model.mass[n];
    if (is_tied)
      first_moment += model.mass[n] * (state.nodes[n].position() - partner.motion.X_WB.p);
  }
  EXPECT_NEAR(blocks[0].mass + free_mass, all, 1e-14);
  EXPECT_LT((blocks[0].mass * blocks[0].com - first_moment).norm(), 1e-14);
  Scratch scratch(model, 1);
  advance_step(model, state, scratch, 1e-9);
  for (int n : model.bodies[0].nodes)
    EXPECT_LT((state.nodes[n].position() - before.nodes[n].position()).norm(), 1e-12);
}

}  // namespace
}  // namespace crosswalk::fe
