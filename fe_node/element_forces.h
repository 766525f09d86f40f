// Forces of all elements, tile by tile, and the sums that come with them. The same bits for any
// number of threads: every tile adds up in rows and sums of its own, which are added in fixed
// order.
#pragma once

#include "fe_node/solver.h"

namespace crosswalk::fe {

/// Fills the rows and sums of every tile that is awake.
void element_forces(const Model& model, State& state, Scratch& scratch);
/// Adds the tiles' sums up, books the energies and tells what step the elements allow. Throws
/// NumericalError where an element is inverted.
StepReport sum_blocks(const Model& model, State& state, Scratch& scratch);
/// Flags the elements that have failed, when their number has changed: more have failed, or the
/// state is another one.
void find_failed(const Model& model, const State& state, Scratch& scratch);

}  // namespace crosswalk::fe
