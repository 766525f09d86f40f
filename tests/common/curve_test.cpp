#include "common/curve.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace crosswalk {
namespace {

const Curve ramp({0, 1, 3}, {0, 2, 4}, Curve::Outside::LastSlope);

TEST(Curve, InterpolatesAndFollowsTheLastSlopeOutside) {
  EXPECT_DOUBLE_EQ(ramp.value(0.5), 1.0);
  EXPECT_DOUBLE_EQ(ramp.value(2.0), 3.0);
  EXPECT_DOUBLE_EQ(ramp.value(5.0), 6.0);
  EXPECT_DOUBLE_EQ(ramp.value(-1.0), -2.0);
  EXPECT_DOUBLE_EQ(ramp.slope(0.2), 2.0);
  EXPECT_DOUBLE_EQ(ramp.slope(9.0), 1.0);
}

TEST(Curve, IntegralIsTheAreaBelow) {
  EXPECT_DOUBLE_EQ(ramp.integral(1.0), 1.0);
  EXPECT_DOUBLE_EQ(ramp.integral(3.0), 7.0);
  EXPECT_DOUBLE_EQ(ramp.integral(5.0), 7.0 + 10.0);
}

TEST(Curve, HoldAndZeroEndTheTable) {
  EXPECT_DOUBLE_EQ(Curve({0, 1}, {1, 3}, Curve::Outside::Hold).value(7), 3.0);
  EXPECT_DOUBLE_EQ(Curve({0, 1}, {1, 3}, Curve::Outside::Zero).value(7), 0.0);
}

TEST(Curve, RefusesPointsThatAreNoFunction) {
  EXPECT_THROW(Curve({0, 0}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(Curve({}, {}), std::invalid_argument);
  EXPECT_THROW(Curve({0, 1}, {1, std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
}

}  // namespace
}  // namespace crosswalk
