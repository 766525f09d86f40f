// Joints, beams and section forces of decks against closed forms.
#include <numbers>

#include <gtest/gtest.h>

#include "fe_node/output/history.h"
#include "tests/fe_node/run_until.h"
#include "tests/verification/deck_model.h"

namespace crosswalk::fe {
namespace {

/// A brick element of a box between two corners, with its nodes from `first`.
std::string brick(int element, int part, int first, const Vec3& low, const Vec3& high) {
  std::string text = "*NODE\n";
  for (int k = 0; k < 8; ++k)
    text += node_card(first + k, {k % 4 == 1 || k % 4 == 2 ? high.x() : low.x(),
                                  k % 4 >= 2 ? high.y() : low.y(), k >= 4 ? high.z() : low.z()});
  text += fmt::format("*ELEMENT_SOLID\n{},{}", element, part);
  for (int k = 0; k < 8; ++k) text += fmt::format(",{}", first + k);
  return text + '\n';
}

/// A rigid bar hung by its end from a rigid block that is held, on a hinge along y or a ball.
std::string pendulum(bool is_hinge) {
  std::string text =
      "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*PART\nbar\n2,1,2\n"
      "*MAT_RIGID\n1,1000,1e9,0.3\n1,7,7\n\n*MAT_RIGID\n2,1000,1e9,0.3\n\n\n";
  text += brick(1, 1, 1, {-0.05, -0.05, 0.0}, {0.05, 0.05, 0.1});
  text += brick(2, 2, 11, {-0.02, -0.02, -0.5}, {0.02, 0.02, 0.0});
  text += "*NODE\n" + node_card(21, {0, -0.02, 0}) + node_card(22, {0, -0.02, 0}) +
          node_card(23, {0, 0.02, 0}) + node_card(24, {0, 0.02, 0}) + node_card(25, {0, 0, 0}) +
          node_card(26, {0, 0, 0});
  text +=
      "*CONSTRAINED_EXTRA_NODES_SET\n1,1\n*SET_NODE_LIST\n1\n21,23,25\n"
      "*CONSTRAINED_EXTRA_NODES_SET\n2,2\n*SET_NODE_LIST\n2\n22,24,26\n";
  text += is_hinge ? "*CONSTRAINED_JOINT_REVOLUTE\n21,22,23,24\n"
                   : "*CONSTRAINED_JOINT_SPHERICAL\n25,26\n";
  return text + "*LOAD_BODY_Z\n1,9.81\n*DEFINE_CURVE\n1\n0,1\n10,1\n";
}

const RigidBody& body_named(const Model& model, const std::string& name, int& index) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].name == name) index = static_cast<int>(b);
  return model.bodies[index];
}

// A physical pendulum: T = 2 pi sqrt(I / (m g d)), I of the bar about its end. A swing of 0.05 rad
// lengthens it by a 1/6400. The hinge holds the other two turns.
TEST(FeDeck, RevoluteJointSwingsAsAPendulum) {
  BuiltModel built_model = built(pendulum(true));
  finish_model(built_model);
  const Model& model = built_model.model;
  int bar = -1;
  const RigidBody& body = body_named(model, "bar", bar);
  State state = initial_state(model);
  const double d = -body.origin.z(), m = body.inertia.mass;
  const double about_end = body.inertia.about_com(1, 1) + m * d * d;
  const double period = 2 * std::numbers::pi * std::sqrt(about_end / (m * 9.81 * d));
  const double start = 0.05 * 2 * std::numbers::pi / period;
  state.bodies[bar].V_WB = {Vec3(0, start, 0).cross(Vec3(0, 0, -d)), Vec3(0, start, 0)};
  state.bodies[bar].angular_momentum =
      angular_momentum(body, state.bodies[bar].X_WB, {0, start, 0});
  Scratch scratch(model, 1);
  const double dt = 2e-6;
  double last = 0, crossing = 0, turned = 0, gap = 0;
  while (state.time < 0.6 * period) {
    advance_step(model, state, scratch, dt);
    const double x = state.bodies[bar].X_WB.p.x();
    if (x * last < 0) crossing = state.time - dt * x / (x - last);
    last = x;
    const Vec3 turn = log_rotation(state.bodies[bar].X_WB.q);
    turned = std::max({turned, std::abs(turn.x()), std::abs(turn.z())});
    gap = std::max(gap, scratch.contact_reports[0].max_penetration);
  }
  EXPECT_NEAR(2 * crossing, period, 2e-3 * period);
  EXPECT_LT(turned, 1e-6);
  EXPECT_LT(gap, 1e-7);  // the weight on the penalty spring
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

// A ball joint lets a bar spin about its own axis and swing in any plane, and carries its weight.
TEST(FeDeck, SphericalJointCarriesAndLetsTurn) {
  BuiltModel built_model = built(pendulum(false));
  finish_model(built_model);
  const Model& model = built_model.model;
  int bar = -1;
  const RigidBody& body = body_named(model, "bar", bar);
  State state = initial_state(model);
  state.bodies[bar].V_WB = {Vec3::Zero(), {0, 0, 3}};
  state.bodies[bar].angular_momentum = angular_momentum(body, state.bodies[bar].X_WB, {0, 0, 3});
  Scratch scratch(model, 1);
  Vec3 mean = Vec3::Zero();
  int count = 0;
  while (state.time < 0.2) {
    advance_step(model, state, scratch, 2e-6);
    if (state.time < 0.1) continue;
    mean += scratch.contact_reports[0].force;
    ++count;
  }
  EXPECT_NEAR(state.bodies[bar].V_WB.w.z(), 3, 1e-6);
  const double weight = body.inertia.mass * 9.81;
  EXPECT_NEAR(mean.z() / count, -weight, 0.01 * weight);  // pulls the block down
}

// Two free bars on a ball joint: momenta to round-off whatever they do, and the gap stays small.
TEST(FeDeck, JointedBodiesInFreeFlightKeepMomenta) {
  std::string text = pendulum(false);
  text.replace(text.find("1,7,7"), 5, "0,0,0");
  text.erase(text.find("*LOAD_BODY_Z"), std::string("*LOAD_BODY_Z\n1,9.81\n").size());
  BuiltModel built_model = built(text);
  finish_model(built_model);
  const Model& model = built_model.model;
  int bar = -1;
  const RigidBody& body = body_named(model, "bar", bar);
  State state = initial_state(model);
  state.bodies[bar].V_WB = {Vec3(2, -3, 4).cross(body.origin), {2, -3, 4}};
  state.bodies[bar].angular_momentum = angular_momentum(body, state.bodies[bar].X_WB, {2, -3, 4});
  const auto momenta = [&] {
    Vec6 sum = Vec6::Zero();
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const Vec3 p = model.bodies[b].inertia.mass * state.bodies[b].V_WB.v;
      sum.head<3>() += p;
      sum.tail<3>() += state.bodies[b].angular_momentum + state.bodies[b].X_WB.p.cross(p);
    }
    return sum;
  };
  const Vec6 start = momenta();
  Scratch scratch(model, 1);
  double gap = 0;
  while (state.time < 0.5) {
    advance_step(model, state, scratch, 1e-5);
    gap = std::max(gap, scratch.contact_reports[0].max_penetration);
  }
  EXPECT_LT((momenta() - start).head<3>().norm(), 1e-11 * start.head<3>().norm());
  EXPECT_LT((momenta() - start).tail<3>().norm(), 1e-10 * start.tail<3>().norm());
  EXPECT_LT(gap, 1e-4);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

/// Bar of eight bricks along x, fixed at x = 0, pulled at the corner node of the far end.
std::string pulled_bar() {
  std::string text =
      "*SECTION_SOLID\n1,2\n*PART\nbar\n1,1,1\n*MAT_ELASTIC\n1,1000,1e7,0.3\n*NODE\n";
  for (int i = 0; i <= 8; ++i)
    for (int k = 0; k < 4; ++k)
      text += node_card(4 * i + k + 1, {0.1 * i, k == 1 || k == 2 ? 0.1 : 0.0, k >= 2 ? 0.1 : 0.0});
  text += "*ELEMENT_SOLID\n";
  for (int i = 0; i < 8; ++i) {
    text += fmt::format("{},1", i + 1);
    for (int end : {0, 4})
      for (int k = 1; k <= 4; ++k) text += fmt::format(",{}", 4 * i + end + k);
    text += '\n';
  }
  text +=
      "*SET_NODE_LIST\n1\n1,2,3,4\n*BOUNDARY_SPC_SET\n1,0,1,1,1,1,1,1\n"
      "*LOAD_NODE_POINT\n35,1,1,20\n*DEFINE_CURVE\n1\n0,0\n0.2,1\n1,1\n"
      "*DAMPING_GLOBAL\n0,30\n*SET_NODE_LIST\n2\n17,18,19,20\n*SET_SOLID\n3\n4\n"
      "*DATABASE_CROSS_SECTION_SET_ID\n5,cut in the middle\n2,3\n"
      "*DATABASE_HISTORY_NODE\n35\n*DATABASE_HISTORY_SOLID\n4\n*DATABASE_SECFORC\n1e-2\n";
  return text;
}

// The section between elements 4 and 5: element 4 pulls its nodes back with the applied force, and
// turns them with its moment about the section's centre.
TEST(FeDeck, SectionCarriesTheForceAndTheMomentOfTheLoad) {
  BuiltModel built_model = built(pulled_bar());
  finish_model(built_model);
  const Model& model = built_model.model;
  ASSERT_EQ(built_model.histories.sections.size(), 1U);
  EXPECT_EQ(built_model.histories.nodes.size(), 1U);
  EXPECT_EQ(built_model.histories.elements.size(), 1U);
  EXPECT_DOUBLE_EQ(built_model.histories.interval, 1e-2);
  State state = initial_state(model);
  Scratch scratch(model, 1);
  const HistoryWriter writer(model, built_model.histories,
                             std::filesystem::path(testing::TempDir()) / "section_test", scratch);
  run_until(model, state, 1.2, 0.9, [] {});
  compute_forces(model, state, scratch);
  const Wrench section = writer.section_force(state, scratch, 0);
  EXPECT_NEAR(section.f.x(), -20, 0.02 * 20);
  EXPECT_NEAR(section.f.y(), 0, 0.02 * 20);
  // the load's moment about the section's centre, with the arm that bending has left
  Vec3 arm = Vec3::Zero();
  for (int n : built_model.histories.nodes) arm += state.nodes[n].position();
  for (int n : built_model.histories.sections[0].nodes) arm -= 0.25 * state.nodes[n].position();
  const Vec3 moment = -arm.cross(Vec3(20, 0, 0));
  EXPECT_NEAR(section.tau.y(), moment.y(), 0.02 * moment.norm());
  EXPECT_NEAR(section.tau.z(), moment.z(), 0.02 * moment.norm());
}

// A pressure on the far end follows it and is carried through the section: p A.
TEST(FeDeck, PressureOnSegmentsIsCarriedThroughTheSection) {
  std::string text = pulled_bar();
  const std::string load = "*LOAD_NODE_POINT\n35,1,1,20\n";
  text.replace(text.find(load), load.size(), "*LOAD_SEGMENT\n1,3000,,33,34,35,36\n");
  BuiltModel built_model = built(text);
  finish_model(built_model);
  const Model& model = built_model.model;
  State state = initial_state(model);
  Scratch scratch(model, 1);
  const HistoryWriter writer(model, built_model.histories,
                             std::filesystem::path(testing::TempDir()) / "pressure_test", scratch);
  run_until(model, state, 0.6, 0.9, [] {});
  compute_forces(model, state, scratch);
  EXPECT_NEAR(writer.section_force(state, scratch, 0).f.x(), 3000 * 0.01, 0.01 * 30);
  // work done on the bar: p A times half the shortening of its end, and what damping took
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

// Belytschko-Schwer beam of a deck: tip deflection F L^3 / (3 E I) + F L / (G A_s).
TEST(FeDeck, BeamDeflectsAsTimoshenkos) {
  std::string text =
      "*SECTION_BEAM\n1,2\n2e-4,6.6667e-9,1.6667e-9,4.58e-9,1.6667e-4\n*PART\nbeam\n1,1,1\n"
      "*MAT_ELASTIC\n1,7850,210e9,0.3\n*NODE\n";
  for (int i = 0; i <= 10; ++i) text += node_card(i + 1, {0.05 * i, 0, 0});
  text += node_card(20, {0, 1, 0}) + "*ELEMENT_BEAM\n";
  for (int i = 1; i <= 10; ++i) text += fmt::format("{},1,{},{},20\n", i, i, i + 1);
  text +=
      "*BOUNDARY_SPC_NODE\n1,0,1,1,1,1,1,1\n*LOAD_NODE_POINT\n11,3,1,10\n*LOAD_NODE_POINT\n"
      "11,2,1,10\n*DEFINE_CURVE\n1\n0,0\n0.02,1\n1,1\n*DAMPING_GLOBAL\n0,420\n";
  BuiltModel built_model = built(text);
  finish_model(built_model);
  const Model& model = built_model.model;
  State state = initial_state(model);
  run_until(model, state, 0.08, 0.9, [] {});
  int tip = -1;
  for (int n = 0; n < model.mesh.node_count(); ++n)
    if (model.mesh.node_id[n] == DeckId(11)) tip = n;
  const double shear = 10 * 0.5 / (210e9 / 2.6 * 1.6667e-4);
  const double z = 10 * 0.125 / (3 * 210e9 * 6.6667e-9) + shear;  // bends about s, which is y
  const double y = 10 * 0.125 / (3 * 210e9 * 1.6667e-9) + shear;
  EXPECT_NEAR(state.nodes[tip].x[2], z, 0.01 * z);
  EXPECT_NEAR(state.nodes[tip].x[1], y, 0.01 * y);
}

TEST(FeDeck, SolidFormulationsChooseTheirElement) {
  std::string text =
      "*SECTION_SOLID\n1,13\n*PART\ntet\n1,1,1\n*MAT_ELASTIC\n1,1000,1e7,0.3\n*NODE\n";
  const Vec3 x[10] = {{0, 0, 0},     {1, 0, 0},   {0, 1, 0},   {0, 0, 1},     {0.5, 0, 0},
                      {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  for (int k = 0; k < 10; ++k) text += node_card(k + 1, x[k]);
  BuiltModel tet = built(text + "*ELEMENT_SOLID\n1,1,1,2,3,4,4,4,4,4\n");
  ASSERT_EQ(tet.model.blocks.size(), 1U);
  EXPECT_EQ(tet.model.blocks[0]->kind(), ElementKind::Tet4);
  EXPECT_TRUE(tet.model.blocks[0]->has_neighbours());
  const std::string ten = build_problems(text + "*ELEMENT_SOLID\n7,1\n1,2,3,4,5,6,7,8,9,10\n");
  EXPECT_NE(ten.find("*ELEMENT_SOLID 7"), std::string::npos) << ten;
  EXPECT_NE(ten.find("tet"), std::string::npos) << ten;
}

}  // namespace
}  // namespace crosswalk::fe
