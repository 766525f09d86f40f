// Fluid on both sides of the sheets between the brain's regions. Metres.
//
// Falx and tentorium do not grow into the brain; they float beside it in the cisterns. A draft
// whose sheets are quads on the faces of its bricks is parted along them: where a node of a sheet
// has bricks that meet only across it, each such side gets a node of its own, moved off the sheet
// by the gap, and a layer of fluid bricks fills it. At the free edge of a sheet, which the brain
// goes round, and where it hangs on bone the layer runs out in wedges, pyramids and tetrahedra.
#pragma once

#include <vector>

#include "fe_node/generate/mesh_draft.h"

namespace crosswalk::fe::generate {

struct SheetFluid {
  std::vector<int> sheets;  ///< parts of quads, each on a face between two bricks
  std::vector<int> tissue;  ///< parts of bricks that draw back from the sheets
  int fluid = 0;            ///< part of the layer; bricks of it that a sheet crosses are parted too
  int lining = 0;           ///< part of the membrane on the tissue's new faces
  double gap = 0;           ///< m, on each side
  std::vector<int> anchored;  ///< nodes that stay whole: of the bone that a sheet hangs on
};

/// Parts the draft and fills the gaps. The tissue's nodes behind its new faces give way, so that
/// its cells stay even.
void float_sheets(MeshDraft& draft, const SheetFluid& spec);

}  // namespace crosswalk::fe::generate
