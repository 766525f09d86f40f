// What a run shall tell of single nodes, elements and sections.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fe_node/mesh/mesh.h"

namespace crosswalk::fe {

struct SectionCut {
  std::string name;
  std::vector<int> nodes;                             ///< rising
  std::vector<std::pair<ElementKind, int>> elements;  ///< of the mesh tables, one side
};

struct HistoryRequests {
  double interval = 0;  ///< s; 0: that of the energies
  std::vector<int> nodes;
  std::vector<std::pair<ElementKind, int>> elements;
  std::vector<SectionCut> sections;
};

}  // namespace crosswalk::fe
