#include "common/spatial.h"

#include <gtest/gtest.h>

namespace crosswalk {
namespace {

TEST(Rotation, ExpAndLogAreInverse) {
  for (const Vec3& a : {Vec3(0.3, -0.2, 1.1), Vec3(1e-7, 2e-8, 0), Vec3(0, 3.1, 0)})
    EXPECT_LT((log_rotation(exp_rotation(a)) - a).norm(), 1e-12);
}

TEST(Pose, ComposesAndInverts) {
  const Pose X_AB{exp_rotation({0.1, 0.2, 0.3}), {1, 2, 3}};
  const Pose X_BC{exp_rotation({-0.4, 0.5, 0.1}), {0.1, 0, -2}};
  const Vec3 p_CQ(0.3, 0.7, -0.2);
  EXPECT_LT(((X_AB * X_BC) * p_CQ - X_AB * (X_BC * p_CQ)).norm(), 1e-14);
  EXPECT_LT((X_AB.inverse() * (X_AB * p_CQ) - p_CQ).norm(), 1e-14);
}

TEST(Wrench, PowerDoesNotDependOnTheReferencePoint) {
  const Wrench F{{1, 2, 3}, {-1, 0.5, 2}};
  const Twist V{{0.3, -0.1, 0.7}, {2, -1, 0.4}};
  const Vec3 p(0.4, -0.3, 0.9);
  EXPECT_NEAR(F.power(V), F.shifted(p).power(V.shifted(p)), 1e-14);
}

TEST(Inertia, OfPointMassesIsTheSteinerSum) {
  const Inertia sum = Inertia::of_point(2, {1, 0, 0}) + Inertia::of_point(2, {-1, 0, 0});
  EXPECT_DOUBLE_EQ(sum.mass, 4);
  EXPECT_LT(sum.com.norm(), 1e-15);
  EXPECT_LT((sum.about_com - Mat3(Vec3(0, 4, 4).asDiagonal())).norm(), 1e-14);
}

TEST(Inertia, KeepsItsPrincipalMomentsWhenReexpressed) {
  const Inertia in_B{1.5, {0.1, 0.2, 0.3}, Vec3(1, 2, 2.5).asDiagonal()};
  const Pose X_AB{exp_rotation({0.3, 0.1, -0.7}), {1, 1, 1}};
  const Inertia in_A = in_B.in(X_AB);
  EXPECT_NEAR(in_A.about_com.trace(), 5.5, 1e-14);
  EXPECT_LT((in_A.com - X_AB * in_B.com).norm(), 1e-15);
}

}  // namespace
}  // namespace crosswalk
