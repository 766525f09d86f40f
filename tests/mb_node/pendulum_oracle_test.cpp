// The driven double pendulum of the engine against its equations of motion in two angles,
// integrated by CVODE: another formulation and another integrator.
#include <array>
#include <cmath>
#include <memory>

#include <Eigen/Dense>
#include <cvode/cvode.h>
#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "common/units.h"
#include "mb_node/ode_world.h"

namespace crosswalk::mb {
namespace {

constexpr double kMass1 = 3, kMass2 = 1.2;             // kg
constexpr double kInertia1 = 0.02, kInertia2 = 0.006;  // kg m2, about the centres of mass
constexpr double kArm1 = 0.2, kLength1 = 0.42;         // m: to the centre of mass, to the joint
constexpr double kArm2 = 0.15;                         // m
constexpr double kStart1 = 0.7, kStart2 = -0.4;        // rad from hanging
constexpr double kTorque = 6, kFrequency = 9;          // N m on the first body, rad/s
constexpr double kEnd = 0.6;                           // s

double drive(double t) { return kTorque * std::sin(kFrequency * t); }

/// y: both angles from hanging, then their rates.
int rates(realtype t, N_Vector y, N_Vector dot, void*) {
  const double* s = N_VGetArrayPointer(y);
  double* out = N_VGetArrayPointer(dot);
  const double d = s[0] - s[1], c = kMass2 * kLength1 * kArm2;
  Eigen::Matrix2d M;
  M << kInertia1 + kMass1 * kArm1 * kArm1 + kMass2 * kLength1 * kLength1, c * std::cos(d),
      c * std::cos(d), kInertia2 + kMass2 * kArm2 * kArm2;
  const double weight1 = (kMass1 * kArm1 + kMass2 * kLength1) * kStandardGravity;
  const Eigen::Vector2d force(
      drive(t) - c * std::sin(d) * s[3] * s[3] - weight1 * std::sin(s[0]),
      c * std::sin(d) * s[2] * s[2] - kMass2 * kArm2 * kStandardGravity * std::sin(s[1]));
  const Eigen::Vector2d acceleration = M.ldlt().solve(force);
  out[0] = s[2];
  out[1] = s[3];
  out[2] = acceleration[0];
  out[3] = acceleration[1];
  return 0;
}

Eigen::Vector2d by_cvode() {
  const sundials::Context context;
  const std::unique_ptr<_generic_N_Vector, void (*)(N_Vector)> y(N_VNew_Serial(4, context),
                                                                 N_VDestroy);
  N_VConst(0, y.get());
  N_VGetArrayPointer(y.get())[0] = kStart1;
  N_VGetArrayPointer(y.get())[1] = kStart2;
  const std::unique_ptr<_generic_SUNMatrix, void (*)(SUNMatrix)> matrix(
      SUNDenseMatrix(4, 4, context), SUNMatDestroy);
  const std::unique_ptr<_generic_SUNLinearSolver, int (*)(SUNLinearSolver)> linear(
      SUNLinSol_Dense(y.get(), matrix.get(), context), SUNLinSolFree);
  void* cvode = CVodeCreate(CV_ADAMS, context);
  EXPECT_EQ(CVodeInit(cvode, rates, 0, y.get()), CV_SUCCESS);
  EXPECT_EQ(CVodeSStolerances(cvode, 1e-11, 1e-12), CV_SUCCESS);
  EXPECT_EQ(CVodeSetLinearSolver(cvode, linear.get(), matrix.get()), CV_SUCCESS);
  EXPECT_EQ(CVodeSetMaxNumSteps(cvode, 100000), CV_SUCCESS);
  double reached = 0;
  EXPECT_EQ(CVode(cvode, kEnd, y.get(), &reached, CV_NORMAL), CV_SUCCESS);
  CVodeFree(&cvode);
  return {N_VGetArrayPointer(y.get())[0], N_VGetArrayPointer(y.get())[1]};
}

/// Angle of a body about y from hanging.
double angle_of(const OdeWorld& world, int body) {
  const Mat3 R = world.rotation(body);
  return std::atan2(R(0, 2), R(2, 2));
}

Eigen::Vector2d by_engine(Stepper stepper, double dt) {
  OdeWorld world(stepper, 100);
  const Quat q1 = exp_rotation({0, kStart1, 0}), q2 = exp_rotation({0, kStart2, 0});
  const Vec3 joint = q1 * Vec3(0, 0, -kLength1);
  world.add_body(kMass1, Vec3(kInertia1, kInertia1, kInertia1).asDiagonal(),
                 {q1, q1 * Vec3(0, 0, -kArm1)});
  world.add_body(kMass2, Vec3(kInertia2, kInertia2, kInertia2).asDiagonal(),
                 {q2, joint + q2 * Vec3(0, 0, -kArm2)});
  world.add_joint(JointKind::Hinge, -1, 0, Vec3::Zero(), Vec3::UnitY());
  world.add_joint(JointKind::Hinge, 0, 1, joint, Vec3::UnitY());
  world.set_gravity({0, 0, -kStandardGravity});
  const int steps = static_cast<int>(std::lround(kEnd / dt));
  for (int i = 0; i < steps; ++i) {
    world.add_torque(0, {0, drive(i * dt), 0});
    world.step(dt);
  }
  return {angle_of(world, 0), angle_of(world, 1)};
}

TEST(PendulumOracle, DrivenDoublePendulumAgreesAndConvergesAtFirstOrder) {
  const Eigen::Vector2d exact = by_cvode();
  EXPECT_GT((exact - Eigen::Vector2d(kStart1, kStart2)).norm(), 0.3) << "it has moved";
  for (const Stepper stepper : {Stepper::Direct, Stepper::Quick}) {
    const double coarse = (by_engine(stepper, 1e-4) - exact).norm();
    const double fine = (by_engine(stepper, 1e-5) - exact).norm();
    EXPECT_LT(fine, 3e-4);
    EXPECT_NEAR(coarse / fine, 10, 1.5);
  }
}

}  // namespace
}  // namespace crosswalk::mb
