// The car as the descriptions of a run tell it (docs/messages.md).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mb_node/vehicle.h"

namespace crosswalk::mb {

nlohmann::json vehicle_json(const Vehicle& vehicle);

}  // namespace crosswalk::mb
