// All laws a solid element can have. To add one: its header here, and nothing else; the element
// factories visit the variant.
#pragma once

#include <variant>

#include "fe_node/material/elastic.h"
#include "fe_node/material/fluid.h"
#include "fe_node/material/foam.h"
#include "fe_node/material/hyperelastic.h"
#include "fe_node/material/plastic.h"
#include "fe_node/material/viscoelastic.h"

namespace crosswalk::fe {

using SolidLaw = std::variant<Elastic, Viscoelastic, Plastic, Ogden, Rubber, Foam, Fluid>;

inline double density_of(const SolidLaw& law) {
  return std::visit([](const auto& l) { return l.density; }, law);
}

}  // namespace crosswalk::fe
