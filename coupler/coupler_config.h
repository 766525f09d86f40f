// The schema of [coupling].
#pragma once

#include "common/scenario.h"
#include "coupler/coupler.h"
#include "coupler/hub.h"

namespace crosswalk::coupling {

struct CouplerConfig {
  CouplerSettings settings;
  Patience patience;
  std::int64_t checkpoint_every = 0;  ///< windows; 0: none
};

CouplerConfig read_coupling(ConfigDocument& document, const Scenario& scenario);

}  // namespace crosswalk::coupling
