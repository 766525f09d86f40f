#include "common/error_object.h"

#include <nlohmann/json.hpp>

namespace crosswalk {

std::string error_object(std::string_view code, std::string_view message) {
  const nlohmann::ordered_json object = {{"error", code}, {"message", message}};
  return object.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace crosswalk
