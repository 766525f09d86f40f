// Cards of plasticity and other matter to laws of solids and shells, SI.
#pragma once

#include <optional>

#include "fe_node/element/shell_section.h"
#include "fe_node/material/solid_law.h"
#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {

/// Nothing when the card is none of theirs, or after a problem.
std::optional<SolidLaw> solid_law_of_matter(BuildContext& context, const Material& material);
std::optional<ShellLaw> shell_law_of_matter(BuildContext& context, const Material& material);
/// *MAT_LAMINATED_GLASS: its layers by the flags, equal thicknesses where no rule says otherwise.
std::optional<ShellSection> glass_section(BuildContext& context, const Material& material,
                                          double thickness);

}  // namespace crosswalk::fe
