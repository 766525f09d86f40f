// Pieces of the generated model for component tests: the head without neck, with a rigid or a
// deformable skull, and points fixed in tissue.
#pragma once

#include <array>
#include <vector>

#include "fe_node/generate/head_neck.h"
#include "fe_node/validate/deck_case.h"

namespace crosswalk::fe::validate {

/// The elements of these parts with their nodes, node sets, masses and rigid attachments.
generate::ModelDraft extract(const generate::ModelDraft& whole, const std::vector<int>& parts);

/// Parts of a part set of the draft; asserts that it exists.
std::vector<int> parts_of_set(const generate::ModelDraft& draft, const std::string& name);

/// Brain and CSF with their membranes inside a rigid skull (the occiput's part).
generate::ModelDraft rigid_skull_head(const generate::HeadNeck& whole);
int rigid_skull_part();

/// Everything above the neck, deformable.
generate::ModelDraft whole_head(const generate::HeadNeck& whole);

/// A material point inside a brick, by its place in the brick.
struct TissuePoint {
  std::array<int, 8> node{};
  std::array<double, 8> weight{};
  Vec3 position(const DeckRun& run) const;
};
/// The point of the parts' bricks nearest to p (draft coordinates); exact when p lies inside one.
TissuePoint tissue_point(const generate::ModelDraft& draft, const std::vector<int>& parts,
                         const Vec3& p);

}  // namespace crosswalk::fe::validate
