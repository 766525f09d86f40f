#include "fe_node/contact/penalty.h"

#include <gtest/gtest.h>

#include "tests/fe_node/plate_model.h"
#include "tests/fe_node/run_until.h"

namespace crosswalk::fe {
namespace {

/// A flat shell plate at z = 0 and free nodes above it, without any element law.
struct Scene {
  Plate plate{4, 4, 0.4, 0.4};
  Mesh mesh = plate_mesh(plate);
  std::vector<NodeRecord> nodes;
  std::vector<double> mass;
  ContactSurface surface;
  int first_free = 0;

  explicit Scene(const std::vector<Vec3>& points) {
    first_free = mesh.node_count();
    for (const Vec3& p : points) {
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
    surface = surface_of(mesh, {&part, 1});
  }
  ContactSurface points() const {
    std::vector<int> list;
    for (int n = first_free; n < mesh.node_count(); ++n) list.push_back(n);
    return ContactSurface::of_nodes(list);
  }
  ContactContext context(std::int64_t step = 0, int threads = 1) const {
    return {nodes, mass, {}, 1e-6 * static_cast<double>(step), 1e-6, step, threads};
  }
};

PenaltySettings plain() {
  PenaltySettings settings;
  settings.nominal_step = 1e-6;
  return settings;
}

Vec3 force_on(const ContactLoads& loads, int node) {
  Vec3 sum = Vec3::Zero();
  for (const NodalLoad& load : loads.nodal)
    if (load.node == node) sum += load.force;
  return sum;
}

TEST(PenaltyContact, PushesFromTheSideTheNodeIsOnAndOnlyWithinTheThickness) {
  Scene scene({{0.15, 0.15, 0.02}, {0.15, 0.25, -0.02}, {0.25, 0.15, 0.02}});
  const auto contact = make_node_contact("c", scene.points(), scene.surface, plain());
  ContactHistory history;
  contact->initialise(history, scene.context());
  scene.nodes[scene.first_free].x[2] = 0.008;
  scene.nodes[scene.first_free + 1].x[2] = -0.008;
  scene.nodes[scene.first_free + 2].x[2] = 0.011;
  ContactLoads loads;
  const ContactReport report = contact->forces(scene.context(1), history, loads);
  const double k = 0.1 * 1e6 * 0.1 * 0.1 / (0.1 * std::sqrt(2.0));
  EXPECT_EQ(report.active, 2);
  EXPECT_NEAR(report.max_penetration, 0.002, 1e-12);
  EXPECT_NEAR(force_on(loads, scene.first_free).z(), k * 0.002, 1e-9);
  EXPECT_NEAR(force_on(loads, scene.first_free + 1).z(), -k * 0.002, 1e-9);
  EXPECT_NEAR(report.stored, 2 * 0.5 * k * 4e-6, 1e-12);
}

TEST(PenaltyContact, ANodeThatCrossedTheShellIsPushedBackToItsSide) {
  Scene scene({{0.15, 0.15, 0.02}});
  const auto contact = make_node_contact("c", scene.points(), scene.surface, plain());
  ContactHistory history;
  contact->initialise(history, scene.context());
  ContactLoads loads;
  double last = 0;
  for (int step = 1; step < 40; ++step) {
    scene.nodes[scene.first_free].x[2] = 0.012 - 0.0005 * step;
    loads.nodal.clear();
    contact->forces(scene.context(step), history, loads);
    const double push = force_on(loads, scene.first_free).z();
    EXPECT_GE(push, last);
    last = push;
  }
  EXPECT_LT(scene.nodes[scene.first_free].x[2], -0.005);
}

TEST(PenaltyContact, SlidingOverFacetEdgesKeepsTheForce) {
  Scene scene({{0.05, 0.05, 0.02}});
  const auto contact = make_node_contact("c", scene.points(), scene.surface, plain());
  ContactHistory history;
  contact->initialise(history, scene.context());
  ContactLoads loads;
  double lowest = 1e300, highest = 0;
  for (int step = 1; step <= 700; ++step) {
    NodeRecord& node = scene.nodes[scene.first_free];
    node.set_position({0.03 + 0.0005 * step * 0.9, 0.05 + 0.0004 * step, 0.008});
    node.set_velocity({450, 400, 0});
    loads.nodal.clear();
    contact->forces(scene.context(step), history, loads);
    const double push = force_on(loads, scene.first_free).z();
    lowest = std::min(lowest, push);
    highest = std::max(highest, push);
  }
  EXPECT_GT(lowest, 0);
  EXPECT_NEAR(lowest, highest, 1e-9 * highest);
}

TEST(PenaltyContact, InitialPenetrationIsAcceptedUntilTheNodeLetsGo) {
  Scene scene({{0.15, 0.15, 0.007}});
  for (const InitialPenetration rule :
       {InitialPenetration::Accepted, InitialPenetration::PushedOut}) {
    PenaltySettings settings = plain();
    settings.initial = rule;
    const bool is_accepted = rule == InitialPenetration::Accepted;
    const auto contact = make_node_contact("c", scene.points(), scene.surface, settings);
    ContactHistory history;
    NodeRecord& node = scene.nodes[scene.first_free];
    node.x[2] = 0.007;
    contact->initialise(history, scene.context());
    auto push_at = [&](double z, int step) {
      node.x[2] = z;
      ContactLoads loads;
      contact->forces(scene.context(step), history, loads);
      return force_on(loads, scene.first_free).z();
    };
    if (is_accepted) {
      EXPECT_EQ(push_at(0.007, 1), 0);
    } else {
      EXPECT_GT(push_at(0.007, 1), 0);
    }
    EXPECT_GT(push_at(0.006, 2), 0);
    EXPECT_EQ(push_at(0.012, 3), 0);   // lets go
    EXPECT_GT(push_at(0.0095, 4), 0);  // now the full thickness counts
  }
}

TEST(PenaltyContact, AFlatSheetDoesNotRepelItselfButAFoldDoes) {
  const Plate plate{10, 2, 1.0, 0.2};
  auto folded = [](const Vec3& p) -> Vec3 {  // back over itself at x = 0.5 with a gap of 30 mm
    if (p.x() <= 0.5) return p;
    return {1.0 - p.x() + 0.05, p.y(), 0.03};
  };
  for (bool is_folded : {false, true}) {
    Mesh mesh = is_folded ? plate_mesh(plate, folded) : plate_mesh(plate);
    std::vector<NodeRecord> nodes(mesh.node_count());
    std::vector<double> mass(mesh.node_count(), 1.0);
    for (int n = 0; n < mesh.node_count(); ++n) {
      nodes[n].set_position(mesh.position[n]);
      nodes[n].inverse_mass = 1;
    }
    const ContactPart part{0, 1e6, 0.05, {}};
    PenaltySettings settings = plain();
    settings.initial = InitialPenetration::PushedOut;
    const auto contact = make_single_surface_contact("c", surface_of(mesh, {&part, 1}), settings);
    ContactHistory history;
    const ContactContext context{nodes, mass, {}, 0, 1e-6, 0, 1};
    contact->initialise(history, context);
    ContactLoads loads;
    const ContactReport report = contact->forces(context, history, loads);
    if (is_folded) {
      EXPECT_GT(report.active, 10);
    } else {
      EXPECT_EQ(report.active, 0);
    }
  }
}

TEST(PenaltyContact, SoftConstraintLiftsAndTheCapBoundsTheStiffness) {
  Scene scene({{0.15, 0.15, 0.02}});
  auto push = [&](double scale, double soft) {
    PenaltySettings settings = plain();
    settings.stiffness_scale = scale;
    settings.soft_scale = soft;
    const auto contact = make_node_contact("c", scene.points(), scene.surface, settings);
    scene.nodes[scene.first_free].x[2] = 0.02;
    ContactHistory history;
    contact->initialise(history, scene.context());
    scene.nodes[scene.first_free].x[2] = 0.009;
    ContactLoads loads;
    const ContactReport report = contact->forces(scene.context(1), history, loads);
    EXPECT_GE(report.stable_step, 1e-6);
    return force_on(loads, scene.first_free).z() / 0.001;
  };
  const double per_step = 0.5 / (1e-6 * 1e-6);  // m* = 1 / (1 + 1) kg
  EXPECT_NEAR(push(1e-3, 0.1), 0.05 * per_step, 1e-6 * per_step);
  EXPECT_NEAR(push(1e20, 0), 0.25 * per_step, 1e-6 * per_step);
}

TEST(PenaltyContact, SameBitsForAnyNumberOfThreadsAndAfterRestart) {
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) points.push_back({0.01 * i, 0.01 * j, 0.009 + 0.00001 * i});
  Scene scene(points);
  PenaltySettings settings = plain();
  settings.static_friction = settings.dynamic_friction = 0.3;
  settings.initial = InitialPenetration::PushedOut;
  auto run = [&](int threads, int restart_at) {
    Scene s = scene;
    const auto contact = make_node_contact("c", s.points(), s.surface, settings);
    ContactHistory history;
    contact->initialise(history, s.context());
    Vec3 checksum = Vec3::Zero();
    for (int step = 1; step <= 20; ++step) {
      for (int n = s.first_free; n < s.mesh.node_count(); ++n) {
        s.nodes[n].set_velocity({500, 300.0 * std::sin(n), 0});
        s.nodes[n].set_position(s.nodes[n].position() + 1e-6 * s.nodes[n].velocity());
      }
      if (step == restart_at) history = ContactHistory(history);
      ContactLoads loads;
      contact->forces(s.context(step, threads), history, loads);
      for (const NodalLoad& load : loads.nodal) checksum += load.force * (1 + load.node % 7);
    }
    return checksum;
  };
  const Vec3 one = run(1, 0);
  EXPECT_GT(one.norm(), 0);
  EXPECT_EQ(one, run(2, 0));
  EXPECT_EQ(one, run(3, 11));
}

}  // namespace
}  // namespace crosswalk::fe
