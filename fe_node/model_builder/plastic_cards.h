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
/// H = E Et / (E - Et); 0 when there is no tangent.
double hardening_modulus(double youngs, double tangent);

}  // namespace crosswalk::fe
