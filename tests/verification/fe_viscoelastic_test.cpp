// Prony relaxation and creep-free rotation of the viscoelastic law.
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "common/spatial.h"
#include "fe_node/material/viscoelastic.h"

namespace crosswalk::fe {
namespace {

SolidStep<double> step_to(const Mat3& before, const Mat3& after, double dt) {
  SolidStep<double> step;
  const Mat3 back = after.inverse();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      step.F(i, j) = after(i, j);
      step.F_inverse(i, j) = back(i, j);
      step.F_rate(i, j) = dt > 0 ? (after(i, j) - before(i, j)) / dt : 0;
    }
  step.J = after.determinant();
  step.dt = dt;
  return step;
}

Viscoelastic brain() { return Viscoelastic::from_single_term(1040, 2.19e9, 6e3, 1.2e3, 80); }

// sigma_xy = gamma G(t) after a step in shear [ferry1980, 1.B].
TEST(Viscoelastic, ShearStressRelaxesAlongTheProny) {
  const Viscoelastic law = brain();
  double history[7];
  law.initialise(history);
  Mat3 sheared = Mat3::Identity();
  sheared(0, 1) = 0.01;
  const double dt = 2e-6;
  law.update(step_to(Mat3::Identity(), sheared, dt), history);
  double time = 0;
  for (int i = 0; i < 30000; ++i) {
    const SolidStep<double> step = step_to(sheared, sheared, dt);
    const SolidAnswer<double> answer = law.update(step, history);
    time += dt;
    if (i % 5000 == 0) {
      const double G = 1.2e3 + 4.8e3 * std::exp(-80 * time);
      EXPECT_NEAR(cauchy_stress(answer.P, step.F, step.J).xy, 0.01 * G, 1e-3 * 0.01 * G);
    }
  }
  EXPECT_GT(time, 0.05);
}

// Small harmonic shear: storage and loss modulus of the Maxwell element; the work per cycle is
// pi G'' gamma^2 and is what the energy book shows.
TEST(Viscoelastic, HarmonicShearDissipatesTheLossModulus) {
  const Viscoelastic law = brain();
  double history[7];
  law.initialise(history);
  constexpr double kAmplitude = 0.01, kOmega = 100;
  const int steps = 20000;
  const double dt = 2 * M_PI / kOmega / steps;
  Mat3 before = Mat3::Identity(), after = before;
  double work[3] = {0, 0, 0};
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (int i = 1; i <= steps; ++i) {
      after(0, 1) = kAmplitude * std::sin(2 * M_PI * i / steps);
      work[cycle] = law.update(step_to(before, after, dt), history).energy;
      before = after;
    }
  }
  const double loss = 4.8e3 * kOmega * 80 / (kOmega * kOmega + 80 * 80);
  EXPECT_NEAR(work[2] - work[1], M_PI * loss * kAmplitude * kAmplitude,
              0.01 * M_PI * loss * kAmplitude * kAmplitude);
}

TEST(Viscoelastic, FiniteRotationAfterStrainTurnsTheStressOnly) {
  const Viscoelastic law = brain();
  double history[7];
  law.initialise(history);
  Mat3 F;
  F << 1.1, 0.2, 0, 0, 0.95, 0.1, 0.05, 0, 0.97;
  law.update(step_to(Mat3::Identity(), F, 1e-4), history);
  const SolidStep<double> still = step_to(F, F, 0);
  const Symmetric<double> s = cauchy_stress(law.update(still, history).P, still.F, still.J);
  const Mat3 R = exp_rotation({0.4, 1.2, -2}).toRotationMatrix();
  const SolidStep<double> turned = step_to(R * F, R * F, 0);
  const Symmetric<double> t = cauchy_stress(law.update(turned, history).P, turned.F, turned.J);
  Mat3 sigma, rotated;
  sigma << s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz;
  rotated << t.xx, t.xy, t.zx, t.xy, t.yy, t.yz, t.zx, t.yz, t.zz;
  EXPECT_LT((rotated - R * sigma * R.transpose()).norm(), 1e-9 * sigma.norm());
}

}  // namespace
}  // namespace crosswalk::fe
