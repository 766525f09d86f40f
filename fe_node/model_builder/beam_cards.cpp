// *SECTION_BEAM of beams that bend, to elastic resultants.
#include <cmath>

#include <fmt/format.h>

#include "fe_node/model_builder/law_stage.h"

namespace crosswalk::fe {

bool bends(const SectionBeam& card) {
  return card.formulation == 1 || card.formulation == 2 || card.formulation == 4 ||
         card.formulation == 5;
}

std::optional<BeamSection> beam_section(BuildContext& c, const Part& part,
                                        const SectionBeam& card) {
  const Material& material = *c.material_of(part);
  const std::string who = fmt::format("beam part {}", part.id.value);
  const auto* law = std::get_if<mat::Elastic>(&material.law);
  if (law == nullptr || law->is_fluid || !(law->youngs > 0) || !(material.density > 0)) {
    c.problem(material.source, who, "*MAT_ELASTIC with density and Young's modulus",
              material_keyword(material), "beams that bend are elastic here");
    return std::nullopt;
  }
  const double L = c.units.length, E = law->youngs * c.units.stress();
  const double density = material.density * c.units.density();
  BeamSection out;
  if (card.formulation == 2) {
    out.density = density;
    out.youngs_modulus = E;
    out.shear_modulus = 0.5 * E / (1 + law->poisson);
    out.area = card.area * L * L;
    out.shear_area = card.shear_area * L * L;
    out.inertia_ss = card.iss * std::pow(L, 4);
    out.inertia_tt = card.itt * std::pow(L, 4);
    out.torsion = card.torsion * std::pow(L, 4);
  } else {
    const bool is_tapered = card.outer_s[0] != card.outer_s[1] && card.outer_s[1] != 0;
    if (is_tapered || card.cross_section > 1.5 || !card.shape.empty() || card.location_s != 0 ||
        card.location_t != 0) {
      c.problem(part.source, who, "a centred rectangle or tube of one size (CST 0 or 1)",
                "another section");
      return std::nullopt;
    }
    out = card.cross_section < 0.5
              ? rectangular_beam(density, E, law->poisson, card.outer_s[0] * L, card.outer_t[0] * L)
              : tubular_beam(density, E, law->poisson, card.outer_s[0] * L, card.outer_t[0] * L);
    c.note(fmt::format("part {}: beam formulation {} is computed by resultants (2), elastic",
                       part.id.value, card.formulation));
  }
  if (!(out.area > 0) || !(out.inertia_ss > 0) || !(out.inertia_tt > 0) || !(out.torsion > 0)) {
    c.problem(part.source, who, "a section with area, both inertias and torsion", "one without",
              "fields A, ISS, ITT, J or TS1, TT1");
    return std::nullopt;
  }
  return out;
}

}  // namespace crosswalk::fe
