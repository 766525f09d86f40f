// Neck muscles as straight strands with Hill parameters between skull, vertebrae and the blocks.
//
// Strands run straight from origin to insertion; wrapping over vertebrae is not modelled. Passive
// by default (cadavers); the activation is one number for all.
#pragma once

#include "fe_node/generate/spine.h"

namespace crosswalk::fe::generate {

struct MuscleOptions {
  double area_factor = 1.2;  ///< male against the female baseline areas, 1.0 to 1.4 [L, medium]
  double activation = 0;     ///< 0 passive, 1 full
};

void add_muscles(ModelDraft& draft, const Spine& spine, const Vec3& head_scale,
                 const MuscleOptions& options);

}  // namespace crosswalk::fe::generate
