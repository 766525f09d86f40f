// Layers of a shell as a deck gives them: *INTEGRATION_SHELL and *MAT_LAMINATED_GLASS, SI.
#pragma once

#include <optional>
#include <vector>

#include "fe_node/element/shell_section.h"
#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {

/// The points of the section's *INTEGRATION_SHELL from the bottom; empty when it has none, nothing
/// after a problem.
std::optional<std::vector<ShellPoint>> ruled_points(BuildContext& context, const Part& part,
                                                    const SectionShell& card);

/// *MAT_LAMINATED_GLASS: brittle panes (ShellGlass, strength SYG) and elastic-plastic interlayers,
/// one point per flag by the section's rule, or plies of equal thickness without one.
std::optional<ShellSection> glass_section(BuildContext& context, const Part& part,
                                          const mat::LaminatedGlass& glass,
                                          const SectionShell& card);

}  // namespace crosswalk::fe
