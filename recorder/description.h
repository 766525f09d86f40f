// What a node says of its names and shapes (docs/messages.md), as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "recorder/run_record.h"

namespace crosswalk::recording {

/// The description of a node; an empty object when it is absent or damaged.
inline nlohmann::json description_of(const RunRecord& record, Role role) {
  const auto found = record.description.find(role);
  if (found == record.description.end()) return nlohmann::json::object();
  nlohmann::json parsed = nlohmann::json::parse(found->second, nullptr, /*allow_exceptions=*/false);
  return parsed.is_object() ? parsed : nlohmann::json::object();
}

}  // namespace crosswalk::recording
