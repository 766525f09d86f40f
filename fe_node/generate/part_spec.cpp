#include "fe_node/generate/part_spec.h"

#include <algorithm>

#include "common/error.h"

namespace crosswalk::fe::generate {

const char* mark(Grade grade) {
  switch (grade) {
    case Grade::Source:
      return "[S]";
    case Grade::Literature:
      return "[L]";
    case Grade::Estimate:
      break;
  }
  return "[E]";
}

PartSpec& ModelDraft::part(int id) {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [id](const PartSpec& p) { return p.id == id; });
  CW_ASSERT(found != parts.end());
  return *found;
}

const PartSpec& ModelDraft::part(int id) const { return const_cast<ModelDraft*>(this)->part(id); }

}  // namespace crosswalk::fe::generate
