// Results and parameters of the ratings and metrics as JSON, under the names printed by
// `recorder rate` and `recorder injury` (docs/summary_schema.md). Numbers keep all digits.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "recorder/scoring/cora.h"
#include "recorder/scoring/iso18571.h"
#include "recorder/scoring/score_card.h"

namespace crosswalk::recording {

nlohmann::ordered_json to_json(const CoraResult& result);
nlohmann::ordered_json to_json(const CoraParameters& parameters);
nlohmann::ordered_json to_json(const Iso18571Result& result);
nlohmann::ordered_json to_json(const Iso18571Parameters& parameters);
nlohmann::ordered_json to_json(const ScoreCard& card);
nlohmann::ordered_json to_json(const TissueMetrics& metrics);

/// Overrides of the defaults; unknown keys and wrong kinds are a bad_parameter fault.
CoraParameters cora_parameters(const nlohmann::json& object);
Iso18571Parameters iso18571_parameters(const nlohmann::json& object);

}  // namespace crosswalk::recording
