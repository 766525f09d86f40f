// `crosswalk bench coupling`: what a coupling window costs when the solvers do nothing.
//
// The real hub, links and recorder with two nodes that answer at once, four processes as in a run;
// and, in the same run, the bare exchange that a window cannot do without: the same bytes from the
// coupler to mb_node and back, then to fe_node and back, by LCM alone.
#pragma once

#include "common/node_main.h"

namespace crosswalk {

NodeCommand bench_command();

}  // namespace crosswalk
