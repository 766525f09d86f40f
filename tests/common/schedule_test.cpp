#include "common/schedule.h"

#include <gtest/gtest.h>

namespace crosswalk {
namespace {

TEST(Schedule, WindowEdgesAreExactIntegers) {
  const Schedule schedule(20'000);
  EXPECT_EQ(schedule.end_ns(9'999), 200'000'000);
  EXPECT_EQ(schedule.windows_until(200'000'000), 10'000);
  EXPECT_EQ(schedule.windows_until(200'000'001), 10'001);
}

TEST(SubstepCount, LandsOnTheEdgeWithoutExceedingTheStableStep) {
  EXPECT_EQ(substep_count(20e-6, 10e-6), 2);
  EXPECT_EQ(substep_count(20e-6, 0.7e-6), 29);
  EXPECT_EQ(substep_count(20e-6, 1e-3), 1);
}

}  // namespace
}  // namespace crosswalk
