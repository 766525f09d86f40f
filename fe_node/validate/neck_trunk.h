// What a head meets when the neck bends far, and muscles that answer: for the sled cases.
#pragma once

#include "fe_node/generate/part_spec.h"
#include "fe_node/validate/deck_case.h"

namespace crosswalk::fe::validate {

/// Chest and shoulders as planes of the torso block under a rigid head (frame N): the chin meets
/// the chest, the side of the head and the jaw the shoulder. Planes and flesh [E].
void add_trunk(generate::ModelDraft& draft);

/// One activation over time for all muscles.
void activate_muscles(generate::ModelDraft& draft, const Points& activation);
/// A relaxed volunteer hit at `start`: tone, then a reflex 75 ms later; the middles of 0.02 to
/// 0.05, 50 to 100 ms and 0.2 to 1, rise in 10 ms [L, medium]. Not fitted to anything.
Points volunteer(double start);

}  // namespace crosswalk::fe::validate
