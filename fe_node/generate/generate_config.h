// The scenario tables [head_neck] and [windshield] as specifications of generated models.
#pragma once

#include "common/anthropometry.h"
#include "common/config.h"
#include "fe_node/generate/head_neck.h"
#include "fe_node/generate/windshield.h"

namespace crosswalk::fe::generate {

/// Keys of [head_neck] for a generated model, with the subject's measures. Problems are recorded in
/// the document; the fidelity is that of the run.
HeadNeckSpec read_head_neck_spec(ConfigTable head_neck, const Anthropometry& subject,
                                 Fidelity fidelity);
/// Keys of [windshield].
WindshieldSpec read_windshield(ConfigTable windshield);

}  // namespace crosswalk::fe::generate
