// Bad input told to another program: the JSON object that --json puts in place of a result.
#pragma once

#include <string>
#include <string_view>

namespace crosswalk {

/// {"error": "<code>", "message": "..."}, one object over several lines, without a newline at its
/// end; bytes that are no UTF-8 are replaced.
std::string error_object(std::string_view code, std::string_view message);

}  // namespace crosswalk
