// Material cards to laws, SI. Nothing and a problem when a card's law cannot be run.
#pragma once

#include <optional>

#include "fe_node/element/beam.h"
#include "fe_node/element/line.h"
#include "fe_node/element/shell_section.h"
#include "fe_node/material/solid_law.h"
#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {

std::optional<SolidLaw> solid_law(BuildContext& context, const Material& material);
std::optional<ShellSection> shell_section(BuildContext& context, const Part& part);
/// Of a beam, discrete or belt part; `area` in m2 where the section has one. Strands are not set.
std::optional<LineProperties> line_properties(BuildContext& context, const Part& part);
/// Whether a beam formulation bends (Hughes-Liu 1, Belytschko-Schwer 2, and 4, 5).
bool bends(const SectionBeam& card);
/// Elastic resultants of such a beam.
std::optional<BeamSection> beam_section(BuildContext& context, const Part& part,
                                        const SectionBeam& card);
/// *HOURGLASS of the part, else *CONTROL_HOURGLASS; bulk viscosity; mass scaling.
ElementControls element_controls(BuildContext& context, const Part& part);

}  // namespace crosswalk::fe
