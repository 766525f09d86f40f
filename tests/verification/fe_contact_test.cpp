// Contact between meshed bodies against closed forms.
#include <numbers>

#include <gtest/gtest.h>

#include "fe_node/contact/penalty.h"
#include "fe_node/generate/primitives.h"
#include "tests/fe_node/box_model.h"
#include "tests/fe_node/plate_model.h"
#include "tests/fe_node/run_until.h"

namespace crosswalk::fe {
namespace {

/// Adds the nodes and elements of `other`; returns the number its part 0 got.
int append(Mesh& mesh, const Mesh& other) {
  const int first_node = mesh.node_count(), part = static_cast<int>(mesh.parts.size());
  mesh.position.insert(mesh.position.end(), other.position.begin(), other.position.end());
  for (int n = 0; n < other.node_count(); ++n) mesh.node_id.push_back(DeckId{first_node + n + 1});
  for (ElementKind kind : kElementKinds) {
    const ElementTable& from = other.table(kind);
    ElementTable& to = mesh.table(kind);
    for (int n : from.nodes) to.nodes.push_back(first_node + n);
    for (int e = 0; e < from.size(); ++e) {
      to.part.push_back(part);
      to.id.push_back(DeckId{to.size() + 1});
    }
  }
  mesh.parts.push_back({DeckId{part + 1}, "part", false});
  return part;
}

std::vector<int> elements_of(const Mesh& mesh, ElementKind kind, int part) {
  std::vector<int> list;
  for (int e = 0; e < mesh.table(kind).size(); ++e)
    if (mesh.table(kind).part[e] == part) list.push_back(e);
  return list;
}

Mesh ball_mesh(int n, double radius, const Vec3& centre) {
  generate::MeshDraft draft;
  const generate::CubedSphere sphere(n);
  generate::add_ball(
      draft, sphere, [&](const Vec3& p) -> Vec3 { return centre + radius * p; },
      [](const generate::BallCell&) { return 0; });
  Mesh mesh;
  mesh.position = draft.nodes;
  mesh.node_id.resize(draft.nodes.size());
  ElementTable& hexes = mesh.table(ElementKind::Hex8);
  for (const auto& hex : draft.hexes) {
    hexes.nodes.insert(hexes.nodes.end(), hex.node.begin(), hex.node.end());
    hexes.part.push_back(0);
    hexes.id.push_back(DeckId{hexes.size()});
  }
  return mesh;
}

/// A sphere's surface as quadrilaterals.
Mesh sphere_mesh(int n, double radius, const Vec3& centre) {
  const generate::CubedSphere sphere(n);
  Mesh mesh;
  for (int i = 0; i < sphere.surface_size(); ++i) {
    mesh.position.push_back(centre + radius * sphere.direction(i));
    mesh.node_id.push_back(DeckId{i + 1});
  }
  ElementTable& quads = mesh.table(ElementKind::Quad4);
  for (const auto& quad : sphere.quads()) {
    quads.nodes.insert(quads.nodes.end(), quad.begin(), quad.end());
    quads.part.push_back(0);
    quads.id.push_back(DeckId{quads.size()});
  }
  return mesh;
}

void fix(Model& model, std::span<const int> nodes) {
  for (int n : nodes) model.fixed.push_back({n, {true, true, true}, {true, true, true}});
}

ContactSurface surface(const Mesh& mesh, int part, double bulk, double thickness) {
  const ContactPart contact{part, bulk, thickness, {}};
  return surface_of(mesh, {&contact, 1});
}

Vec6 momenta(const Model& model, const State& state) {
  Vec6 sum = Vec6::Zero();
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const Vec3 p = model.mass[n] * state.nodes[n].velocity();
    sum.head<3>() += p;
    sum.tail<3>() += state.nodes[n].position().cross(p);
  }
  return sum;
}

// A block at 1 m/s on a rough floor stops after v^2 / (2 mu g). The block is soft and bounces a
// little, which changes nothing on average: impulse of friction = mu x impulse of support.
TEST(FeContact, SlidingBlockStopsWhereCoulombSays) {
  constexpr double kMu = 0.3, kSpeed = 1.0, kThickness = 0.002;
  Model model;
  model.mesh = plate_mesh({12, 4, 0.6, 0.2});
  Mesh block = box_mesh({4, 4, 2, {0.1, 0.1, 0.05}});
  for (Vec3& p : block.position) p += Vec3(0.05, 0.05, 0.5 * kThickness);
  const int floor_nodes = model.mesh.node_count();
  const int part = append(model.mesh, block);
  model.blocks.push_back(make_hex8_block(model.mesh, part,
                                         elements_of(model.mesh, ElementKind::Hex8, part),
                                         Elastic::from_young(1000, 1e7, 0.3), {}));
  std::vector<int> floor(floor_nodes), moving;
  for (int n = 0; n < floor_nodes; ++n) floor[n] = n;
  for (int n = floor_nodes; n < model.mesh.node_count(); ++n) moving.push_back(n);
  fix(model, floor);
  model.start_velocities.push_back({moving, {kSpeed, 0, 0}});
  model.settings.gravity = {0, 0, -9.81};
  PenaltySettings settings;
  settings.static_friction = settings.dynamic_friction = kMu;
  settings.damping_ratio = 0.2;
  settings.nominal_step = 0.9 * initial_stable_step(model);
  model.contacts.push_back(make_node_contact("floor", surface(model.mesh, part, 1e7, 0),
                                             surface(model.mesh, 0, 1e7, kThickness), settings));
  model.finish();
  State state = initial_state(model);
  run_until(model, state, 0.5, 0.9, [] {});
  double travelled = 0, speed = 0;
  for (int n : moving) {
    travelled +=
        (state.nodes[n].x[0] - model.mesh.position[n].x()) / static_cast<double>(moving.size());
    speed = std::max(speed, state.nodes[n].velocity().norm());
  }
  const double exact = kSpeed * kSpeed / (2 * kMu * 9.81);
  EXPECT_NEAR(travelled, exact, 0.02 * exact);
  EXPECT_LT(speed, 0.02);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
  // all of the kinetic energy went into friction, the little rest into damping
  const double kinetic = 0.5 * 0.5 * kSpeed * kSpeed;
  EXPECT_NEAR(state.energies.contact_dissipated, kinetic, 0.03 * kinetic);
}

// Hertz' impact of an elastic sphere on a rigid flat [johnson1985, 11.4]: largest approach
// delta = (15 m v^2 / (16 sqrt(R) E*))^(2/5), force 4/3 E* sqrt(R) delta^(3/2), duration 2.87
// (m^2 / (R E*^2 v))^(1/5). The contact radius is two and a half surface elements: 8 %.
TEST(FeContact, HertzImpactForceAndTime) {
  constexpr double kE = 1e9, kNu = 0.3, kDensity = 1000, kR = 0.05, kSpeed = 8;
  constexpr double kThickness = 0.002;
  Model model;
  model.mesh =
      plate_mesh({2, 2, 0.1, 0.1}, [](const Vec3& p) { return Vec3(p - Vec3(0.05, 0.05, 0)); });
  const int floor_nodes = model.mesh.node_count();
  const int part = append(model.mesh, ball_mesh(18, kR, {0, 0, kR + 0.5 * kThickness + 1e-6}));
  ElementControls controls;
  controls.quadratic_bulk = controls.linear_bulk = 0;
  model.blocks.push_back(make_hex8_block(model.mesh, part,
                                         elements_of(model.mesh, ElementKind::Hex8, part),
                                         Elastic::from_young(kDensity, kE, kNu), controls));
  std::vector<int> floor(floor_nodes), moving;
  for (int n = 0; n < floor_nodes; ++n) floor[n] = n;
  for (int n = floor_nodes; n < model.mesh.node_count(); ++n) moving.push_back(n);
  fix(model, floor);
  model.start_velocities.push_back({moving, {0, 0, -kSpeed}});
  PenaltySettings settings;
  settings.stiffness_scale = 10;  // as stiff as the step allows
  settings.nominal_step = 0.9 * initial_stable_step(model);
  model.contacts.push_back(make_node_contact("floor", surface(model.mesh, part, kE, 0),
                                             surface(model.mesh, 0, kE, kThickness), settings));
  model.finish();
  State state = initial_state(model);
  const double mass = model.total_mass(), effective = kE / (1 - kNu * kNu);
  const double delta =
      std::pow(15 * mass * kSpeed * kSpeed / (16 * std::sqrt(kR) * effective), 0.4);
  const double peak = 4.0 / 3 * effective * std::sqrt(kR) * std::pow(delta, 1.5);
  const double duration = 2.87 * std::pow(mass * mass / (kR * effective * effective * kSpeed), 0.2);

  Scratch scratch(model, 1);
  const double dt = 0.9 * initial_stable_step(model);
  double largest = 0, touched = 0, left = 0;
  std::vector<double> force;
  while (state.time < 1.4 * duration) {
    advance_step(model, state, scratch, dt);
    force.push_back(scratch.contact_reports[0].force.z());
    if (force.back() > 0 && touched == 0) touched = state.time;
    if (force.back() > 0) left = state.time;
  }
  // the peak of the force averaged over the time sound needs to cross the sphere
  const int window = static_cast<int>(kR / std::sqrt(kE / kDensity) / dt);
  for (std::size_t i = window; i < force.size(); ++i) {
    double sum = 0;
    for (int k = 0; k < window; ++k) sum += force[i - k] / window;
    largest = std::max(largest, sum);
  }
  EXPECT_NEAR(largest, peak, 0.08 * peak);
  EXPECT_NEAR(left - touched, duration, 0.08 * duration);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

// A rigid mass meets a large plate: F = Z v with Z = 8 sqrt(D rho h), so v = v0 exp(-t Z / m) until
// waves return from the edge [cremer2005, 4.3]. Glass 5 mm: Z = 784.8 N s/m.
TEST(FeContact, MassOnAPlateFeelsTheImpedanceOfThePlate) {
  constexpr double kMass = 4.5, kSpeed = 0.5, kR = 0.0825, kT = 0.005, kEnd = 1.0e-3;
  const ShellElastic glass{2500, 70e9, 0.23};
  const double Z = 8 * std::sqrt(769.9 * 12.5);
  Model model;
  model.mesh = plate_mesh({48, 48}, [](const Vec3& p) { return Vec3(p - Vec3(0.5, 0.5, 0)); });
  const int plate_nodes = model.mesh.node_count();
  const int ball = append(model.mesh, sphere_mesh(16, kR, {0, 0, kR + 0.5 * kT + 1e-6}));
  model.mesh.parts[ball].is_rigid = true;
  model.blocks.push_back(make_shell_block(model.mesh, ElementKind::Quad4, 0,
                                          elements_of(model.mesh, ElementKind::Quad4, 0),
                                          uniform_section(glass, kT, 2), {}));
  RigidBody body;
  body.name = "impactor";
  body.parts = {ball};
  for (int n = plate_nodes; n < model.mesh.node_count(); ++n) body.nodes.push_back(n);
  body.own = {kMass, {0, 0, kR + 0.5 * kT + 1e-6}, 0.4 * kMass * kR * kR * Mat3::Identity()};
  model.start_velocities.push_back({body.nodes, {0, 0, -kSpeed}});
  model.bodies.push_back(body);
  PenaltySettings settings;
  settings.stiffness_scale = 1;
  settings.nominal_step = 0.9 * initial_stable_step(model);
  settings.damping_ratio = 0.1;
  model.contacts.push_back(make_surface_contact("c", surface(model.mesh, ball, 70e9, 0),
                                                surface(model.mesh, 0, 43e9, kT), settings));
  model.finish();
  State state = initial_state(model);
  state.bodies[0].V_WB.v = {0, 0, -kSpeed};
  run_until(model, state, kEnd, 0.9, [] {});
  const double lost = 1 - state.bodies[0].V_WB.v.z() / -kSpeed,
               exact = 1 - std::exp(-kEnd * Z / kMass);
  EXPECT_NEAR(lost, exact, 0.05 * exact);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

// Two blocks lie on each other and on the floor: each interface ends up with the weight above it.
TEST(FeContact, StackCarriesItsWeight) {
  constexpr double kThickness = 0.002;
  Model model;
  model.mesh = plate_mesh({4, 4, 0.2, 0.2});
  const int floor_nodes = model.mesh.node_count();
  int parts[2];
  for (int i = 0; i < 2; ++i) {
    const Box box{3 - i, 3 - i, 2, {0.1, 0.1, 0.05}};
    Mesh block = box_mesh(box);
    for (Vec3& p : block.position) p += Vec3(0.05, 0.052, 0.5 * kThickness + 0.05 * i);
    parts[i] = append(model.mesh, block);
    model.blocks.push_back(make_hex8_block(model.mesh, parts[i],
                                           elements_of(model.mesh, ElementKind::Hex8, parts[i]),
                                           Elastic::from_young(1000, 1e7, 0.3), {}));
  }
  std::vector<int> floor(floor_nodes);
  for (int n = 0; n < floor_nodes; ++n) floor[n] = n;
  fix(model, floor);
  model.settings.gravity = {0, 0, -9.81};
  model.settings.mass_damping = 30;
  PenaltySettings settings;
  settings.damping_ratio = 0.3;
  settings.static_friction = settings.dynamic_friction = 0.2;
  settings.nominal_step = 0.9 * initial_stable_step(model);
  model.contacts.push_back(make_surface_contact("floor", surface(model.mesh, parts[0], 1e7, 0),
                                                surface(model.mesh, 0, 1e7, kThickness), settings));
  model.contacts.push_back(make_surface_contact("blocks", surface(model.mesh, parts[1], 1e7, 0),
                                                surface(model.mesh, parts[0], 1e7, 0), settings));
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  const double dt = 0.9 * initial_stable_step(model);
  while (state.time < 0.6) advance_step(model, state, scratch, dt);
  EXPECT_NEAR(scratch.contact_reports[1].force.z(), 0.5 * 9.81, 0.01 * 0.5 * 9.81);
  EXPECT_NEAR(scratch.contact_reports[0].force.z(), 1.0 * 9.81, 0.01 * 9.81);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

// Two free bodies meet obliquely with friction and damping: momenta to round-off.
TEST(FeContact, ObliqueCollisionKeepsMomentaAndBooksEnergy) {
  Model model;
  model.mesh = ball_mesh(6, 0.05, {0, 0, 0});
  model.mesh.parts.push_back({DeckId{1}, "ball", false});
  const int first = model.mesh.node_count();
  const int other = append(model.mesh, ball_mesh(8, 0.05, {0.04, 0.03, 0.09}));
  for (int part : {0, other})
    model.blocks.push_back(make_hex8_block(model.mesh, part,
                                           elements_of(model.mesh, ElementKind::Hex8, part),
                                           Elastic::from_young(1000, 1e7, 0.4), {}));
  std::vector<int> moving;
  for (int n = first; n < model.mesh.node_count(); ++n) moving.push_back(n);
  model.start_velocities.push_back({moving, {-3, 1, -8}});
  PenaltySettings settings;
  settings.stiffness_scale = 1;  // a tenth of it would sink in by an element, with 7 % of error
  settings.static_friction = 0.5;
  settings.dynamic_friction = 0.3;
  settings.friction_decay = 1;
  settings.damping_ratio = 0.1;
  settings.nominal_step = 0.9 * initial_stable_step(model);
  model.contacts.push_back(make_surface_contact("c", surface(model.mesh, 0, 1e7, 0),
                                                surface(model.mesh, other, 1e7, 0), settings));
  model.finish();
  State state = initial_state(model);
  Vec6 start;
  int touching = 0;
  double worst = 0;
  Scratch scratch(model, 1);
  const double dt = 0.9 * initial_stable_step(model);
  while (state.time < 8e-3) {
    advance_step(model, state, scratch, dt);
    if (state.step == 1) start = momenta(model, state);
    touching += scratch.contact_reports[0].active > 0 ? 1 : 0;
    worst = std::max(worst, std::abs(state.energies.balance_error()));
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_GT(touching, 20);
  EXPECT_EQ(scratch.contact_reports[0].active, 0);  // apart again
  const Vec6 change = momenta(model, state) - start;
  EXPECT_LT(change.head<3>().norm(), 1e-12 * start.head<3>().norm());
  EXPECT_LT(change.tail<3>().norm(), 1e-12 * start.tail<3>().norm());
  EXPECT_GT(state.energies.contact_dissipated, 0);
}

}  // namespace
}  // namespace crosswalk::fe
