#include "coupler/fixed_point.h"

#include <exception>
#include <limits>
#include <memory>

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>

#include "common/error.h"

namespace crosswalk::coupling {

namespace {

constexpr double kHopeless = 1e9;

struct Problem {
  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& G;
  const Eigen::VectorXd& scale;
  const FixedPointSettings& settings;
  FixedPoint result;
  std::exception_ptr failure;

  // A diverging iteration ends before its wrenches overflow a solver.
  bool is_over() const {
    return result.residual <= settings.tolerance || !(result.residual < kHopeless) ||
           result.evaluations >= settings.max_iterations;
  }
};

// KINSOL's callback: nothing may be thrown through its C code; a negative value ends it.
int evaluate(N_Vector u, N_Vector g, void* user_data) {
  auto& problem = *static_cast<Problem*>(user_data);
  const Eigen::Index n = problem.scale.size();
  try {
    problem.result.x = Eigen::Map<const Eigen::VectorXd>(N_VGetArrayPointer(u), n);
    const Eigen::VectorXd value = problem.G(problem.result.x);
    problem.result.residual =
        (value - problem.result.x).cwiseQuotient(problem.scale).cwiseAbs().maxCoeff();
    ++problem.result.evaluations;
    Eigen::Map<Eigen::VectorXd>(N_VGetArrayPointer(g), n) = value;
    return problem.is_over() ? -1 : 0;
  } catch (...) {
    problem.failure = std::current_exception();
    return -1;
  }
}

void ignore_message(int, const char*, const char*, char*, void*) {}  // the residual tells it all

}  // namespace

FixedPoint solve_fixed_point(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& G,
                             const Eigen::VectorXd& start, const Eigen::VectorXd& scale,
                             const FixedPointSettings& settings) {
  CW_ASSERT(start.size() == scale.size() && start.size() > 0);
  const sundials::Context context;
  const auto vector_of = [&](const Eigen::VectorXd& a) {
    N_Vector v = N_VNew_Serial(a.size(), context);
    Eigen::Map<Eigen::VectorXd>(N_VGetArrayPointer(v), a.size()) = a;
    return std::unique_ptr<_generic_N_Vector, void (*)(N_Vector)>(v, N_VDestroy);
  };
  const auto u = vector_of(start);
  const auto u_scale = vector_of(scale.cwiseInverse());
  Problem problem{G, scale, settings, {}, nullptr};

  void* kinsol = KINCreate(context);
  CW_ASSERT(kinsol != nullptr);
  const auto free_kinsol = [](void* p) { KINFree(&p); };
  const std::unique_ptr<void, decltype(free_kinsol)> owner(kinsol, free_kinsol);
  // KINSetMAA must come before KINInit in SUNDIALS 6.4.
  CW_ASSERT(KINSetMAA(kinsol, settings.anderson_depth) == KIN_SUCCESS);
  CW_ASSERT(KINInit(kinsol, evaluate, u.get()) == KIN_SUCCESS);
  KINSetUserData(kinsol, &problem);
  KINSetErrHandlerFn(kinsol, ignore_message, nullptr);
  // KINSOL would stop on a small change between accelerated iterates, which is not a small
  // residual; the callback ends the iteration instead.
  KINSetFuncNormTol(kinsol, std::numeric_limits<double>::min());
  KINSetNumMaxIters(kinsol, settings.max_iterations);
  KINSol(kinsol, u.get(), KIN_FP, u_scale.get(), u_scale.get());
  if (problem.failure) std::rethrow_exception(problem.failure);
  return problem.result;
}

Eigen::VectorXd wrench_scale(const Eigen::VectorXd& x) {
  Eigen::VectorXd scale(x.size());
  for (Eigen::Index i = 0; i + 6 <= x.size(); i += 6) {
    scale.segment<3>(i).setConstant(std::max(1.0, x.segment<3>(i).norm()));
    scale.segment<3>(i + 3).setConstant(std::max(0.05, x.segment<3>(i + 3).norm()));
  }
  return scale;
}

}  // namespace crosswalk::coupling
