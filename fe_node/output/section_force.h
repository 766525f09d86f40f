// Force and moment through a cut of the mesh: what the elements of one side exert on its nodes.
#pragma once

#include <utility>
#include <vector>

#include "common/spatial.h"
#include "fe_node/history_requests.h"
#include "fe_node/model.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

struct Scratch;

class SectionForce {
 public:
  /// The corners of the cut are kept in `scratch` from now on. Elements of rigid parts exert
  /// nothing.
  SectionForce(const Model& model, const SectionCut& cut, Scratch& scratch);

  /// Right after compute_forces(): force and moment about `point`, W.
  Wrench about(const Vec3& point, const State& state, const Scratch& scratch) const;

 private:
  struct Corner {
    int node = 0;
    std::pair<int, int> tap;  ///< see Scratch::add_tap()
  };
  std::vector<Corner> corners_;
};

/// The cut between these parts and all others: their nodes, and the deformable elements of other
/// parts at those nodes. Contacts and ties across it are not part of it.
SectionCut cut_round(const Model& model, const std::vector<int>& parts);

}  // namespace crosswalk::fe
