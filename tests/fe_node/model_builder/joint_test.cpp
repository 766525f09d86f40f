// Joints and their stiffness between rigid bodies, from the deck to the motion: periods, stops,
// friction and dampers against closed forms; momenta and energy of free pairs.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "common/error.h"
#include "fe_node/solver.h"
#include "tests/fe_node/model_builder/built_deck.h"

namespace crosswalk::fe {
namespace {

constexpr double kStep = 1e-6;  // s, that of models of rigid bodies alone

/// Two rigid cubes of 0.2 m in m, kg, s with given inertia, meeting at the origin: A in x < 0, B
/// in x > 0. Nodes 101.. belong to A, 201.. to B, at the origin and along the axes.
std::string two_bodies(const char* law_a, const Vec3& inertia_b = {2e-3, 3e-3, 4e-3}) {
  std::string text = "*NODE\n";
  int id = 0;
  for (const double x0 : {-0.2, 0.0})
    for (int k = 0; k < 8; ++k)
      text += fmt::format("{},{},{},{}\n", ++id, x0 + 0.2 * ((k + 1) / 2 % 2),
                          -0.1 + 0.2 * (k / 2 % 2), -0.1 + 0.2 * (k / 4));
  for (const int first : {101, 201})
    text += fmt::format("{},0,0,0\n{},0.1,0,0\n{},0,0.1,0\n{},0,0,0.1\n", first, first + 1,
                        first + 2, first + 3);
  text += fmt::format(
      "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n2,2,9,10,11,12,13,14,15,16\n*SECTION_SOLID\n1,1\n"
      "*MAT_RIGID\n1,1000.,1e9,0.3\n{}\n\n*MAT_RIGID\n2,1000.,1e9,0.3\n\n\n"
      "*PART_INERTIA\nA\n1,1,1\n-0.1,0,0,3.0\n5e-3,0,0,6e-3,0,7e-3\n0,0,0,0,0,0\n"
      "*PART_INERTIA\nB\n2,1,2\n0.1,0,0,2.0\n{},0,0,{},0,{}\n0,0,0,0,0,0\n"
      "*SET_NODE_LIST\n1\n101,102,103,104\n*SET_NODE_LIST\n2\n201,202,203,204\n"
      "*CONSTRAINED_EXTRA_NODES_SET\n1,1\n2,2\n"
      "*DEFINE_COORDINATE_SYSTEM\n1,0,0,0,1,0,0\n0,1,0\n",
      law_a, inertia_b.x(), inertia_b.y(), inertia_b.z());
  return text;
}
constexpr const char* kFixed = "1,7,7";
constexpr const char* kFree = "";

/// About z through the origin: parallel-axis theorem.
constexpr double kHingeInertia = 4e-3 + 2.0 * 0.1 * 0.1;
const std::string kHinge = "*CONSTRAINED_JOINT_REVOLUTE\n101,201,104,204\n";

/// A model of two bodies that runs with equal steps.
class Pair {
 public:
  explicit Pair(const std::string& text)
      : built_(model_of(text,
                        [] {
                          BuildOptions options;
                          options.units = UnitSystem::MKgS;
                          return options;
                        }())),
        state_(initial_state(built_.model)),
        scratch_(built_.model, 1) {}

  /// A velocity of the body's mass centre and a spin.
  void start(int body, const Vec3& v, const Vec3& w) {
    BodyState& s = state_.bodies[body];
    s.V_WB = {v, w};
    s.angular_momentum = angular_momentum(built_.model.bodies[body], s.X_WB, w);
  }
  template <class Watch>
  void run(double end, Watch&& watch) {
    while (state_.time < end) {
      advance_step(built_.model, state_, scratch_, kStep);
      watch();
    }
  }
  void run(double end) {
    run(end, [] {});
  }
  const BodyState& body(int b) const { return state_.bodies[b]; }
  double mass(int b) const { return built_.model.bodies[b].inertia.mass; }
  double time() const { return state_.time; }
  /// Of B against A, rad about z.
  double angle() const { return log_rotation(body(0).X_WB.q.conjugate() * body(1).X_WB.q).z(); }
  double kinetic() const {
    double sum = 0;
    for (int b = 0; b < 2; ++b)
      sum += 0.5 * mass(b) * body(b).V_WB.v.squaredNorm() +
             0.5 * body(b).V_WB.w.dot(
                       angular_momentum(built_.model.bodies[b], body(b).X_WB, body(b).V_WB.w));
    return sum;
  }
  double stored() const {
    double sum = 0;
    for (const ContactReport& report : scratch_.contact_reports) sum += report.stored;
    return sum;
  }
  double friction() const {
    double sum = 0;
    for (const ContactHistory& history : state_.contacts) sum += history.friction_dissipated;
    return sum;
  }
  double largest_gap() const { return scratch_.contact_reports[0].max_penetration; }
  Vec3 momentum() const { return mass(0) * body(0).V_WB.v + mass(1) * body(1).V_WB.v; }
  /// About the origin; velocities belong half a step back, so do the places taken here.
  Vec3 spin() const {
    Vec3 sum = Vec3::Zero();
    for (int b = 0; b < 2; ++b) {
      const Vec3 x = body(b).X_WB.p - 0.5 * kStep * body(b).V_WB.v;
      sum += body(b).angular_momentum + mass(b) * x.cross(body(b).V_WB.v);
    }
    return sum;
  }

 private:
  BuiltModel built_;
  State state_;
  Scratch scratch_;
};

std::string linear_curve(int id, double slope) {
  return fmt::format("*DEFINE_CURVE\n{}\n0,0\n1,{}\n", id, slope);
}
/// A stiffness of the hinge about z: curves, friction and stops of psi.
std::string about_z(int curve, int damper, const char* friction, const char* stops) {
  return fmt::format(
      "*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED\n7,1,2,1,1\n0,0,{},0,0,{}\n0,0,0,0,{}\n0,0,0,0,{}"
      "\n",
      curve, damper, friction, stops);
}

TEST(JointStiffness, PendulumOnATorsionCurveHasItsPeriod) {
  const double k = 600;  // N m/rad
  Pair pair(two_bodies(kFixed) + kHinge + linear_curve(5, k) + about_z(5, 0, "0,0", "0,0"));
  const double spin = 2, rate = std::sqrt(k / kHingeInertia);
  pair.start(1, {0, 0.1 * spin, 0}, {0, 0, spin});
  double last_angle = 0, half_period = 0, amplitude = 0;
  pair.run(0.05, [&] {
    const double now = pair.angle();
    amplitude = std::max(amplitude, now);
    if (last_angle > 0 && now <= 0 && half_period == 0)
      half_period = pair.time() - kStep * now / (now - last_angle);
    last_angle = now;
  });
  // the hinge is a penalty spring of 0.1 m*/dt^2: it gives way by 1e-6 of the motion
  EXPECT_NEAR(half_period * rate / std::numbers::pi, 1, 2e-4);
  EXPECT_NEAR(amplitude * rate / spin, 1, 2e-4);
}

TEST(JointStiffness, StopsTurnTheBodyBack) {
  const double k = 5e4, spin = 3, stop = 2 * std::numbers::pi / 180;
  Pair pair(two_bodies(kFixed) + kHinge + about_z(0, 0, "50000,0", "-3,2"));
  pair.start(1, {0, 0.1 * spin, 0}, {0, 0, spin});
  double largest = 0, smallest = 0;
  pair.run(0.06, [&] {
    largest = std::max(largest, pair.angle());
    smallest = std::min(smallest, pair.angle());
  });
  const double beyond = spin * std::sqrt(kHingeInertia / k);
  EXPECT_NEAR(largest, stop + beyond, 2e-3 * beyond);
  EXPECT_NEAR(smallest, -1.5 * stop - beyond, 2e-3 * beyond);
}

TEST(JointStiffness, FrictionBrakesEvenly) {
  const double limit = 4, spin = 3;  // N m
  Pair pair(two_bodies(kFixed) + kHinge + about_z(0, 0, "0,4.0", "0,0"));
  pair.start(1, {0, 0.1 * spin, 0}, {0, 0, spin});
  const double energy = 0.5 * kHingeInertia * spin * spin;
  double largest = 0;
  pair.run(1.2 * kHingeInertia * spin / limit, [&] { largest = std::max(largest, pair.angle()); });
  EXPECT_NEAR(largest, energy / limit, 2e-3 * energy / limit);
  EXPECT_NEAR(pair.friction(), energy, 2e-3 * energy);
  EXPECT_LT(pair.kinetic(), 1e-3 * energy);
}

TEST(JointStiffness, ADamperSlowsDownExponentially) {
  const double c = 2.4, spin = 3;  // N m s
  Pair pair(two_bodies(kFixed) + kHinge + linear_curve(5, c) + about_z(0, 5, "0,0", "0,0"));
  pair.start(1, {0, 0.1 * spin, 0}, {0, 0, spin});
  const double decay = kHingeInertia / c;
  pair.run(2 * decay);
  EXPECT_NEAR(pair.body(1).V_WB.w.z() / (spin * std::exp(-2.0)), 1, 2e-3);
}

TEST(JointStiffness, CoupledRotationsKeepEnergyAndMomenta) {
  // bent curves about all three axes of a triad that is oblique in the bodies, turns near a radian
  const std::string curves =
      "*DEFINE_CURVE\n5\n-2,-90\n-0.3,-6\n0.3,6\n2,90\n*DEFINE_CURVE\n6\n0,0\n0.5,20\n2,20\n"
      "*DEFINE_COORDINATE_VECTOR\n2,1,1,0,-1,1,0.5\n";
  Pair pair(two_bodies(kFree) + curves +
            "*CONSTRAINED_JOINT_SPHERICAL\n101,201\n"
            "*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED\n7,1,2,2,0\n5,6,5\n0,0,0,0,0,0\n"
            "0,0,0,0,0,0\n");
  pair.start(0, {0.5, 0, 0}, {0, 0, 0});
  const Vec3 w(40, -60, 50);
  pair.start(1, Vec3(0.5, 0, 0) + w.cross(Vec3(0.1, 0, 0)), w);
  const double energy = pair.kinetic();
  const Vec3 momentum = pair.momentum(), spin = pair.spin();
  double largest_turn = 0;
  pair.run(0.03, [&] {
    largest_turn = std::max(
        largest_turn, log_rotation(pair.body(0).X_WB.q.conjugate() * pair.body(1).X_WB.q).norm());
  });
  EXPECT_GT(largest_turn, 0.5);
  EXPECT_LT((pair.momentum() - momentum).norm(), 1e-11 * momentum.norm());
  EXPECT_LT((pair.spin() - spin).norm(), 1e-9 * spin.norm());
  // the spherical joint's damper takes a share of its own jitter
  EXPECT_NEAR((pair.kinetic() + pair.stored()) / energy, 1, 5e-3);
}

TEST(JointStiffness, ATranslationalSpringSwingsTwoMasses) {
  const double k = 3e4;
  Pair pair(two_bodies(kFree) + linear_curve(5, k) +
            "*CONSTRAINED_JOINT_TRANSLATIONAL\n101,201,102,202,103,203\n"
            "*CONSTRAINED_JOINT_STIFFNESS_TRANSLATIONAL\n7,1,2,1,1\n5,0,0\n0,0,0,0,0,0\n"
            "0,0,0,0,0,0\n");
  const double m_a = pair.mass(0), m_b = pair.mass(1), v = 1.5;
  pair.start(1, {v, 0, 0}, Vec3::Zero());
  const double rate = std::sqrt(k * (1 / m_a + 1 / m_b));
  double largest = 0, last = 0, half_period = 0;
  pair.run(0.04, [&] {
    const double slide = pair.body(1).X_WB.p.x() - pair.body(0).X_WB.p.x() - 0.2;
    largest = std::max(largest, slide);
    if (last > 0 && slide <= 0 && half_period == 0)
      half_period = pair.time() - kStep * slide / (slide - last);
    last = slide;
  });
  EXPECT_NEAR(largest * rate / v, 1, 1e-3);
  EXPECT_NEAR(half_period * rate / std::numbers::pi, 1, 1e-3);
}

TEST(Joints, LockedBodiesKeepTheirRelativePoseAndMomenta) {
  Pair pair(two_bodies(kFree) + "*CONSTRAINED_JOINT_LOCKING\n101,201,102,202,103,203\n");
  pair.start(1, {0, 3, 1}, {10, 0, 20});
  const Vec3 momentum = pair.momentum(), spin = pair.spin();
  pair.run(0.05);
  const Pose relative = pair.body(0).X_WB.inverse() * pair.body(1).X_WB;
  EXPECT_GT(log_rotation(pair.body(0).X_WB.q).norm(), 0.2);  // they have turned
  EXPECT_LT(log_rotation(relative.q).norm(), 1e-3);
  EXPECT_LT((relative.p - Vec3(0.2, 0, 0)).norm(), 1e-4);
  EXPECT_LT((pair.momentum() - momentum).norm(), 1e-11 * momentum.norm());
  EXPECT_LT((pair.spin() - spin).norm(), 1e-9 * spin.norm());
}

TEST(Joints, ACylindricalJointSlidesAndTurnsAboutItsAxisAlone) {
  Pair pair(two_bodies(kFixed) + "*CONSTRAINED_JOINT_CYLINDRICAL\n101,201,102,202\n");
  pair.start(1, {2, 0, 0}, {30, 0, 0});
  pair.run(0.03);
  EXPECT_NEAR(pair.body(1).X_WB.p.x(), 0.1 + 2 * 0.03, 1e-5);
  EXPECT_NEAR(pair.body(1).V_WB.w.x(), 30, 1e-6);
  Pair pushed(two_bodies(kFixed) + "*CONSTRAINED_JOINT_CYLINDRICAL\n101,201,102,202\n");
  pushed.start(1, {2, 1, 0}, {0, 0, 5});
  pushed.run(0.03);
  EXPECT_NEAR(pushed.body(1).X_WB.p.x(), 0.1 + 2 * 0.03, 1e-4);
  EXPECT_LT(std::abs(pushed.body(1).X_WB.p.y()), 1e-4);
  EXPECT_LT(std::abs(log_rotation(pushed.body(1).X_WB.q).z()), 1e-3);
}

TEST(Joints, APlanarJointLeavesTheMotionInItsPlane) {
  const std::string planar = "*CONSTRAINED_JOINT_PLANAR\n101,201,104,204\n";
  Pair pair(two_bodies(kFixed) + planar);
  pair.start(1, {2, -1, 0}, {0, 0, 30});
  pair.run(0.03);
  EXPECT_LT((pair.body(1).X_WB.p - Vec3(0.16, -0.03, 0)).norm(), 1e-5);
  EXPECT_NEAR(pair.body(1).V_WB.w.z(), 30, 1e-6);
  Pair pushed(two_bodies(kFixed) + planar);
  pushed.start(1, {2, 0, 1}, {5, 5, 0});
  pushed.run(0.03);
  EXPECT_LT(std::abs((pushed.body(1).X_WB * Vec3(-0.1, 0, 0)).z()), 1e-4);
  EXPECT_LT(pushed.body(1).X_WB.q.toRotationMatrix().col(2).head<2>().norm(), 1e-3);
}

const std::string kUniversal = "*CONSTRAINED_JOINT_UNIVERSAL\n101,201,103,204\n";  // arms y, z

TEST(Joints, AUniversalJointTurnsFreelyAboutItsArmsAlone) {
  Pair about_y(two_bodies(kFixed) + kUniversal);
  about_y.start(1, {0, 0, -3}, {0, 30, 0});
  about_y.run(0.03);
  EXPECT_NEAR(log_rotation(about_y.body(1).X_WB.q).y(), 30 * 0.03, 1e-4);
  EXPECT_NEAR(about_y.body(1).V_WB.w.y(), 30, 1e-6 * 30);
  Pair about_z(two_bodies(kFixed) + kUniversal);
  about_z.start(1, {0, 3, 0}, {0, 0, 30});
  about_z.run(0.03);
  EXPECT_NEAR(about_z.body(1).V_WB.w.z(), 30, 1e-6 * 30);
  Pair pushed(two_bodies(kFixed) + kUniversal);
  pushed.start(1, {1, 0, 0}, {5, 0, 0});
  pushed.run(0.03);
  EXPECT_LT(log_rotation(pushed.body(1).X_WB.q).norm(), 1e-3);
  EXPECT_LT((pushed.body(1).X_WB.p - Vec3(0.1, 0, 0)).norm(), 1e-4);
}

TEST(Joints, AFreePairOnAUniversalJointKeepsItsMomenta) {
  Pair pair(two_bodies(kFree) + kUniversal);
  pair.start(1, {0, 3, 1}, {10, -10, 30});
  const Vec3 momentum = pair.momentum(), spin = pair.spin();
  pair.run(0.05);
  const Mat3 a = pair.body(0).X_WB.q.toRotationMatrix(), b = pair.body(1).X_WB.q.toRotationMatrix();
  EXPECT_GT(log_rotation(Quat(a.transpose() * b)).norm(), 0.5);
  EXPECT_LT(std::abs(a.col(1).dot(b.col(2))), 1e-3);
  EXPECT_LT((pair.momentum() - momentum).norm(), 1e-11 * momentum.norm());
  EXPECT_LT((pair.spin() - spin).norm(), 1e-9 * spin.norm());
}

/// Hooke: with the shafts at an angle beta and the driving arm at theta from their plane,
/// omega_2 / omega_1 = cos beta / (1 - sin^2 beta cos^2 theta); no joint does work, so
/// I_1 omega_1^2 + I_2 omega_2^2 stays.
TEST(Joints, ShaftsOnAUniversalJointKeepTheRatioOfHooke) {
  const double beta = 0.5, c = std::cos(beta), s = std::sin(beta);  // rad
  std::string bearing = "*NODE\n301,0,0,0\n";
  for (const int node : {205, 305}) bearing += fmt::format("{},{},{},0\n", node, 0.1 * c, 0.1 * s);
  for (int k = 0; k < 8; ++k)
    bearing += fmt::format("{},{},{},{}\n", 17 + k, 0.4 + 0.2 * ((k + 1) / 2 % 2),
                           -0.1 + 0.2 * (k / 2 % 2), -0.1 + 0.2 * (k / 4));
  bearing +=
      "*ELEMENT_SOLID\n3,3,17,18,19,20,21,22,23,24\n*MAT_RIGID\n3,1000.,1e9,0.3\n1,7,7\n\n"
      "*PART\nbearing\n3,1,3\n*SET_NODE_LIST\n3\n301,305\n*CONSTRAINED_EXTRA_NODES_NODE\n2,205\n"
      "*CONSTRAINED_EXTRA_NODES_SET\n3,3\n*CONSTRAINED_JOINT_REVOLUTE\n301,201,305,205\n";
  constexpr const char* kAboutX = "1,7,5";
  Pair pair(two_bodies(kAboutX) + bearing + kUniversal);
  const Vec3 shaft(c, s, 0);
  const double first = 60, ratio = 1 / c;  // rad/s; theta = 0: the arm lies in the plane
  pair.start(0, Vec3::Zero(), {first, 0, 0});
  const Vec3 w = first * ratio * shaft;
  pair.start(1, w.cross(Vec3(0.1, 0, 0)), w);
  const double I_1 = 5e-3, I_2 = 2e-3 * c * c + 3e-3 * s * s + 2.0 * 0.1 * 0.1 * s * s;
  const double energy = I_1 + I_2 * ratio * ratio;
  double worst_ratio = 0, worst_speed = 0, turned = 0, largest = 0, smallest = 10;
  pair.run(0.12, [&] {
    const double omega_1 = pair.body(0).V_WB.w.x(), omega_2 = pair.body(1).V_WB.w.dot(shaft);
    turned += omega_1 * kStep;
    const double theta = turned - 0.5 * omega_1 * kStep;  // velocities belong half a step back
    const double expected = c / (1 - std::pow(s * std::cos(theta), 2));
    const double speed = first * std::sqrt(energy / (I_1 + I_2 * expected * expected));
    worst_ratio = std::max(worst_ratio, std::abs(omega_2 / omega_1 / expected - 1));
    worst_speed = std::max(worst_speed, std::abs(omega_1 / speed - 1));
    largest = std::max(largest, omega_2 / omega_1),
    smallest = std::min(smallest, omega_2 / omega_1);
  });
  EXPECT_GT(turned, 2 * std::numbers::pi);
  EXPECT_NEAR(largest, 1 / c, 1e-3);
  EXPECT_NEAR(smallest, c, 1e-3);
  EXPECT_LT(worst_ratio, 1e-3);
  EXPECT_LT(worst_speed, 1e-3);
}

TEST(Joints, APairThatSlidesKeepsItsMomenta) {
  Pair pair(two_bodies(kFree) + "*CONSTRAINED_JOINT_TRANSLATIONAL\n101,201,102,202,103,203\n");
  pair.start(0, {0, 0, 0}, {0, 0, 20});
  pair.start(1, {1, 4, 0}, {0, 0, 20});
  const Vec3 momentum = pair.momentum(), spin = pair.spin();
  pair.run(0.05);
  const Pose relative = pair.body(0).X_WB.inverse() * pair.body(1).X_WB;
  EXPECT_GT(relative.p.x(), 0.25);  // the rotation throws them apart along the axis
  EXPECT_LT(relative.p.tail<2>().norm(), 1e-4);
  EXPECT_LT(log_rotation(relative.q).norm(), 1e-3);
  EXPECT_LT((pair.momentum() - momentum).norm(), 1e-11 * momentum.norm());
  EXPECT_LT((pair.spin() - spin).norm(), 1e-8 * spin.norm());
}

TEST(JointStiffness, WhatCannotBeRunIsNamed) {
  const auto problems = [](const std::string& text) -> std::string {
    try {
      Pair pair(text);
    } catch (const UserError& error) {
      std::string out;
      for (const Problem& problem : error.problems()) out += problem.text() + '\n';
      return out;
    }
    return "none";
  };
  const std::string bodies = two_bodies(kFree);
  const std::string rest = "0,0,0,0,0,0\n0,0,0,0,0,0\n0,0,0,0,0,0\n";
  const std::string keyword = "*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED\n";
  using testing::HasSubstr;
  EXPECT_EQ(problems(bodies + keyword + "7,1,2,1,1\n" + rest), "none");
  EXPECT_THAT(problems(bodies + keyword + "7,1,2,0,0\n" + rest), HasSubstr("CIDA"));
  EXPECT_THAT(problems(bodies + keyword + "7,1,1,1,1\n" + rest), HasSubstr("two bodies"));
  EXPECT_THAT(problems(bodies + keyword + "7,1,2,1,1\n0,0,0,0,0,0\n0,-3,0,0,0,0\n0,0,0,0,0,0\n"),
              HasSubstr("friction"));
  EXPECT_THAT(problems(bodies + "*CONSTRAINED_JOINT_UNIVERSAL\n101,201,102,202\n"),
              HasSubstr("90 degrees off"));
  EXPECT_THAT(problems(bodies + "*CONSTRAINED_JOINT_UNIVERSAL\n101,201,102,201\n"),
              HasSubstr("nodes 2 and 4 at one place"));
}

}  // namespace
}  // namespace crosswalk::fe
