// How a case is computed; what it answers must not depend on it.
#pragma once

#include "fe_node/element/element_controls.h"

namespace crosswalk::fe::validate {

struct Computing {
  int threads = 1;
  Precision precision = Precision::Double;
};

}  // namespace crosswalk::fe::validate
