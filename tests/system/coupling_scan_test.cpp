// Every window of the acceptance table on the lattice neck, with both sides as processes.
#include <gtest/gtest.h>

#include "tests/system/neck_processes.h"

namespace crosswalk::system_test {
namespace {

TEST(CouplingScan, MicIsStableAtEveryWindow) {
  std::vector<coupling::NeckCase> cases;
  for (const double mass : {15.0, 1.0, 0.3, 0.1}) {
    cases.push_back(coupling::pushed_neck(mass));
    cases.back().fe_step = kProcessFeStep;
  }
  expect_near_whole(cases, {1, 2, 5, 10, 20, 50, 100});
}

}  // namespace
}  // namespace crosswalk::system_test
