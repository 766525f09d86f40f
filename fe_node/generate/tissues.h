// Materials of the head and the neck flesh, SI, each with its source and grade.
#pragma once

#include <vector>

#include "fe_node/generate/part_spec.h"

namespace crosswalk::fe::generate {

/// Parts of the cranium, the face and the flesh that a draft with solid skull layers uses.
std::vector<PartSpec> head_tissues();

}  // namespace crosswalk::fe::generate
