#include "common/version.h"

#include "crosswalk/git_version.h"

namespace crosswalk {

std::string version_text() { return CROSSWALK_VERSION_TEXT; }

}  // namespace crosswalk
