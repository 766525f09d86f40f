#include "fe_node/element/shell.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "fe_node/solver.h"
#include "tests/fe_node/plate_model.h"

namespace crosswalk::fe {
namespace {

constexpr double kYoungs = 70e9, kPoisson = 0.23, kThickness = 0.005;
const ShellElastic kGlass{2500, kYoungs, kPoisson};

/// Moves every inner node off its place in the plane.
Vec3 skewed(const Vec3& p) {
  return p + Vec3(0.05 * std::sin(9 * p.y() + 5 * p.x()), 0.06 * std::sin(8 * p.x()), 0) *
                 (p.x() * (1 - p.x()) * p.y() * (1 - p.y()) > 1e-9 ? 1.0 : 0.0);
}
Vec3 doubly_curved(const Vec3& p) {
  return {p.x(), p.y(), 0.2 * p.x() * p.y() - 0.1 * p.x() * p.x()};
}

struct ShellForm {
  const char* name;
  ElementKind kind;
  ShellIntegration integration;
};

class EveryShell : public testing::TestWithParam<ShellForm> {
 protected:
  Plate plate(int nx, int ny) const { return {nx, ny, 1, 1, GetParam().kind}; }
  bool is_full() const { return GetParam().integration == ShellIntegration::Full; }
  ShellSection glass(double thickness) const {
    ShellSection section = uniform_section(kGlass, thickness, 3);
    section.integration = GetParam().integration;
    return section;
  }
};

TEST_P(EveryShell, RigidMotionGivesNoLoad) {
  const Plate shape = plate(4, 4);
  Model model = plate_model(shape, glass(kThickness), {}, doubly_curved);
  const double per_strain = kYoungs * kThickness;  // N/m
  PlateMotion motion = still(model);
  // The spin that belongs to a chord of the rotation is 2 tan(a/2), third order away from a.
  for (const Vec3& w : {Vec3(0, 0, 0.4), Vec3(0.3, -0.5, 0.2)}) {
    const Mat3 R = exp_rotation(w).toRotationMatrix();
    for (int n = 0; n < model.mesh.node_count(); ++n) {
      const Vec3& p = model.mesh.position[n];
      motion.displacement[n] = R * p - p + Vec3(0.1, 0.2, 0.3);
      motion.rotation[n] = 2 * std::tan(0.5 * w.norm()) * w.normalized();
    }
    for (const Vec3& f : loads_after(model, motion).force) EXPECT_LT(f.norm(), 1e-14 * per_strain);
  }
}

// Twice the step takes four times the mass; the part's own mass is told apart from what was added.
TEST_P(EveryShell, MassScalingIsReportedPerPart) {
  const ShellSection section = glass(kThickness);
  Model plain = plate_model(plate(4, 4), section);
  plain.finish();
  Model scaled = plate_model(plate(4, 4), section);
  scaled.settings.mass_scaling_step = 2 * initial_stable_step(plain);
  scaled.finish();
  const double own = 2500 * kThickness;  // 1 m2
  EXPECT_DOUBLE_EQ(plain.added_mass[0], 0);
  EXPECT_NEAR(scaled.part_mass[0], own, 1e-9 * own);
  EXPECT_NEAR(scaled.total_mass() - scaled.added_mass[0], own, 1e-9 * own);
  // every quadrilateral is alike; of the triangles those with a longer step need less
  if (GetParam().kind == ElementKind::Quad4)
    EXPECT_NEAR(scaled.added_mass[0], 3 * own, 1e-9 * own);
  else
    EXPECT_GT(scaled.added_mass[0], own);
}

TEST_P(EveryShell, MembranePatchCarriesConstantStress) {
  const Plate shape = plate(4, 4);
  Model model = plate_model(shape, glass(kThickness), {}, skewed);
  PlateMotion motion = still(model);
  Mat3 L = Mat3::Zero();
  L(0, 0) = 1e-6, L(0, 1) = 2e-6, L(1, 0) = 0.5e-6, L(1, 1) = -0.7e-6;
  for (int n = 0; n < model.mesh.node_count(); ++n)
    motion.displacement[n] = L * model.mesh.position[n];
  const NodalLoads loads = loads_after(model, motion);
  for (int j = 1; j < 4; ++j)
    for (int i = 1; i < 4; ++i)
      // second order in the strain of 1e-6
      EXPECT_LT(loads.force[shape.node(i, j)].norm(), 2e-6 * kYoungs * kThickness * 1e-6);
  // Edge x = 0 pulls with N_xx per length; its inner nodes own a quarter of it each.
  const double nxx = kYoungs / (1 - kPoisson * kPoisson) * (1e-6 - kPoisson * 0.7e-6) * kThickness;
  double edge = 0;
  for (int j = 0; j <= 4; ++j) edge += loads.force[shape.node(0, j)].x();
  EXPECT_NEAR(edge, nxx, 1e-5 * nxx);
}

// The one-point quadrilateral holds this patch on parallelograms alone.
TEST_P(EveryShell, BendingPatchCarriesConstantMoment) {
  const Plate shape = plate(4, 4);
  Model model = plate_model(shape, glass(kThickness), {}, [&](const Vec3& p) -> Vec3 {
    return is_full() ? skewed(p) : Vec3(p.x() + 0.3 * p.y(), p.y(), 0);
  });
  PlateMotion motion = still(model);
  // w = k y^2 / 2 gives theta_x = k y: the moment -D k acts on the edges and no shear anywhere.
  const double k = 1e-6;
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const double y = model.mesh.position[n].y();
    motion.displacement[n].z() = 0.5 * k * y * y;
    motion.rotation[n].x() = k * y;
  }
  const NodalLoads loads = loads_after(model, motion);
  const double D = kYoungs * std::pow(kThickness, 3) / (12 * (1 - kPoisson * kPoisson));
  double edge = 0;
  for (int i = 0; i <= 4; ++i) edge += loads.moment[shape.node(i, 0)].x();
  EXPECT_NEAR(edge, D * k, 1e-5 * D * k);
  for (int j = 1; j < 4; ++j)
    for (int i = 1; i < 4; ++i) {
      EXPECT_LT(loads.moment[shape.node(i, j)].norm(), 1e-5 * D * k);
      EXPECT_LT(std::abs(loads.force[shape.node(i, j)].z()), 1e-5 * D * k);
    }
}

// Nodes on the top: a stretch of theirs also bends, N e, and their curvature meets D + e^2 A.
TEST_P(EveryShell, NodesOffTheMiddleCoupleStretchAndBending) {
  const Plate shape = plate(4, 4);
  ShellSection section = glass(kThickness);
  move_reference(section, 0.5);
  Model model = plate_model(shape, section);
  const double stretch = kYoungs / (1 - kPoisson * kPoisson) * kThickness, e = 0.5 * kThickness;
  const auto edge_loads = [&](double strain, double curvature) {
    PlateMotion motion = still(model);
    for (int n = 0; n < model.mesh.node_count(); ++n) {
      const double y = model.mesh.position[n].y();
      motion.displacement[n] = {0, strain * y, 0.5 * curvature * y * y};
      motion.rotation[n].x() = curvature * y;
    }
    const NodalLoads loads = loads_after(model, motion);
    Eigen::Vector2d sum =
        Eigen::Vector2d::Zero();  // force along y and moment about x at y = 0, which is 1 m long
    for (int i = 0; i <= 4; ++i)
      sum += Eigen::Vector2d(loads.force[shape.node(i, 0)].y(), loads.moment[shape.node(i, 0)].x());
    return sum;
  };
  const double k = 1e-6, D = stretch * kThickness * kThickness / 12 + stretch * e * e;
  EXPECT_NEAR(edge_loads(k, 0)[0], stretch * k, 1e-4 * stretch * k);
  EXPECT_NEAR(edge_loads(k, 0)[1], stretch * e * k, 1e-4 * stretch * e * k);
  EXPECT_NEAR(edge_loads(0, k)[0], stretch * e * k, 1e-4 * stretch * e * k);
  EXPECT_NEAR(edge_loads(0, k)[1], D * k, 1e-4 * D * k);
}

TEST_P(EveryShell, LoadsOfAnyMotionHaveNoResultantAndNoMoment) {
  Model model = plate_model(plate(3, 3), glass(kThickness), {}, doubly_curved);
  PlateMotion motion = still(model);
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    motion.displacement[n] = 1e-3 * Vec3(std::sin(7 * n), std::sin(11 * n), std::sin(13 * n));
    motion.rotation[n] = 1e-2 * Vec3(std::sin(5 * n), std::sin(17 * n), std::sin(3 * n));
  }
  const NodalLoads loads = loads_after(model, motion);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double scale = 0;
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    force += loads.force[n];
    moment +=
        (model.mesh.position[n] + motion.displacement[n]).cross(loads.force[n]) + loads.moment[n];
    scale += loads.force[n].norm();
  }
  EXPECT_LT(force.norm(), 1e-13 * scale);
  EXPECT_LT(moment.norm(), 1e-12 * scale);  // the plate is 1 m
}

/// The largest stable step of the assembled stiffness and mass.
double exact_stable_step(const Model& model) {
  const Eigen::MatrixXd K = stiffness_matrix(model);
  EXPECT_LT((K - K.transpose()).norm(), 1e-6 * K.norm());
  Eigen::VectorXd mass(K.rows());
  for (int i = 0; i < K.rows(); ++i) mass[i] = (i % 6 < 3 ? model.mass : model.inertia)[i / 6];
  const Eigen::VectorXd inverse_root = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd A =
      inverse_root.asDiagonal() * (0.5 * (K + K.transpose())) * inverse_root.asDiagonal();
  return 2 / std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().maxCoeff());
}

// The element's own estimate against the exact largest frequency of its stiffness and mass.
TEST_P(EveryShell, StableStepIsBelowTheExactOneAndNotWasteful) {
  for (const auto& [thickness, reference] :
       {std::pair(0.002, 0.0), {0.1, 0.0}, {0.4, 0.0}, {0.1, 0.5}, {0.4, -0.5}}) {
    ShellSection section = glass(thickness);
    move_reference(section, reference);
    Model model = plate_model(plate(1, 1), section, {}, [](const Vec3& p) {
      return Vec3(p.x() + 0.2 * p.y(), 0.7 * p.y(), 0);
    });
    model.finish();
    const double exact = exact_stable_step(model), estimate = initial_stable_step(model);
    EXPECT_LE(estimate, exact * (1 + 1e-6)) << thickness;
    EXPECT_GE(estimate, 0.6 * exact) << thickness;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shell, EveryShell,
    testing::Values(ShellForm{"Quad4", ElementKind::Quad4, ShellIntegration::OnePoint},
                    ShellForm{"FullQuad4", ElementKind::Quad4, ShellIntegration::Full},
                    ShellForm{"Tri3", ElementKind::Tri3, ShellIntegration::OnePoint}),
    [](const auto& item) { return std::string(item.param.name); });

/// Trapezia, kites and warped squares: a corner of the unit square moved about.
const Vec3 kMovedCorners[] = {{0.3, 0, 0},      {0, -0.4, 0}, {-0.3, -0.3, 0}, {0.8, 0.5, 0},
                              {-0.2, 0.1, 0.2}, {0, 0, 0.5},  {-0.4, 0.1, 0},  {0.3, 0.3, -0.3}};

Model distorted_element(const Vec3& moved, double thickness) {
  return plate_model({1, 1}, fully_integrated(uniform_section(kGlass, thickness, 3)), {},
                     [&](const Vec3& p) -> Vec3 { return p.x() * p.y() > 0.5 ? p + moved : p; });
}

TEST(FullShell, StableStepHoldsForDistortedAndWarpedElements) {
  for (const Vec3& moved : kMovedCorners)
    for (const double thickness : {0.002, 0.1, 0.4}) {
      Model model = distorted_element(moved, thickness);
      model.finish();
      const double exact = exact_stable_step(model), estimate = initial_stable_step(model);
      EXPECT_LE(estimate, exact * (1 + 1e-6)) << moved.transpose() << ", t " << thickness;
      EXPECT_GE(estimate, 0.3 * exact) << moved.transpose() << ", t " << thickness;
    }
}

// Six rigid motions and nothing else. The softest mode is a rotation about the normal, 1e-4 of the
// bending stiffness.
TEST(FullShell, OnlyRigidMotionsAreWithoutEnergy) {
  constexpr double t = 0.4;  // thick enough that the softest modes stand clear of round-off
  for (const Vec3& moved : kMovedCorners) {
    const Eigen::MatrixXd K = stiffness_matrix(distorted_element(moved, t));
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (K + K.transpose())).eigenvalues();
    for (int i = 0; i < 6; ++i) EXPECT_LT(std::abs(values[i]), 1e-9 * values[23]);
    EXPECT_GT(values[6], 1e-7 * values[23]) << moved.transpose();
    // bending, shear and membrane
    EXPECT_GT(values[10], 1e-4 * values[23]) << moved.transpose();
  }
}

// One side drawn beyond the failure strain takes the two points beside it; the element holds on
// with the others, half the force, until they fail as well.
TEST(FullShell, FailsOnceMostOfItsPointsHave) {
  ShellPlastic steel{7850, 210e9, 0.3, {}, 0, 0.02};
  const double strain[] = {0, 1}, stress[] = {200e6, 200e6};
  steel.yield = YieldStress(HardeningCurve(strain, stress));
  const auto pull = [&](double lower, double upper) {
    const Plate square{1, 1};
    const Model model = plate_model(square, fully_integrated(uniform_section(steel, 1e-3, 2)));
    PlateMotion motion = still(model);
    motion.displacement[square.node(1, 0)].x() = lower;
    motion.displacement[square.node(1, 1)].x() = upper;
    const NodalLoads loads = loads_after(model, motion);
    return -loads.force[square.node(1, 0)].x() - loads.force[square.node(1, 1)].x();
  };
  // at the points beside a side: 0.79 of its strain and 0.21 of the other's
  const double whole = pull(0.008, 0.016);
  EXPECT_NEAR(pull(0.008, 0.032), 0.5 * whole, 0.05 * whole);
  EXPECT_EQ(pull(0.032, 0.032), 0);
}

TEST(ShellSection, RulesIntegrateBendingExactly) {
  auto second_moment = [](const ShellSection& section) {
    double sum = 0;
    for (const ShellPoint& p : section.layers[0].points) sum += p.weight * p.position * p.position;
    return sum;
  };
  for (int points = 2; points <= 5; ++points)
    EXPECT_NEAR(second_moment(uniform_section(kGlass, 1, points)), 1.0 / 12, 1e-15);
  for (int points = 3; points <= 10; ++points)
    EXPECT_NEAR(second_moment(uniform_section(kGlass, 1, points, ThicknessRule::Lobatto)), 1.0 / 12,
                1e-15);
}

TEST(ShellSection, BondedLaminateHasTheBendingStiffnessOfTheSum) {
  const ShellElastic core{1100, 1, 0};  // as good as nothing
  const double t = 2.1e-3, core_t = 0.76e-3;
  const ShellSection section = laminate({{kGlass, t, 2}, {core, core_t, 1}, {kGlass, t, 2}});
  EXPECT_NEAR(section.density() * section.thickness, 11.336, 1e-3);
  double stiffness = 0;
  for (const ShellLayer& layer : section.layers)
    for (const ShellPoint& p : layer.points) {
      const double E = std::get<ShellElastic>(layer.law).youngs_modulus;
      stiffness += p.weight * section.thickness * E / (1 - kPoisson * kPoisson) *
                   std::pow(p.position * section.thickness, 2);
    }
  // E ((2 t + c)^3 - c^3) / 12 (1 - nu^2)
  EXPECT_NEAR(stiffness, 748.9 - 0.0, 3.0);
}

// A square's hourglass mode is orthogonal to every load of constant stress, so the projection on it
// is the control's load alone.
TEST(ShellHourglass, ControlOfAPaneFallsWithItsCracks) {
  const auto control_load = [](GlassFracture fracture, const Vec3& stretch) {
    const ShellGlass glass{.density = 2500,
                           .youngs_modulus = kYoungs,
                           .poisson_ratio = kPoisson,
                           .strength = 50e6,
                           .fracture = fracture};
    const ShellElastic film{1100, 0.28e9, 0.45};
    const Plate square{.nx = 1, .ny = 1, .length = 0.01, .width = 0.01};
    const Model model =
        plate_model(square, laminate({{glass, 2e-3, 2}, {film, 1e-3, 1}, {glass, 2e-3, 2}}));
    PlateMotion motion = still(model);
    double load = 0;
    const int corners[] = {square.node(0, 0), square.node(1, 0), square.node(1, 1),
                           square.node(0, 1)};
    for (int i = 0; i < 4; ++i)
      motion.displacement[corners[i]] = stretch.cwiseProduct(model.mesh.position[corners[i]]) +
                                        Vec3(i % 2 == 0 ? 1e-6 : -1e-6, 0, 0);
    const NodalLoads loads = loads_after(model, motion);
    for (int i = 0; i < 4; ++i) load += (i % 2 == 0 ? 1 : -1) * loads.force[corners[i]].x();
    return load;
  };
  const Vec3 one_way(1e-3, -0.23e-3, 0), both_ways(1e-3, 1e-3, 0);
  const double film = 0.28e9 / (0.28e9 + 4 * kYoungs);
  const double whole = control_load(GlassFracture::Off, one_way);
  EXPECT_LT(whole, 0);
  EXPECT_NEAR(control_load(GlassFracture::Local, one_way) / whole, film + 0.5 * (1 - film), 1e-9);
  EXPECT_NEAR(
      control_load(GlassFracture::Local, both_ways) / control_load(GlassFracture::Off, both_ways),
      film, 1e-9);
}

}  // namespace
}  // namespace crosswalk::fe
