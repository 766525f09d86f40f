#include "fe_node/generate/mesh_draft.h"

#include <algorithm>

namespace crosswalk::fe::generate {

int MeshDraft::add_node(const Vec3& position) {
  nodes.push_back(position);
  return static_cast<int>(nodes.size()) - 1;
}

void MeshDraft::attach(int part, const std::vector<int>& node_list) {
  auto found = std::find_if(attachments.begin(), attachments.end(),
                            [part](const RigidAttachment& a) { return a.part == part; });
  if (found == attachments.end()) found = attachments.insert(attachments.end(), {part, {}});
  found->nodes.insert(found->nodes.end(), node_list.begin(), node_list.end());
}

}  // namespace crosswalk::fe::generate
