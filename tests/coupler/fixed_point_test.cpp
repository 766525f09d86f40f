#include "coupler/fixed_point.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace crosswalk::coupling {
namespace {

TEST(FixedPoint, SolvesALinearContractionAndADivergentMap) {
  // x = A x + c; the second A has an eigenvalue of -3: plain iteration diverges, Anderson solves
  // it.
  for (const double eigenvalue : {0.5, -3.0}) {
    const Eigen::Matrix2d A = Eigen::Vector2d(eigenvalue, 0.2).asDiagonal();
    const Eigen::Vector2d c(1, 2);
    const Eigen::VectorXd exact = (Eigen::Matrix2d::Identity() - A).inverse() * c;
    const FixedPoint solved =
        solve_fixed_point([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return A * x + c; },
                          Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones(), {1e-10, 30, 5});
    EXPECT_LT(solved.residual, 1e-10);
    EXPECT_LT((solved.x - exact).norm(), 1e-9);
    EXPECT_LE(solved.evaluations, 8);
  }
}

TEST(FixedPoint, StopsAfterTheAllowedEvaluationsAndTellsTheResidual) {
  int calls = 0;
  const FixedPoint solved = solve_fixed_point(
      [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        ++calls;
        return x + Eigen::VectorXd::Ones(1);
      },
      Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1), {1e-10, 5, 0});
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(solved.evaluations, 5);
  EXPECT_NEAR(solved.residual, 1, 1e-12);
}

TEST(FixedPoint, WhatTheFunctionThrowsComesOut) {
  EXPECT_THROW(
      solve_fixed_point(
          [](const Eigen::VectorXd&) -> Eigen::VectorXd { throw std::runtime_error("lost"); },
          Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1), {}),
      std::runtime_error);
}

}  // namespace
}  // namespace crosswalk::coupling
