#include "fe_node/element/beam.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "fe_node/solver.h"
#include "tests/fe_node/plate_model.h"

namespace crosswalk::fe {
namespace {

const BeamSection kSection = rectangular_beam(7850, 210e9, 0.3, 0.02, 0.05);

/// Beams along a straight line.
Model beam_line(int count, const Vec3& from, const Vec3& to, const Vec3& in_plane,
                const BeamSection& section) {
  Model model;
  model.mesh.parts.push_back({DeckId{1}, "beam", false});
  ElementTable& lines = model.mesh.table(ElementKind::Line2);
  std::vector<int> all;
  for (int n = 0; n <= count; ++n) {
    model.mesh.position.push_back(from + (to - from) * n / count);
    model.mesh.node_id.push_back(DeckId{n + 1});
    if (n == 0) continue;
    lines.nodes.insert(lines.nodes.end(), {n - 1, n});
    lines.part.push_back(0);
    lines.id.push_back(DeckId{n});
    all.push_back(n - 1);
  }
  const std::vector<Vec3> planes(count, in_plane);
  model.blocks.push_back(make_beam_block(model.mesh, 0, all, section, planes));
  return model;
}

/// Loads for a unit of one degree of freedom of one node, per unit, in the order f, m per node.
Eigen::VectorXd column(const Model& model, int node, int dof) {
  constexpr double kSmall = 1e-7;
  PlateMotion motion = still(model);
  (dof < 3 ? motion.displacement : motion.rotation)[node][dof % 3] = kSmall;
  const NodalLoads loads = loads_after(model, motion);
  Eigen::VectorXd out(6 * model.mesh.node_count());
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    out.segment<3>(6 * n) = -loads.force[n] / kSmall;
    out.segment<3>(6 * n + 3) = -loads.moment[n] / kSmall;
  }
  return out;
}

Eigen::MatrixXd stiffness(const Model& model) {
  const int size = 6 * model.mesh.node_count();
  Eigen::MatrixXd K(size, size);
  for (int c = 0; c < size; ++c) K.col(c) = column(model, c / 6, c % 6);
  return K;
}

// The classic stiffness of Timoshenko's beam: axis x, s along y, t along z.
TEST(Beam, StiffnessIsTimoshenkos) {
  const double L = 0.4;
  const Model model = beam_line(1, {0, 0, 0}, {L, 0, 0}, Vec3::UnitY(), kSection);
  const Eigen::MatrixXd K = stiffness(model);
  const double E = kSection.youngs_modulus, G = kSection.shear_modulus, A = kSection.area;
  EXPECT_NEAR(K(6, 6), E * A / L, 1e-5 * K(6, 6));
  EXPECT_NEAR(K(9, 9), G * kSection.torsion / L, 1e-5 * K(9, 9));
  // deflection along y bends about z: width 20 mm along y cubed
  const double Iz = 0.05 * std::pow(0.02, 3) / 12, Iy = 0.02 * std::pow(0.05, 3) / 12;
  const double sz = 12 * E * Iz / (G * 5.0 / 6 * A * L * L), sy = sz * Iy / Iz;
  EXPECT_NEAR(K(7, 7), 12 * E * Iz / (L * L * L * (1 + sz)), 1e-5 * K(7, 7));
  EXPECT_NEAR(K(8, 8), 12 * E * Iy / (L * L * L * (1 + sy)), 1e-5 * K(8, 8));
  EXPECT_NEAR(K(11, 11), (4 + sz) * E * Iz / (L * (1 + sz)), 1e-5 * K(11, 11));
  EXPECT_NEAR(K(5, 11), (2 - sz) * E * Iz / (L * (1 + sz)), 1e-5 * K(5, 11));
  EXPECT_NEAR(K(10, 10), (4 + sy) * E * Iy / (L * (1 + sy)), 1e-5 * K(10, 10));
  EXPECT_NEAR(K(7, 11), -6 * E * Iz / (L * L * (1 + sz)), 1e-5 * std::abs(K(7, 11)));
  EXPECT_LT((K - K.transpose()).norm(), 1e-6 * K.norm());
}

TEST(Beam, RigidMotionGivesNoLoad) {
  const Model model = beam_line(3, {0.1, 0, 0.2}, {0.5, 0.3, 0.1}, Vec3::UnitZ(), kSection);
  const Vec3 w(0.9, -1.1, 0.7);
  PlateMotion motion = still(model);
  for (int n = 0; n < 4; ++n) {
    const Vec3& p = model.mesh.position[n];
    motion.displacement[n] = exp_rotation(w) * p - p + Vec3(1, 2, 3);
    motion.rotation[n] = w;
  }
  const NodalLoads loads = loads_after(model, motion);
  for (int n = 0; n < 4; ++n) {
    EXPECT_LT(loads.force[n].norm(), 1e-13 * kSection.youngs_modulus * kSection.area);
    EXPECT_LT(loads.moment[n].norm(), 1e-13 * kSection.youngs_modulus * kSection.area);
  }
}

TEST(Beam, LoadsOfAnyMotionHaveNoResultantAndNoMoment) {
  const Model model = beam_line(4, {0, 0, 0}, {0.6, 0.1, 0.2}, Vec3::UnitY(), kSection);
  PlateMotion motion = still(model);
  for (int n = 0; n < 5; ++n) {
    motion.displacement[n] = 1e-2 * Vec3(std::sin(7 * n), std::sin(11 * n), std::sin(13 * n));
    motion.rotation[n] = 0.2 * Vec3(std::sin(5 * n), std::sin(17 * n), std::sin(3 * n));
  }
  const NodalLoads loads = loads_after(model, motion);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double scale = 0;
  for (int n = 0; n < 5; ++n) {
    force += loads.force[n];
    moment +=
        (model.mesh.position[n] + motion.displacement[n]).cross(loads.force[n]) + loads.moment[n];
    scale += loads.force[n].norm();
  }
  EXPECT_LT(force.norm(), 1e-13 * scale);
  EXPECT_LT(moment.norm(), 1e-12 * scale);
}

TEST(Beam, StableStepIsThatOfItsOwnStiffnessAndMass) {
  for (const double L : {0.02, 0.1, 1.0}) {
    Model model = beam_line(1, {0, 0, 0}, {L, 0, 0}, Vec3::UnitY(), kSection);
    const Eigen::MatrixXd K = stiffness(model);
    model.finish();
    Eigen::VectorXd root(12);
    for (int c = 0; c < 12; ++c)
      root[c] = 1 / std::sqrt(c % 6 < 3 ? model.mass[c / 6] : model.inertia[c / 6]);
    const Eigen::MatrixXd A = root.asDiagonal() * (0.5 * (K + K.transpose())) * root.asDiagonal();
    const double exact =
        2 / std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().maxCoeff());
    EXPECT_NEAR(initial_stable_step(model), exact, 1e-4 * exact) << L;
  }
}

// Roark's torsion constants: square 2.25 a^4 (side 2a), tube pi/32 (D^4 - d^4).
TEST(Beam, SectionConstants) {
  const BeamSection square = rectangular_beam(1, 1, 0, 0.2, 0.2);
  EXPECT_NEAR(square.torsion, 2.25 * 1e-4, 0.01 * 2.25e-4);
  const BeamSection tube = tubular_beam(1, 1, 0, 0.04, 0.03);
  EXPECT_NEAR(tube.torsion, M_PI / 32 * (std::pow(0.04, 4) - std::pow(0.03, 4)), 1e-15);
  EXPECT_NEAR(tube.area, M_PI / 4 * 0.0007, 1e-12);
}

}  // namespace
}  // namespace crosswalk::fe
