#include "fe_node/output/section_force.h"

#include <algorithm>

#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

/// Calls see(block, element, corner, node) for every corner of the deformable elements.
template <class See>
void for_corners(const Model& model, const See& see) {
  for (int b = 0; b < static_cast<int>(model.blocks.size()); ++b) {
    const ElementBlock& block = *model.blocks[b];
    for (int e = 0; e < block.element_count(); ++e)
      for (int c = 0; c < block.corners(); ++c) see(b, e, c, block.node(e / kLanes, c, e % kLanes));
  }
}

std::pair<ElementKind, int> name_of(const ElementBlock& block, int element) {
  return {block.kind(), block.mesh_element(element)};
}

}  // namespace

SectionForce::SectionForce(const Model& model, const SectionCut& cut, Scratch& scratch) {
  auto elements = cut.elements;
  std::sort(elements.begin(), elements.end());
  for_corners(model, [&](int b, int e, int c, int node) {
    if (!std::binary_search(cut.nodes.begin(), cut.nodes.end(), node)) return;
    if (!std::binary_search(elements.begin(), elements.end(), name_of(*model.blocks[b], e))) return;
    corners_.push_back({node, scratch.add_tap(model, b, e, c)});
  });
}

Wrench SectionForce::about(const Vec3& point, const State& state, const Scratch& scratch) const {
  Wrench sum;
  for (const Corner& corner : corners_) {
    const Scratch::Tap& tap = scratch.taps[corner.tap.first][corner.tap.second];
    sum.f += tap.force;
    sum.tau += (state.nodes[corner.node].position() - point).cross(tap.force) + tap.moment;
  }
  return sum;
}

SectionCut cut_round(const Model& model, const std::vector<int>& parts) {
  const auto is_inside = [&](int part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  std::vector<char> is_cut(model.mesh.node_count(), 0);
  for_corners(model, [&](int b, int, int, int node) {
    if (is_inside(model.blocks[b]->part())) is_cut[node] = 1;
  });
  for (const RigidBody& body : model.bodies)
    if (!body.parts.empty() && std::all_of(body.parts.begin(), body.parts.end(), is_inside))
      for (int n : body.nodes) is_cut[n] = 1;
  SectionCut cut;
  for (int n = 0; n < model.mesh.node_count(); ++n)
    if (is_cut[n]) cut.nodes.push_back(n);
  for_corners(model, [&](int b, int e, int, int node) {
    const ElementBlock& block = *model.blocks[b];
    if (is_cut[node] && !is_inside(block.part())) cut.elements.push_back(name_of(block, e));
  });
  std::sort(cut.elements.begin(), cut.elements.end());
  cut.elements.erase(std::unique(cut.elements.begin(), cut.elements.end()), cut.elements.end());
  return cut;
}

}  // namespace crosswalk::fe
