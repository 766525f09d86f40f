// Config to model, start state and engine world.
#pragma once

#include <vector>

#include "common/exchange.h"
#include "mb_node/model.h"

namespace crosswalk::mb {

/// Places the pedestrian, puts the car `gap` away from it, fixes initial angles and overlaps.
MbModel build_model(MbConfig config);
MbState initial_state(const MbModel& model);
/// Bodies and joints in the posture, walking and turning as it says; `blocks` (one per segment,
/// mass 0: none) are finite-element masses about the reference points in axes of W at t = 0. Sets
/// the model's reference offsets.
OdeWorld build_world(MbModel& model, const std::vector<Inertia>& blocks);

}  // namespace crosswalk::mb
