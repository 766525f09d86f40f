// Where the project's files and its build lie. Compiled once, so that no other object depends on it.
#pragma once

#include <filesystem>

namespace crosswalk {

const std::filesystem::path& source_folder();
const std::filesystem::path& build_folder();

}  // namespace crosswalk
