// Materials of the head and the neck flesh, SI, each with its source and grade.
#pragma once

#include <vector>

#include "fe_node/generate/part_spec.h"

namespace crosswalk::fe::generate {

/// Bulk modulus of brain, cord and CSF, Pa, as SIMon's brain [takhounts2003]; water has four times
/// as much. Their pressures stand against the skull's acceleration and hardly ask for it, but it
/// sets the step of their bricks (docs/head_neck_model.md, "Bulk modulus").
inline constexpr double kBrainBulk = 0.5585e9;
inline constexpr double kWaterBulk = 2.19e9;  ///< Pa [mao2013]

/// Parts of the cranium, the face and the flesh that a draft with solid skull layers uses; brain,
/// cord and CSF with this bulk modulus, Pa.
std::vector<PartSpec> head_tissues(double brain_bulk = kBrainBulk);

}  // namespace crosswalk::fe::generate
