// What a generated head and neck weighs and how well it is meshed: a page of text.
#pragma once

#include <string>

#include "fe_node/generate/head_neck.h"
#include "fe_node/model.h"

namespace crosswalk::fe {

/// Masses beside [yu2020, Table A1]; then, for every part of `model`, elements, the measures of its
/// bricks (generate/quality.h) beside their limits, the least step of an element of its own,
/// unscaled, and the mass that mass scaling adds to it. `model`: finished, built from `made`; may
/// hold more, such as a windshield.
std::string model_report(const generate::HeadNeck& made, const Model& model);

}  // namespace crosswalk::fe
