// Text files of the report that travel inside the program (written by embed.cmake at build time).
#pragma once

#include <string_view>

namespace crosswalk::recording::assets {

extern const std::string_view report_template;
extern const std::string_view live_template;
extern const std::string_view report_style;
extern const std::string_view page_script;        ///< empty when npm was absent at build time
extern const std::string_view page_script_style;  ///< of the chart library

}  // namespace crosswalk::recording::assets
