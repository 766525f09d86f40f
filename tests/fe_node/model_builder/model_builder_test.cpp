// From deck to model: units, elements, bodies, sets and conditions, each against hand computation.
#include <cmath>

#include <fmt/format.h>

#include "fe_node/solver.h"
#include "tests/fe_node/model_builder/built_deck.h"

namespace crosswalk::fe {
namespace {

constexpr double kCubeMass = 7.8e-3;  // kg: 7800 kg/m3 in 1 cm3

TEST(ModelBuilder, ConvertsUnitsOnce) {
  const Model model = std::move(model_of(kCube).model);
  EXPECT_NEAR(model.total_mass(), kCubeMass, 1e-15);
  EXPECT_NEAR(model.mesh.position[node_of(model, 7)].norm(), 0.01 * std::sqrt(3.0), 1e-15);
  // dt = L / c with c^2 = (K + 4/3 G) / rho of steel
  const double E = 210e9, nu = 0.3, rho = 7800;
  const double c = std::sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / rho);
  // the estimate stays below the time a wave takes from face to face, by a known order
  EXPECT_LE(initial_stable_step(model), 0.01 / c);
  EXPECT_GE(initial_stable_step(model), 0.01 / c / std::sqrt(3.0));
}

TEST(ModelBuilder, TheSameModelFromAnotherUnitSystem) {
  BuildOptions si;
  si.units = UnitSystem::MKgS;
  const Model first = std::move(model_of(kCube).model);
  const Model second = std::move(model_of("*NODE\n1,0,0,0\n2,.01,0,0\n3,.01,.01,0\n4,0,.01,0\n"
                                          "5,0,0,.01\n6,.01,0,.01\n7,.01,.01,.01\n8,0,.01,.01\n"
                                          "*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n"
                                          "*MAT_ELASTIC\n1,7800.,2.1e11,0.3\n" +
                                              kCubeElement,
                                          si)
                                     .model);
  EXPECT_NEAR(second.total_mass() / first.total_mass(), 1, 1e-12);
  EXPECT_NEAR(initial_stable_step(second) / initial_stable_step(first), 1, 1e-9);
}

TEST(ModelBuilder, ClearUnitsAreGuessedAloudOthersAreAskedFor) {
  const BuiltModel guessed = build_model(sound(kCube), {});
  ASSERT_EQ(guessed.notes.size(), 1U);
  EXPECT_THAT(guessed.notes[0], testing::HasSubstr("units guessed as mm-kg-ms"));
  EXPECT_NEAR(guessed.model.mesh.position[node_of(guessed.model, 2)].x(), 0.01, 1e-15);
  EXPECT_THROW(build_model(sound(kCubeNodes +
                                 "*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n"
                                 "*MAT_ELASTIC\n1,1.0,1e9,0.3\n" +
                                 kCubeElement),
                           {}),
               UserError);
}

TEST(ModelBuilder, ShortCardsOfSolidsMakeTheirShapes) {
  const auto mass = [](const std::string& element) {
    return model_of(kCubeNodes + kCubePart + "*ELEMENT_SOLID\n1,1," + element + "\n")
        .model.total_mass();
  };
  EXPECT_NEAR(mass("1,2,3,4,5,6,7,8"), kCubeMass, 1e-12);
  // the corner tetrahedron is a sixth, the wedge a half, the pyramid a third of the cube
  EXPECT_NEAR(mass("1,2,4,5"), kCubeMass / 6, 1e-12);
  EXPECT_NEAR(mass("1,2,4,5,5,5,5,5"), kCubeMass / 6, 1e-12);
  EXPECT_NEAR(mass("2,1,5,6,4,8"), kCubeMass / 2, 1e-12);
  EXPECT_NEAR(mass("2,1,5,6,4,4,8,8"), kCubeMass / 2, 1e-12);
  EXPECT_NEAR(mass("1,2,3,4,5,5,5,5"), kCubeMass / 3, 1e-12);
}

TEST(ModelBuilder, ShellsTakeTheirOwnThicknessBeforeTheSections) {
  const std::string plate =
      kCubeNodes +
      "*PART\nplate\n1,1,1\n*SECTION_SHELL\n1,2\n2.0\n*MAT_ELASTIC\n1,7.8e-6,210.0,0.3\n";
  const BuiltModel by_section = model_of(plate + "*ELEMENT_SHELL\n1,1,1,2,3,4\n");
  EXPECT_NEAR(by_section.model.total_mass(), 7800 * 1e-4 * 2e-3, 1e-12);
  EXPECT_TRUE(by_section.model.has_rotations());
  const BuiltModel own =
      model_of(plate + "*ELEMENT_SHELL_THICKNESS\n1,1,1,2,3,4\n3.0,3.0,3.0,3.0\n");
  EXPECT_NEAR(own.model.total_mass(), 7800 * 1e-4 * 3e-3, 1e-12);
}

TEST(ModelBuilder, ARigidPartHasTheInertiaOfItsElementsOrTheGivenOne) {
  const std::string rigid =
      kCubeNodes + "*SECTION_SOLID\n1,1\n*MAT_RIGID\n1,7.8e-6,210.0,0.3\n0\n0\n" + kCubeElement;
  const BuiltModel lumped = model_of(rigid + "*PART\nblock\n1,1,1\n");
  ASSERT_EQ(lumped.model.bodies.size(), 1U);
  const RigidBody& body = lumped.model.bodies[0];
  EXPECT_EQ(body.name, "block");
  EXPECT_NEAR(body.inertia.mass, kCubeMass, 1e-12);
  EXPECT_LT((body.origin - Vec3::Constant(0.005)).norm(), 1e-12);
  // eight point masses at half an edge: m (2 (a/2)^2)
  EXPECT_NEAR(body.inertia.about_com(0, 0), kCubeMass * 2 * 0.005 * 0.005, 1e-15);
  EXPECT_EQ(body.nodes.size(), 8U);

  const BuiltModel given = model_of(
      rigid + "*PART_INERTIA\nblock\n1,1,1\n1.0,2.0,3.0,4.0\n500.,0,0,600.,0,700.\n0,0,0\n");
  EXPECT_NEAR(given.model.bodies[0].inertia.mass, 4, 1e-12);
  EXPECT_LT((given.model.bodies[0].origin - Vec3(1e-3, 2e-3, 3e-3)).norm(), 1e-12);
  EXPECT_NEAR(given.model.bodies[0].inertia.about_com(1, 1), 600e-6, 1e-12);  // kg mm2 to kg m2
}

TEST(ModelBuilder, ARigidBodyOfOneNodeFallsLikeTheRest) {
  const BuiltModel built =
      model_of(kCube + "*SET_NODE_LIST\n1\n7\n*CONSTRAINED_NODAL_RIGID_BODY\n9,,1\n" +
               "*LOAD_BODY_Z\n1\n*DEFINE_CURVE\n1\n0,9.81e-3\n1,9.81e-3\n");
  State state = initial_state(built.model);
  Scratch scratch(built.model, 1);
  for (int i = 0; i < 20; ++i) advance_step(built.model, state, scratch, 1e-7);
  const double speed = -9.81 * 20 * 1e-7;
  EXPECT_NEAR(state.bodies[0].V_WB.v.z(), speed, 0.05 * std::abs(speed));  // half a step at start
  for (const NodeRecord& node : state.nodes) EXPECT_TRUE(node.position().allFinite());
}

TEST(ModelBuilder, MergedBodiesAndExtraNodesMoveAsOne) {
  const std::string two =
      kCubeNodes +
      "*NODE\n9,20,0,0\n10,20,10,0\n11,20,0,10\n12,20,10,10\n13,50,0,0\n"
      "*SECTION_SOLID\n1,1\n*MAT_RIGID\n1,7.8e-6,210.0,0.3\n0\n0\n*PART\nlead\n1,1,1\n"
      "*PART\nother\n2,1,1\n" +
      kCubeElement + "2,2,2,9,10,3,6,11,12,7\n";
  const BuiltModel merged =
      model_of(two + "*CONSTRAINED_RIGID_BODIES\n1,2\n*CONSTRAINED_EXTRA_NODES_NODE\n1,13\n");
  ASSERT_EQ(merged.model.bodies.size(), 1U);
  EXPECT_EQ(merged.model.bodies[0].nodes.size(), 13U);
  EXPECT_NEAR(merged.model.bodies[0].inertia.mass, 2 * kCubeMass, 1e-12);
  EXPECT_THROW(build(two), UserError);  // they share nodes: one of the two must own them
}

TEST(ModelBuilder, SetsOfEveryKindNameTheirNodes) {
  const BuiltModel built = build(
      kCube +
      "*SET_NODE_LIST_TITLE\nlisted\n1\n1,3,5\n*SET_NODE_LIST_GENERATE_TITLE\nrange\n2\n"
      "4,2000000000\n*SET_NODE_ADD_TITLE\nsum\n3\n1,2,1\n*SET_NODE_GENERAL_TITLE\nwhole\n4\n"
      "ALL\n*SET_NODE_GENERAL_TITLE\nof part\n5\nPART,1\n*SET_PART_LIST_TITLE\nparts\n1\n1\n");
  const auto ids = [&](const char* name) {
    std::vector<int> out;
    const Mesh& mesh = built.model.mesh;
    const int group = mesh.find_node_set(name);
    if (group >= 0)
      for (int n : mesh.node_sets[group].nodes) out.push_back(mesh.node_id[n].value);
    std::sort(out.begin(), out.end());
    return out;
  };
  EXPECT_EQ(ids("listed"), (std::vector<int>{1, 3, 5}));
  EXPECT_EQ(ids("range"), (std::vector<int>{4, 5, 6, 7, 8}));
  EXPECT_EQ(ids("sum"), (std::vector<int>{1, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(ids("whole").size(), 8U);
  EXPECT_EQ(ids("of part").size(), 8U);
  EXPECT_EQ(built.part_set("parts"), 0);
  EXPECT_EQ(built.part_set("none"), -1);
}

TEST(ModelBuilder, FixedNodesByCodeAndByCardAreMerged) {
  const BuiltModel built = build(
      "*NODE\n1,0,0,0,3,7\n2,10,0,0\n3,10,10,0\n4,0,10,0\n5,0,0,10\n6,10,0,10\n7,10,10,10\n"
      "8,0,10,10\n" +
      kCubePart + kCubeElement + "*BOUNDARY_SPC_NODE\n1,0,1\n2,0,0,1,0,1\n");
  ASSERT_EQ(built.model.fixed.size(), 2U);
  const auto fixed = [&](int id) {
    for (const FixedNode& f : built.model.fixed)
      if (f.node == node_of(built.model, id)) return f;
    return FixedNode{};
  };
  // code 3 fixes z, the card x; rotations by code 7
  EXPECT_EQ(fixed(1).translation, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(fixed(1).rotation, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(fixed(2).translation, (std::array<bool, 3>{false, true, false}));
  EXPECT_EQ(fixed(2).rotation, (std::array<bool, 3>{true, false, false}));
}

TEST(ModelBuilder, PrescribedMotionsLoadsAndVelocitiesInSi) {
  const BuiltModel built = build(
      kCube +
      "*DEFINE_CURVE\n5,0,2.0,3.0\n0,0\n1,10\n"
      "*BOUNDARY_PRESCRIBED_MOTION_NODE\n7,2,2,5,0.5\n*LOAD_NODE_POINT\n6,3,5,4.0\n"
      "*INITIAL_VELOCITY_NODE\n8,1.0,2.0,3.0\n*DAMPING_GLOBAL\n0,0.2\n*ELEMENT_MASS\n1,3,0.5\n"
      "*CONTROL_TERMINATION\n25.0\n*DATABASE_BINARY_D3PLOT\n0.5\n");
  ASSERT_EQ(built.model.guided.size(), 1U);
  const GuidedNodes& guide = built.model.guided[0];
  EXPECT_EQ(guide.kind, MotionKind::Displacement);
  EXPECT_EQ(guide.direction, Vec3::UnitY());
  EXPECT_EQ(guide.scale, 0.5);
  EXPECT_NEAR(guide.curve.value(2e-3), 30e-3, 1e-12);  // abscissa x 2 ms, ordinate x 3 mm
  ASSERT_EQ(built.model.nodal_forces.size(), 1U);
  EXPECT_NEAR(built.model.nodal_forces[0].curve.value(2e-3), 30e3, 1e-6);  // kN
  ASSERT_EQ(built.model.start_velocities.size(), 1U);
  EXPECT_EQ(built.model.start_velocities[0].velocity, Vec3(1, 2, 3));  // mm/ms = m/s
  EXPECT_NEAR(built.model.settings.mass_damping, 200, 1e-9);
  EXPECT_NEAR(built.model.point_mass[node_of(built.model, 3)], 0.5, 1e-12);
  EXPECT_NEAR(built.end_time, 0.025, 1e-15);
  EXPECT_NEAR(built.field_interval, 0.5e-3, 1e-15);
}

// A lopsided body turned about three axes at once: one whose inertia alone carried it would wobble.
TEST(ModelBuilder, ARigidPartWithSixPrescribedVelocitiesMovesByThemAlone) {
  std::string text =
      kCubeNodes + "*SECTION_SOLID\n1,1\n*MAT_RIGID\n1,7.8e-6,210.0,0.3\n0\n0\n" + kCubeElement +
      "*PART_INERTIA\nblock\n1,1,1\n1.0,2.0,3.0,4.0\n500.,80,-60,600.,70,900.\n0,0,"
      "0\n*ELEMENT_DISCRETE\n9,2,1,7\n*PART\nspring\n2,2,2\n*SECTION_DISCRETE\n2,1\n0,0\n"
      "*MAT_SPRING_ELASTIC\n2,1.0\n*DEFINE_CURVE\n5\n0,1\n100,1\n"
      "*DEFINE_CURVE\n6\n0,0.002\n1,0.001\n3,0.004\n"
      "*CONTROL_TIMESTEP\n0,0.9,0,0,0,6\n";
  const double rate[6] = {1, -2, 3, 0.4, -0.3, 0.2};  // m/s, rad/ms
  for (int d = 0; d < 6; ++d)
    text += fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,{},0,5,{}\n", d < 3 ? d + 1 : d + 2,
                        rate[d]);
  const BuiltModel built = model_of(text);
  ASSERT_EQ(built.model.bodies.size(), 1U);
  EXPECT_EQ(built.model.bodies[0].role, BodyRole::Prescribed);
  State state = initial_state(built.model);
  Scratch scratch(built.model, 1);
  const BodyState start = state.bodies[0];
  while (state.time < 2e-3) {
    const StepReport report = compute_forces(built.model, state, scratch);
    const double dt = next_step(built.model, state, report);
    // LCTM: 2 us at the start, 1 us after a millisecond
    EXPECT_NEAR(dt,
                1e-6 * (state.time < 1e-3 ? 2 - 1e3 * state.time : 1.5 * 1e3 * state.time - 0.5),
                1e-12);
    move(built.model, state, scratch, dt);
  }
  const Vec3 v(rate[0], rate[1], rate[2]), w = 1e3 * Vec3(rate[3], rate[4], rate[5]);
  const BodyState& body = state.bodies[0];
  EXPECT_LT((body.V_WB.w - w).norm(), 1e-9);
  EXPECT_LT((body.X_WB.p - start.X_WB.p - state.time * v).norm(), 1e-12);
  EXPECT_LT(log_rotation(body.X_WB.q * exp_rotation(state.time * w).conjugate()).norm(), 1e-9);
}

TEST(ModelBuilder, SpringsAndTrussesBecomeLines) {
  const BuiltModel built =
      model_of(kCube +
               "*PART\nspring\n2,2,2\n*SECTION_DISCRETE\n2\n0\n*MAT_SPRING_ELASTIC\n2,0.5\n"
               "*ELEMENT_DISCRETE\n10,2,1,7\n"
               "*PART\ntruss\n3,3,3\n*SECTION_BEAM\n3,3\n4.0\n*MAT_ELASTIC\n3,1e-6,2.0,0.3\n"
               "*ELEMENT_BEAM\n12,3,2,8\n");
  EXPECT_EQ(built.model.mesh.table(ElementKind::Line2).size(), 2);
  EXPECT_EQ(built.model.blocks.size(), 3U);
  // 1000 kg/m3 x 4 mm2 x 10 sqrt(3) mm; the spring weighs nothing
  EXPECT_NEAR(built.model.total_mass() - kCubeMass, 1e3 * 4e-6 * 0.01 * std::sqrt(3.0), 1e-12);
}

TEST(ModelBuilder, MassScalingReachesTheStepThatIsAskedFor) {
  BuildOptions options;
  options.mass_scaling_step = 2e-6 / 0.9;
  const BuiltModel scaled = model_of(kCube + "*CONTROL_TIMESTEP\n0,0.9\n", options);
  EXPECT_NEAR(0.9 * initial_stable_step(scaled.model), 2e-6, 1e-9);
  EXPECT_GT(scaled.model.added_mass[0], 0);
  EXPECT_NEAR(scaled.model.total_mass(), kCubeMass + scaled.model.added_mass[0], 1e-12);
  const BuiltModel by_deck = model_of(kCube + "*CONTROL_TIMESTEP\n0,0.9,0,0,-2e-3\n");
  EXPECT_NEAR(by_deck.model.added_mass[0], scaled.model.added_mass[0], 1e-9);
}

TEST(ModelBuilder, WallsAndContactsAreBuilt) {
  const BuiltModel built =
      model_of(kCube +
               "*RIGIDWALL_PLANAR\n0,0,0\n0,0,-1,0,0,1,0.3\n*CONTACT_AUTOMATIC_SINGLE_SURFACE\n"
               "0,0,5\n0.1,0.1\n0\n");
  EXPECT_EQ(built.model.contacts.size(), 2U);
  ASSERT_EQ(built.model.bodies.size(), 1U);
  EXPECT_EQ(built.model.bodies[0].role, BodyRole::Follower);
}

}  // namespace
}  // namespace crosswalk::fe
