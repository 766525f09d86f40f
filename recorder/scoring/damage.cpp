// DAMAGE: the driven oscillator of brain_injury.h, integrated by SUNDIALS CVODE.
#include <algorithm>
#include <cmath>
#include <memory>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "common/damage_constants.h"
#include "common/error.h"
#include "recorder/scoring/brain_injury.h"

namespace crosswalk::recording {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kRelativeTolerance = 1e-9;
constexpr double kAbsoluteTolerance = 1e-12;  // m, m/s; peaks are of order 0.1 m

Mat3 stiffness() {
  constexpr double kXz = damage::kStiffnessXZ;
  Mat3 K = Vec3(damage::kStiffness.data()).asDiagonal();
  K(0, 0) += kXz;
  K(2, 2) += kXz;
  K(0, 2) = K(2, 0) = -kXz;
  return K;
}

/// State (d, d') with unit masses; alpha is linear from `from` to `to` over [t0, t1].
struct Oscillator {
  Matrix6 A = Matrix6::Zero();
  double t0 = 0, t1 = 0;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();

  Oscillator() {
    const Mat3 K = stiffness();
    A.topRightCorner<3, 3>() = Mat3::Identity();
    A.bottomLeftCorner<3, 3>() = -K;
    A.bottomRightCorner<3, 3>() = -damage::kStiffnessDamping * K;
  }
};

int rate(realtype t, N_Vector y, N_Vector ydot, void* data) {
  const auto& o = *static_cast<Oscillator*>(data);
  const Eigen::Map<const Vec6> state(NV_DATA_S(y));
  Eigen::Map<Vec6> dot(NV_DATA_S(ydot));
  const double share = (t - o.t0) / (o.t1 - o.t0);
  dot = o.A * state;
  dot.tail<3>() += o.from + share * (o.to - o.from);
  return 0;
}

int jacobian(realtype /*t*/, N_Vector /*y*/, N_Vector /*fy*/, SUNMatrix J, void* data, N_Vector,
             N_Vector, N_Vector) {
  const auto& o = *static_cast<Oscillator*>(data);
  for (int column = 0; column < 6; ++column) {
    for (int row = 0; row < 6; ++row) SM_ELEMENT_D(J, row, column) = o.A(row, column);
  }
  return 0;
}

/// SUNDIALS handles, freed in the right order.
class Integrator {
 public:
  Integrator(Oscillator& oscillator, double t0) {
    check(SUNContext_Create(nullptr, &context_));
    state_ = N_VNew_Serial(6, context_);
    N_VConst(0.0, state_);
    matrix_ = SUNDenseMatrix(6, 6, context_);
    solver_ = SUNLinSol_Dense(state_, matrix_, context_);
    cvode_ = CVodeCreate(CV_BDF, context_);
    check(CVodeInit(cvode_, rate, t0, state_));
    check(CVodeSStolerances(cvode_, kRelativeTolerance, kAbsoluteTolerance));
    check(CVodeSetUserData(cvode_, &oscillator));
    check(CVodeSetLinearSolver(cvode_, solver_, matrix_));
    check(CVodeSetJacFn(cvode_, jacobian));
    check(CVodeSetMaxNumSteps(cvode_, 100000));
  }
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  ~Integrator() {
    CVodeFree(&cvode_);
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    N_VDestroy(state_);
    SUNContext_Free(&context_);
  }

  Vec3 advance(double t) {
    check(CVodeSetStopTime(cvode_, t));
    double reached = 0;
    check(CVode(cvode_, t, state_, &reached, CV_NORMAL));
    return Eigen::Map<const Vec3>(NV_DATA_S(state_));
  }

 private:
  static void check(int flag) {
    if (flag < 0) throw NumericalError(0, "DAMAGE: CVODE failed with flag " + std::to_string(flag));
  }
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  void* cvode_ = nullptr;
};

}  // namespace

Damage damage(const VectorSeries& alpha) {
  require_valid(alpha.t, alpha.x, "angular acceleration x");
  require_valid(alpha.t, alpha.y, "angular acceleration y");
  require_valid(alpha.t, alpha.z, "angular acceleration z");
  const auto at = [&alpha](std::size_t i) { return Vec3(alpha.x[i], alpha.y[i], alpha.z[i]); };
  Oscillator oscillator;
  oscillator.t0 = alpha.t[0];
  oscillator.t1 = alpha.t[1];
  oscillator.from = at(0);
  oscillator.to = at(1);
  Integrator integrator(oscillator, alpha.t[0]);
  Damage result;
  result.time = alpha.t[0];
  for (std::size_t i = 1; i < alpha.t.size(); ++i) {
    oscillator.t0 = alpha.t[i - 1];
    oscillator.t1 = alpha.t[i];
    oscillator.from = at(i - 1);
    oscillator.to = at(i);
    const Vec3 d = damage::kScale * integrator.advance(alpha.t[i]);
    result.x = std::max(result.x, std::abs(d.x()));
    result.y = std::max(result.y, std::abs(d.y()));
    result.z = std::max(result.z, std::abs(d.z()));
    if (d.norm() > result.value) {
      result.value = d.norm();
      result.time = alpha.t[i];
    }
  }
  return result;
}

}  // namespace crosswalk::recording
