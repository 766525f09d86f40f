#include "fe_node/material/solid_law.h"

#include <gtest/gtest.h>

#include "tests/fe_node/material/law_suite.h"

namespace crosswalk::fe {
namespace {

constexpr double kE = 200e9, kNu = 0.3, kG = 0.5 * kE / (1 + kNu), kK = kE / (3 * (1 - 2 * kNu));

Plastic steel() {
  Plastic law{7850, kK, kG, {}, 0, 0};
  const double strain[] = {0, 0.02, 0.1}, stress[] = {200e6, 260e6, 300e6};
  law.yield = YieldStress(HardeningCurve(strain, stress));
  return law;
}
Viscoelastic overstress() {
  Viscoelastic terms;
  terms.terms[0] = {800, 6};
  terms.terms[1] = {1800, 50};
  terms.term_count = 2;
  return terms;
}
Ogden scalp() {
  Ogden law;
  law.density = 1100;
  law.mu = {35, 500};
  law.alpha = {20, -3};
  law.mu[1] = -500;
  law.term_count = 2;
  law.overstress = overstress();
  law.bulk = bulk_from_poisson(law.shear_modulus(), 0.499);
  return law;
}
Rubber tyre() {
  Rubber law;
  law.density = 1200;
  law.c10 = 0.4e6, law.c01 = 0.1e6, law.c11 = 0.01e6, law.c20 = 0.02e6, law.c02 = 0.003e6,
  law.c30 = 0.005e6;
  law.bulk = 50e6;
  return law;
}
Foam padding() {
  Foam law;
  law.density = 60;
  law.tension_modulus = 1e6;
  const double x[] = {0, 0.1, 0.5, 0.7, 0.9}, y[] = {0, 0.1e6, 0.2e6, 0.6e6, 5e6};
  law.curve = LaneCurve(x, y);
  return law;
}

TEST(SolidLaws, ElasticHasEveryProperty) { expect_law(Elastic::from_young(7850, kE, kNu)); }
TEST(SolidLaws, ViscoelasticHasEveryProperty) {
  expect_law(Viscoelastic::from_single_term(1040, 2.19e6, 6e3, 1.2e3, 80));
}
// p = K/2 (1/J - J), however far the volume is squeezed out; the logarithm and its series meet.
TEST(Viscoelastic, PressureGrowsWithoutBoundAsTheVolumeVanishes) {
  const Viscoelastic law = Viscoelastic::from_single_term(1000, 20e6, 30e3, 10e3, 100);
  for (const double J : {1.2, 1.005, 0.999, 0.9, 0.5, 0.1, 0.01}) {
    MaterialPoint<Viscoelastic> point(law);
    point.move_to(std::cbrt(J) * Mat3::Identity(), 1e-6);
    EXPECT_NEAR(-point.cauchy().trace() / 3, 10e6 * (1 / J - J), 1e-6 * 20e6 / J) << J;
    EXPECT_NEAR(point.answer().energy, 10e6 * (0.5 * (J * J - 1) - std::log(J)), 1e-9 * 20e6 / J)
        << J;
    EXPECT_NEAR(point.answer().bulk_modulus, 10e6 * (1 / J + J), 1) << J;
  }
  for (const double J : {1 - kNearOne, 1 + kNearOne})
    EXPECT_NEAR(volume_energy_near_one(J) / (0.5 * (J * J - 1) - std::log(J)), 1, 1e-10);
}

TEST(SolidLaws, PlasticHasEveryProperty) {
  LawTraits traits;
  traits.has_energy = false;  // rate form: exact only along the path
  expect_law(steel(), traits);
  Plastic mixed = steel();
  mixed.kinematic_modulus = 1e9;
  expect_law(mixed, traits);
  traits.size = 0.001;  // elastic range
  expect_law(steel(), traits);
}
TEST(SolidLaws, OgdenHasEveryProperty) {
  expect_law(scalp());
  LawTraits large;
  large.size = 8;
  expect_stress_is_energy_slope(scalp(), large);
  expect_wave_speed_bound(scalp(), large);
}
TEST(SolidLaws, RubberHasEveryProperty) {
  expect_law(tyre());
  LawTraits large;
  large.size = 8;
  expect_stress_is_energy_slope(tyre(), large);
  expect_wave_speed_bound(tyre(), large);
}
TEST(SolidLaws, FoamHasEveryProperty) {
  expect_law(padding());
  LawTraits large;
  large.size = 8;
  expect_stress_is_energy_slope(padding(), large);
  Foam lossy = padding();
  lossy.unloading_share = 0.2;
  lossy.shape = 2;
  expect_energy_is_work(lossy, {});
}
TEST(SolidLaws, FluidHasEveryProperty) {
  expect_law(Fluid{1000, 2.19e9, 500, 0, 1e30});
  expect_energy_is_work(Fluid{1000, 2.19e6, 500, 0.01, 1e30}, {});
}

TEST(Plastic, TensionFollowsTheCurveInTrueStress) {
  MaterialPoint<Plastic> point(steel());
  for (int i = 1; i <= 200; ++i) point.pull_to(std::exp(0.08 * i / 200), 1e-6);
  const double p = point.history(Plastic::kPlasticStrain), sigma = point.cauchy()(0, 0);
  EXPECT_NEAR(sigma, 260e6 + (p - 0.02) * 500e6, 1e-4 * sigma);
  EXPECT_NEAR(p, 0.08 - sigma / kE, 1e-5);
  EXPECT_LT(std::abs(point.cauchy()(1, 1)), 1e-4 * sigma);
}

TEST(Plastic, CompressionYieldsAtTheSameStress) {
  MaterialPoint<Plastic> point(steel());
  for (int i = 1; i <= 100; ++i) point.pull_to(std::exp(-0.05 * i / 100), 1e-6);
  const double p = point.history(Plastic::kPlasticStrain);
  EXPECT_NEAR(point.cauchy()(0, 0), -(260e6 + (p - 0.02) * 500e6), 1e-4 * 300e6);
}

TEST(Plastic, ShearYieldsAtMisesStress) {
  MaterialPoint<Plastic> point(steel());
  Mat3 F = Mat3::Identity();
  F(0, 1) = 0.02;
  point.go_to(F, 1e-4, 200);
  const double p = point.history(Plastic::kPlasticStrain);
  EXPECT_NEAR(std::sqrt(3.0) * point.cauchy()(0, 1), 200e6 + 3e9 * p, 1e-3 * 250e6);
}

TEST(Plastic, PressureNeverYields) {
  MaterialPoint<Plastic> point(steel());
  point.go_to(0.9 * Mat3::Identity(), 1e-4, 50);
  EXPECT_EQ(point.history(Plastic::kPlasticStrain), 0);
  EXPECT_NEAR(point.cauchy()(0, 0), kK * 3 * std::log(0.9), 1e-9 * kK);
}

TEST(Plastic, KinematicHardeningKeepsTheWidthOfTheElasticRange) {
  Plastic law = steel();
  law.yield = YieldStress(HardeningCurve::linear(200e6, 0));
  law.kinematic_modulus = 2e9;
  MaterialPoint<Plastic> point(law);
  Mat3 F = Mat3::Identity();
  F(0, 1) = 0.03;
  point.go_to(F, 1e-4, 300);
  const double top = point.cauchy()(0, 1), p = point.history(0);
  EXPECT_NEAR(std::sqrt(3.0) * top, 200e6 + 2e9 * p, 2e-3 * 200e6);
  double gamma = 0.03, reverse = top;
  while (gamma > 0) {
    gamma -= 2e-5;
    F(0, 1) = gamma;
    const double before = point.cauchy()(0, 1);
    point.move_to(F, 1e-6);
    if (before - point.cauchy()(0, 1) < 0.5 * kG * 2e-5) break;
    reverse = point.cauchy()(0, 1);
  }
  EXPECT_NEAR(std::sqrt(3.0) * (top - reverse), 2 * 200e6, 0.01 * 400e6);
}

TEST(Plastic, FailsForGoodAtItsStrain) {
  Plastic law = steel();
  law.failure_strain = 0.02;
  MaterialPoint<Plastic> point(law);
  for (int i = 1; i <= 100; ++i) point.pull_to(1 + 0.04 * i / 100, 1e-6);
  EXPECT_EQ(point.answer().alive, 0);
  EXPECT_EQ(point.nominal().norm(), 0);
  point.move_to(0.9 * Mat3::Identity(), 1e-6);
  EXPECT_EQ(point.nominal().norm(), 0);
}

// Incompressible tension: nominal stress sum mu_i (l^(a_i - 1) - l^(-a_i/2 - 1)).
TEST(Ogden, IncompressibleTensionHasItsClosedForm) {
  Ogden law = scalp();
  law.overstress = {};
  law.bulk = 1e5 * law.shear_modulus();
  for (double stretch : {0.8, 1.1, 1.3}) {
    MaterialPoint<Ogden> point(law);
    double exact = 0;
    for (int i = 0; i < law.term_count; ++i)
      exact += law.mu[i] *
               (std::pow(stretch, law.alpha[i] - 1) - std::pow(stretch, -0.5 * law.alpha[i] - 1));
    EXPECT_NEAR(point.pull_to(stretch, 1e-6), exact, 2e-3 * std::abs(exact));
  }
}

TEST(Rubber, MooneyRivlinTensionAndShearHaveTheirClosedForms) {
  Rubber law;
  law.density = 1200;
  law.c10 = 0.4e6;
  law.c01 = 0.1e6;
  law.bulk = 1e5 * law.shear_modulus();
  for (double l : {0.7, 1.5, 2.0}) {
    MaterialPoint<Rubber> point(law);
    const double exact = 2 * (l - 1 / (l * l)) * (law.c10 + law.c01 / l);
    EXPECT_NEAR(point.pull_to(l, 1e-6), exact, 2e-3 * std::abs(exact));
  }
  MaterialPoint<Rubber> point(law);
  Mat3 F = Mat3::Identity();
  F(0, 1) = 0.5;
  point.move_to(F, 1e-6);
  EXPECT_NEAR(point.cauchy()(0, 1), 2 * (law.c10 + law.c01) * 0.5, 1e-9 * 1e6);
}

TEST(Ogden, OverstressRelaxesByItsSeries) {
  Ogden law = scalp();
  MaterialPoint<Ogden> point(law), slow(law);
  Mat3 F = Mat3::Identity();
  F(0, 1) = 1e-3;
  point.move_to(F, 1e-9);
  for (int i = 0; i < 1000; ++i) point.move_to(F, 1e-5);
  double G = 0.5 * (35 * 20 + 500 * 3);
  G += 800 * std::exp(-6 * 0.01) + 1800 * std::exp(-50 * 0.01);
  EXPECT_NEAR(point.cauchy()(0, 1), G * 1e-3, 1e-3 * G * 1e-3);
}

TEST(Foam, CompressionFollowsTheCurveWithoutLateralStress) {
  MaterialPoint<Foam> point(padding());
  point.move_to(Vec3(0.4, 1, 1).asDiagonal(), 1e-6);
  EXPECT_NEAR(point.nominal()(0, 0), -0.4e6, 1);
  EXPECT_NEAR(point.nominal()(1, 1), 0, 1e-6);
  MaterialPoint<Foam> pulled(padding());
  pulled.move_to(Vec3(1.2, 1, 1).asDiagonal(), 1e-6);
  EXPECT_NEAR(pulled.nominal()(0, 0), 0.2e6, 1);
}

TEST(Foam, UnloadingReturnsOnlyAShareOfTheWork) {
  Foam law = padding();
  law.unloading_share = 0.1;
  law.shape = 5;
  MaterialPoint<Foam> point(law);
  point.go_to(Vec3(0.3, 1, 1).asDiagonal(), 1e-3, 500);
  const double put_in = point.answer().energy;
  const double x[] = {0, 0.1, 0.5, 0.7}, y[] = {0, 0.1e6, 0.2e6, 0.6e6};
  EXPECT_NEAR(put_in, LaneCurve(x, y).integral(0.7), 1e-3 * put_in);
  point.go_to(Mat3::Identity(), 1e-3, 500);
  // returned: integral of h + (1 - h) w^5 over w in 0..1 = 0.1 + 0.9 / 6
  EXPECT_NEAR(point.answer().energy / put_in, 1 - (0.1 + 0.9 / 6), 0.01);
}

TEST(Fluid, CavitatesAndFlows) {
  const Fluid law{1000, 2e9, 0, 0.5, 1e5};
  MaterialPoint<Fluid> point(law);
  point.move_to(1.01 * Mat3::Identity(), 0);
  EXPECT_NEAR(point.cauchy()(0, 0), 1e5, 1);
  MaterialPoint<Fluid> sheared(law);
  Mat3 F = Mat3::Identity();
  F(0, 1) = 1e-3;
  sheared.move_to(F, 1e-4);  // 10 / s
  EXPECT_NEAR(sheared.cauchy()(0, 1), 0.5 * 10, 1e-2);
}

}  // namespace
}  // namespace crosswalk::fe
