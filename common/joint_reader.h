// Reads the restraint of one joint and scales it to the subject.
#pragma once

#include "common/body_description.h"
#include "common/body_formulas.h"
#include "common/config.h"

namespace crosswalk {

/// Laws of a joint's angles, of a long bone that may break and of lateral shear. With the girth
/// ratio g and the length ratio l of the limb stiffness goes with g^4 / l, moments with g^3 and
/// damping with g^4: bars of one material. `bone_quality` multiplies fracture moments.
JointRestraint read_restraint(ConfigTable& table, const BodyFormulas& formulas,
                              double bone_quality);

}  // namespace crosswalk
