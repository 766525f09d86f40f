#include "mb_node/marker_fit.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "common/error.h"
#include "common/units.h"
#include "mb_node/joint_law.h"
#include "mb_node/posture.h"

namespace crosswalk::mb {
namespace {

constexpr double kTurn = 20 * kDegree;   // sigma of a joint's turn from the given posture [E]
constexpr double kBeyond = 2 * kDegree;  // sigma of an angle beyond the free range [E]
constexpr double kDifference = 1e-6;     // m or rad: step of the numerical Jacobian
constexpr int kIterations = 200;

/// Joints that move: no bones, sliders, girdles, fingers and toes.
bool is_fitted(const std::string& name) {
  for (const char* stem : {"lumbar_", "torso_", "neck_", "head", "upper_arm", "forearm_", "hand",
                           "femur_1", "tibia_1", "talus", "hindfoot"}) {
    if (name.starts_with(stem)) return true;
  }
  return false;
}

class Problem {
 public:
  Problem(const BodyDescription& body, const std::vector<Marker>& markers,
          const std::vector<Mat3>& start, const Vec3& pelvis)
      : body_(body), markers_(markers), start_(start), pelvis_(pelvis) {
    for (std::size_t i = 1; i < body.segments.size(); ++i) {
      if (!is_fitted(body.segments[i].name)) continue;
      for (const int axis : axes_of(body.segments[i].joint)) {
        turns_.push_back({static_cast<int>(i), axis});
      }
    }
    for (const Marker& m : markers) segments_.push_back(body.find_segment(m.body));
  }

  Eigen::Index unknowns() const { return 6 + static_cast<Eigen::Index>(turns_.size()); }

  /// u: shift and turn of the pelvis, then one angle per turn.
  std::vector<Mat3> rotations(const Eigen::VectorXd& u) const {
    std::vector<Mat3> R = start_;
    R[0] = exp_rotation(u.segment<3>(3)).toRotationMatrix() * start_[0];
    for (std::size_t k = 0; k < turns_.size();) {
      const int segment = turns_[k].segment;
      Vec3 turn = Vec3::Zero();
      for (; k < turns_.size() && turns_[k].segment == segment; ++k) {
        turn[turns_[k].axis] = u[6 + static_cast<Eigen::Index>(k)];
      }
      R[segment] = body_.segments[segment].joint == JointType::UniversalXY
                       ? Mat3(start_[segment] * about(0, turn.x()) * about(1, turn.y()))
                       : Mat3(start_[segment] * exp_rotation(turn).toRotationMatrix());
    }
    return R;
  }

  std::vector<Vec3> points(const Eigen::VectorXd& u) const {
    const std::vector<Pose> X_WB = place_segments(body_, rotations(u), pelvis_ + Vec3(u.head<3>()));
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < markers_.size(); ++i) {
      const Segment& s = body_.segments[segments_[i]];
      points.push_back(X_WB[segments_[i]] * Vec3(s.joint_centre + markers_[i].offset - s.com));
    }
    return points;
  }

  Eigen::VectorXd residual(const Eigen::VectorXd& u) const {
    std::vector<double> r;
    const std::vector<Vec3> at = points(u);
    for (std::size_t i = 0; i < markers_.size(); ++i) {
      const Vec3 miss = (at[i] - markers_[i].position) / markers_[i].sigma;
      r.insert(r.end(), miss.data(), miss.data() + 3);
    }
    for (std::size_t k = 0; k < turns_.size(); ++k) {
      r.push_back(u[6 + static_cast<Eigen::Index>(k)] / kTurn);
    }
    const std::vector<Mat3> R = rotations(u);
    for (std::size_t k = 0; k < turns_.size(); ++k) {
      const int i = turns_[k].segment;
      if (k > 0 && turns_[k - 1].segment == i) continue;
      const Segment& s = body_.segments[i];
      const Vec3 angle =
          joint_motion(s.joint, s.restraint.frame, Mat3::Identity(), R[i], Vec3::Zero()).angle;
      for (int c = 0; c < 3; ++c) {
        const CoordinateLaw& law = s.restraint.angle[c];
        r.push_back(std::max({0.0, angle[c] - law.max, law.min - angle[c]}) / kBeyond);
      }
    }
    return Eigen::Map<Eigen::VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& u) const {
    Eigen::MatrixXd J(residual(u).size(), u.size());
    for (Eigen::Index k = 0; k < u.size(); ++k) {
      Eigen::VectorXd ahead = u, behind = u;
      ahead[k] += kDifference;
      behind[k] -= kDifference;
      J.col(k) = (residual(ahead) - residual(behind)) / (2 * kDifference);
    }
    return J;
  }

  std::exception_ptr failure;

 private:
  struct Turn {
    int segment, axis;
  };
  static Mat3 about(int axis, double angle) {
    return exp_rotation(Vec3::Unit(axis) * angle).toRotationMatrix();
  }
  static std::vector<int> axes_of(JointType joint) {
    switch (joint) {
      case JointType::Ball:
        return {0, 1, 2};
      case JointType::UniversalXY:
        return {0, 1};
      case JointType::HingeX:
        return {0};
      case JointType::HingeY:
        return {1};
      case JointType::HingeZ:
        return {2};
      case JointType::SliderY:
      case JointType::Free:
        break;
    }
    return {};
  }

  const BodyDescription& body_;
  const std::vector<Marker>& markers_;
  const std::vector<Mat3>& start_;
  Vec3 pelvis_;
  std::vector<Turn> turns_;
  std::vector<int> segments_;  ///< by marker
};

Eigen::Map<const Eigen::VectorXd> values(N_Vector v, Eigen::Index n) {
  return {N_VGetArrayPointer(v), n};
}

// KINSOL's callbacks: nothing may be thrown through its C code; a negative value ends it.
int gradient(N_Vector u, N_Vector f, void* user_data) {
  auto& problem = *static_cast<Problem*>(user_data);
  try {
    const Eigen::VectorXd x = values(u, problem.unknowns());
    Eigen::Map<Eigen::VectorXd>(N_VGetArrayPointer(f), x.size()) =
        problem.jacobian(x).transpose() * problem.residual(x);
    return 0;
  } catch (...) {
    problem.failure = std::current_exception();
    return -1;
  }
}

int gauss_newton(N_Vector u, N_Vector, SUNMatrix J, void* user_data, N_Vector, N_Vector) {
  auto& problem = *static_cast<Problem*>(user_data);
  try {
    const Eigen::VectorXd x = values(u, problem.unknowns());
    const Eigen::MatrixXd A = problem.jacobian(x);
    Eigen::Map<Eigen::MatrixXd>(SUNDenseMatrix_Data(J), x.size(), x.size()) = A.transpose() * A;
    return 0;
  } catch (...) {
    problem.failure = std::current_exception();
    return -1;
  }
}

void ignore_message(int, const char*, const char*, char*, void*) {}  // the markers' distances tell

Eigen::VectorXd solve(Problem& problem) {
  const sundials::Context context;
  const Eigen::Index n = problem.unknowns();
  const auto vector_of = [&](double value) {
    N_Vector v = N_VNew_Serial(n, context);
    N_VConst(value, v);
    return std::unique_ptr<_generic_N_Vector, void (*)(N_Vector)>(v, N_VDestroy);
  };
  const auto u = vector_of(0), scale = vector_of(1);
  const std::unique_ptr<_generic_SUNMatrix, void (*)(SUNMatrix)> matrix(
      SUNDenseMatrix(n, n, context), SUNMatDestroy);
  const std::unique_ptr<_generic_SUNLinearSolver, int (*)(SUNLinearSolver)> linear(
      SUNLinSol_Dense(u.get(), matrix.get(), context), SUNLinSolFree);
  void* kinsol = KINCreate(context);
  CW_ASSERT(kinsol != nullptr);
  const auto free_kinsol = [](void* p) { KINFree(&p); };
  const std::unique_ptr<void, decltype(free_kinsol)> owner(kinsol, free_kinsol);
  CW_ASSERT(KINInit(kinsol, gradient, u.get()) == KIN_SUCCESS);
  CW_ASSERT(KINSetLinearSolver(kinsol, linear.get(), matrix.get()) == KIN_SUCCESS);
  CW_ASSERT(KINSetJacFn(kinsol, gauss_newton) == KIN_SUCCESS);
  KINSetUserData(kinsol, &problem);
  KINSetErrHandlerFn(kinsol, ignore_message, nullptr);
  KINSetNumMaxIters(kinsol, kIterations);
  KINSetMaxSetupCalls(kinsol, 1);  // a new matrix at every iterate
  KINSetMaxNewtonStep(kinsol, 10);
  KINSetFuncNormTol(kinsol, 1e-4);
  KINSetScaledStepTol(kinsol, 1e-10);
  KINSol(kinsol, u.get(), KIN_LINESEARCH, scale.get(), scale.get());
  if (problem.failure) std::rethrow_exception(problem.failure);
  return values(u.get(), n);
}

}  // namespace

std::vector<Marker> read_markers(ConfigTable posture) {
  std::vector<Marker> markers;
  for (ConfigTable& table : posture.tables("marker", "a point of the body and where it was seen")) {
    Marker m;
    m.name = table.text("name", "name in reports");
    m.body = table.text("body", "body it is fixed to, such as `femur_4_r`");
    const auto vector = [&](const char* name, const char* doc) {
      const std::vector<double> v = table.quantities(name, Dimension::Length, 3, doc);
      return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : Vec3(Vec3::Zero());
    };
    m.offset = vector("offset", "from the body's joint centre, axes of the erect posture");
    m.position = vector("position", "where it was seen: forward, left, above the ground");
    m.sigma = table.quantity_or("sigma", Dimension::Length, kPositive, 0.01, "its uncertainty");
    markers.push_back(m);
  }
  return markers;
}

MarkerFit fit_markers(const BodyDescription& body, const std::vector<Marker>& markers,
                      const std::vector<Mat3>& start, const Vec3& pelvis) {
  for (const Marker& m : markers) {
    if (body.find_segment(m.body) >= 0) continue;
    std::vector<std::string> names;
    for (const Segment& s : body.segments) names.push_back(s.name);
    const std::string near = did_you_mean(m.body, names);
    throw UserError({{},
                     "posture.marker " + m.name,
                     "a body of the pedestrian",
                     "`" + m.body + "`",
                     near.empty() ? "" : "did you mean `" + near + "`?"});
  }
  Problem problem(body, markers, start, pelvis);
  const Eigen::VectorXd u = solve(problem);
  MarkerFit fit{pelvis + Vec3(u.head<3>()), problem.rotations(u), {}};
  const std::vector<Vec3> at = problem.points(u);
  for (std::size_t i = 0; i < markers.size(); ++i) {
    fit.miss.push_back(at[i] - markers[i].position);
    if (fit.miss.back().norm() <= kUnmetMarker) continue;
    throw UserError({{},
                     "posture.marker " + markers[i].name,
                     fmt::format("a place within {:.0f} mm of a posture that suits all markers",
                                 1e3 * kUnmetMarker),
                     fmt::format("{:.1f} mm away", 1e3 * fit.miss.back().norm()),
                     "check position_mm, and offset_mm from the joint centre"});
  }
  return fit;
}

}  // namespace crosswalk::mb
