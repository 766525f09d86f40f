// What the discs below C2 to T1 are made of: a soft ground on shared endplate nodes, the nucleus,
// and the crossed fibres of the annulus.
//
// Ground   bricks with the law of the annulus' matrix.
// Nucleus  a fluid: its pressure is the same everywhere, so it bears compression by one force
//          through the middle and no bending; one line.
// Annulus  three layers of fibres between the endplates, each layer with both slants; a fibre
//          bears tension only. Lamellae are far stiffer than the ground, and slant: so a disc is
//          soft along its axis but stiff in torsion, which no isotropic solid can be.
#pragma once

#include "fe_node/generate/part_spec.h"
#include "fe_node/generate/spine.h"

namespace crosswalk::fe::generate {

/// The bricks of a disc.
PartSpec disc_ground(int id, const std::string& name);
/// Fibres and nuclei of all discs; the vertebrae have to be in the draft.
void add_disc_fibres(ModelDraft& draft, const Spine& spine);

}  // namespace crosswalk::fe::generate
