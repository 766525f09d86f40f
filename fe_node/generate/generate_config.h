// The scenario tables [head_neck] and [windshield] as specifications of generated models.
#pragma once

#include "common/anthropometry.h"
#include "common/config.h"
#include "fe_node/generate/head_neck.h"
#include "fe_node/generate/windshield.h"

namespace crosswalk::fe::generate {

/// Keys of [head_neck] with the subject's measures. Problems are recorded in the document.
HeadNeckSpec read_head_neck(ConfigTable head_neck, const Anthropometry& subject);
/// Keys of [windshield].
WindshieldSpec read_windshield(ConfigTable windshield);

}  // namespace crosswalk::fe::generate
