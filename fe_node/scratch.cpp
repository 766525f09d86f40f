#include <algorithm>

#include "common/error.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {

Scratch::Scratch(const Model& model, int thread_count)
    : threads(thread_count), queues(thread_count) {
  const std::size_t tile_count = model.tiles.tiles.size();
  tile_sums.resize(tile_count);
  taps.resize(tile_count);
  block_sums.resize(model.blocks.size());
  force_rows.resize(kCornerStride * model.tiles.force_row_count);
  moment_rows.resize(kCornerStride * model.tiles.moment_row_count);
  const int node_count = model.mesh.node_count();
  applied.assign(node_count, Vec3::Zero());
  force.assign(node_count, Vec3::Zero());
  moment.assign(model.has_rotations() ? node_count : 0, Vec3::Zero());
  int loads = 0;
  for (const auto& contact : model.contacts) loads += contact->max_nodal_loads();
  contact_loads.nodal.reserve(loads);
  for (const NodalForce& load : model.nodal_forces) loads += static_cast<int>(load.nodes.size());
  for (const PressureLoad& load : model.pressures)
    loads += 4 * static_cast<int>(load.facets.size());
  for (const TiedNode& tie : model.tied) loads += tie.count;
  loaded.reserve(loads);
  list_constrained(model);
  contact_loads.on_body.resize(model.bodies.size());
  contact_reports.resize(model.contacts.size());
  body_views.resize(model.bodies.size());
  body_wrench.resize(model.bodies.size());
  body_command.resize(model.bodies.size());
  held.resize(model.fixed.size());
  node_sums.resize(node_count / kNodesPerChunk + 1);
}

void Scratch::list_constrained(const Model& model) {
  is_constrained.assign(model.mesh.node_count(), 0);
  for (const RigidBody& body : model.bodies)
    for (int n : body.nodes) is_constrained[n] = 1;
  for (const GuidedNodes& guide : model.guided)
    for (int n : guide.nodes) is_constrained[n] = 1;
  for (const FixedNode& fixed : model.fixed) is_constrained[fixed.node] = 1;
  for (int n = 0; n < model.mesh.node_count(); ++n)
    if (is_constrained[n]) constrained.push_back(n);
}

std::pair<int, int> Scratch::add_tap(const Model& model, int block, int element, int corner) {
  const std::vector<ForceTile>& tiles = model.tiles.tiles;
  const auto holds = [&](const ForceTile& tile) {
    return tile.block == block && element / kLanes >= tile.first && element / kLanes < tile.last;
  };
  const auto tile =
      static_cast<std::size_t>(std::find_if(tiles.begin(), tiles.end(), holds) - tiles.begin());
  CW_ASSERT(tile < tiles.size());
  taps[tile].push_back({element, corner});
  return {static_cast<int>(tile), static_cast<int>(taps[tile].size()) - 1};
}

}  // namespace crosswalk::fe
