// The lattice neck on its bodies with both sides as processes.
#pragma once

#include <vector>

#include "tests/coupler/neck_run.h"
#include "tests/system/toy_processes.h"

namespace crosswalk::system_test {

/// Half the largest that is stable: twice as fast as that of the direct runs.
inline constexpr double kProcessFeStep = 1e-6;

/// `mic` on the neck for `end` seconds.
ToyScenario scenario_of(const coupling::NeckCase& c, int window_us, double end);
/// What became of the neck of a finished run.
coupling::NeckOutcome neck_after(const coupling::NeckCase& c, const ToyOutcome& outcome);

/// Runs every case at every window for 100 ms and prints a row of how far energy and head are from
/// the neck that is whole in the solver, in % of the peak energy and um. Expects the energy within
/// 0.5 % and, at 10 to 50 us, the head within 20 um.
void expect_near_whole(const std::vector<coupling::NeckCase>& cases,
                       const std::vector<int>& windows_us);

}  // namespace crosswalk::system_test
