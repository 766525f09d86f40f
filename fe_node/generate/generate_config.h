// The scenario tables [head_neck] and [windshield] as specifications of generated models.
#pragma once

#include <optional>

#include "common/anthropometry.h"
#include "common/config.h"
#include "common/vehicle_front.h"
#include "fe_node/generate/head_neck.h"
#include "fe_node/generate/windshield.h"

namespace crosswalk::fe::generate {

/// Keys of [head_neck] for a generated model, with the subject's measures. Problems are recorded in
/// the document; the fidelity is that of the run.
HeadNeckSpec read_head_neck_spec(ConfigTable head_neck, const Anthropometry& subject,
                                 Fidelity fidelity);
/// Keys of [windshield]; none when `model = "rigid"`. The pane stands where the car has its
/// component `windshield`.
std::optional<WindshieldSpec> read_windshield(ConfigTable windshield, const VehicleFront& front,
                                              Fidelity fidelity);

}  // namespace crosswalk::fe::generate
