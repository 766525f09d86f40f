// Speed of the solver loop alone on generated workloads: element-steps per second, data rate, and
// the share of the multiply-add rate measured just before on the same cores.
#pragma once

#include <string>
#include <vector>

#include "fe_node/element/element_controls.h"

namespace crosswalk::fe {

struct BenchRequest {
  std::vector<std::string> workloads;  ///< see bench_workloads.h; empty: all
  std::vector<int> threads;            ///< empty: 1 and all
  Precision precision = Precision::Double;
  bool json = false;
};

/// The table, or one JSON object.
std::string run_bench(const BenchRequest& request);

}  // namespace crosswalk::fe
