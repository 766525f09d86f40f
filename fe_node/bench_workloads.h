// Work measured by `crosswalk bench`; nothing is read from files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fe_node/element/element_controls.h"
#include "fe_node/model.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

struct Workload {
  Model model;
  State start;
  int elements = 0;              ///< that take part in the step
  double flops_per_element = 0;  ///< a step, counted in the kernel; a multiply-add as two
};

/// A      block of steel bricks, one face held, a smooth initial velocity; also A20k, A500k
/// B      brain in a skull, an ellipsoid that turns
/// C      pane of elasto-plastic shells struck by a rigid sphere
/// D      the generated head and neck, pulled at its neck: every kind of element and contact
/// Dpane  the same beside a sleeping windshield of 5 mm shells
std::vector<std::string> workload_names();
Workload make_workload(std::string_view name, Precision precision);

}  // namespace crosswalk::fe
