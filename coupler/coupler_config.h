// The schema of [coupling].
#pragma once

#include "common/scenario.h"
#include "coupler/coupler.h"
#include "coupler/hub.h"

namespace crosswalk::coupling {

struct CouplerConfig {
  CouplerSettings settings;
  Patience patience;
};

CouplerConfig read_coupling(ConfigDocument& document, const Scenario& scenario);

}  // namespace crosswalk::coupling
