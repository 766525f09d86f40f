#include "tests/source_folder.h"

namespace crosswalk {

const std::filesystem::path& source_folder() {
  static const std::filesystem::path folder = CW_SOURCE_DIR;
  return folder;
}

const std::filesystem::path& build_folder() {
  static const std::filesystem::path folder = CW_BINARY_DIR;
  return folder;
}

}  // namespace crosswalk
