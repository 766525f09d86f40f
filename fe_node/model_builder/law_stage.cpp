#include "fe_node/model_builder/law_stage.h"

#include <algorithm>

#include <fmt/format.h>

#include "fe_node/model_builder/layer_cards.h"
#include "fe_node/model_builder/plastic_cards.h"

namespace crosswalk::fe {
namespace {

std::string card(const Material& material) {
  return fmt::format("*{} {}", material_keyword(material), material.id.value);
}

void refuse(BuildContext& c, const Material& material, const char* element) {
  c.problem(material.source, card(material), fmt::format("a law that {} elements have", element),
            "one they do not have");
}

bool is_share(BuildContext& c, const Material& material, double poisson) {
  if (poisson >= 0 && poisson < 0.5) return true;
  c.problem(material.source, card(material) + " field PR", "a Poisson ratio in [0, 0.5)",
            fmt::format("{}", poisson));
  return false;
}

}  // namespace

std::optional<SolidLaw> solid_law(BuildContext& c, const Material& material) {
  const double density = material.density * c.units.density();
  const double stress = c.units.stress();
  if (!(density > 0)) {
    c.problem(material.source, card(material) + " field RO", "a positive density",
              fmt::format("{}", material.density));
    return std::nullopt;
  }
  if (const auto* m = std::get_if<mat::Elastic>(&material.law); m != nullptr && !m->is_fluid) {
    if (!is_share(c, material, m->poisson)) return std::nullopt;
    return Elastic::from_young(density, m->youngs * stress, m->poisson);
  }
  if (const auto* m = std::get_if<mat::Viscoelastic>(&material.law))
    return Viscoelastic::from_single_term(density, m->bulk * stress, m->shear_short * stress,
                                          m->shear_long * stress, m->decay / c.units.time);
  if (const auto* m = std::get_if<mat::KelvinMaxwell>(&material.law);
      m != nullptr && m->formulation == 0)
    return Viscoelastic::from_single_term(density, m->bulk * stress, m->shear_short * stress,
                                          m->shear_long * stress, m->decay / c.units.time);
  if (const auto* m = std::get_if<mat::GeneralViscoelastic>(&material.law);
      m != nullptr && !m->terms.empty() && m->terms.size() <= Viscoelastic::kMaxTerms) {
    Viscoelastic law;
    law.density = density;
    law.bulk = m->bulk * stress;
    for (const mat::PronyTerm& term : m->terms) {
      if (term.shear_decay == 0)
        law.long_term_modulus += term.shear * stress;
      else
        law.terms[law.term_count++] = {term.shear * stress, term.shear_decay / c.units.time};
    }
    return law;
  }
  const int problems = c.problem_count;
  if (std::optional<SolidLaw> law = solid_law_of_matter(c, material)) return law;
  if (c.problem_count == problems) refuse(c, material, "solid");
  return std::nullopt;
}

namespace {

std::optional<ShellLaw> shell_law(BuildContext& c, const Material& material) {
  const double density = material.density * c.units.density(), stress = c.units.stress();
  if (const auto* m = std::get_if<mat::Elastic>(&material.law); m != nullptr && !m->is_fluid) {
    if (!is_share(c, material, m->poisson)) return std::nullopt;
    return ShellElastic{density, m->youngs * stress, m->poisson};
  }
  if (const auto* m = std::get_if<mat::Viscoelastic>(&material.law))
    return ShellViscoelastic::make(density, m->bulk * stress, m->shear_short * stress,
                                   m->shear_long * stress, m->decay / c.units.time);
  if (const auto* m = std::get_if<mat::Null>(&material.law); m != nullptr)
    return ShellElastic{density, 1e-9 * stress, 0.3};
  if (const auto* m = std::get_if<mat::Fabric>(&material.law); m != nullptr && m->ea > 0)
    return ShellTensionSheet{density, m->ea * stress, m->prba};
  const int problems = c.problem_count;
  if (std::optional<ShellLaw> law = shell_law_of_matter(c, material)) return law;
  if (c.problem_count == problems) refuse(c, material, "shell");
  return std::nullopt;
}

bool is_membrane(int formulation) { return formulation == 5 || formulation == 9; }

/// 16, and the selective-reduced 6 and 7 [hallquist2006, 11].
bool is_full(int formulation) { return formulation == 6 || formulation == 7 || formulation == 16; }

std::optional<ShellSection> layered_section(BuildContext& c, const Part& part) {
  const std::string who = fmt::format("*PART {}", part.id.value);
  if (part.composite) {
    std::vector<Ply> plies;
    for (const CompositeLayer& layer : part.composite->layers) {
      const auto found = c.materials.find(layer.material);
      if (found == c.materials.end()) {
        c.problem(part.source, who, "materials of the deck", std::to_string(layer.material.value));
        return std::nullopt;
      }
      std::optional<ShellLaw> law = shell_law(c, *found->second);
      if (!law) return std::nullopt;
      plies.push_back({*law, layer.thickness * c.units.length, 1});
    }
    if (plies.empty() || std::any_of(plies.begin(), plies.end(),
                                     [](const Ply& ply) { return !(ply.thickness > 0); })) {
      c.problem(part.source, who, "layers with a thickness",
                plies.empty() ? "none" : "one without");
      return std::nullopt;
    }
    return laminate(plies);
  }
  const Section* section = c.section_of(part);
  const auto* card = section == nullptr ? nullptr : std::get_if<SectionShell>(&section->law);
  if (card == nullptr || !(card->thickness[0] > 0)) {
    c.problem(part.source, who, "a *SECTION_SHELL with a thickness", "none");
    return std::nullopt;
  }
  const double thickness = card->thickness[0] * c.units.length;
  if (const auto* glass = std::get_if<mat::LaminatedGlass>(&c.material_of(part)->law))
    return glass_section(c, part, *glass, *card);
  std::optional<ShellLaw> law = shell_law(c, *c.material_of(part));
  const std::optional<std::vector<ShellPoint>> ruled = ruled_points(c, part, *card);
  if (!law || !ruled) return std::nullopt;
  const int points = std::clamp(card->points, 1, 10);
  const ThicknessRule rule = points > 5 ? ThicknessRule::Lobatto : ThicknessRule::Gauss;
  ShellSection result = is_membrane(card->formulation)
                            ? membrane_section(*law, thickness)
                            : uniform_section(*law, thickness, points, rule);
  if (!ruled->empty() && !is_membrane(card->formulation)) result.layers[0].points = *ruled;
  return result;
}

}  // namespace

std::optional<ShellSection> shell_section(BuildContext& c, const Part& part) {
  std::optional<ShellSection> result = layered_section(c, part);
  if (!result) return result;
  const int formulation = part.composite
                              ? part.composite->formulation
                              : std::get<SectionShell>(c.section_of(part)->law).formulation;
  if (is_full(formulation)) result->integration = ShellIntegration::Full;
  const double reference = part.composite
                               ? part.composite->reference_position
                               : std::get<SectionShell>(c.section_of(part)->law).reference_position;
  if (result->theory == ShellTheory::Bending && reference != 0)
    move_reference(*result, std::clamp(0.5 * reference, -0.5, 0.5));
  if (formulation != 2 && formulation != 16 && !is_membrane(formulation))
    c.note(fmt::format(
        "part {}: shell formulation {} is computed as {}", part.id.value, formulation,
        is_full(formulation) ? "the fully integrated shell (16)" : "Belytschko-Tsay (2)"));
  return result;
}

namespace {

/// Curves of springs usually go on with their last slope.
constexpr Curve::Outside kGoOn = Curve::Outside::LastSlope;

std::optional<LineLaw> discrete_law(BuildContext& c, const Material& material) {
  const UnitFactors& u = c.units;
  const double stiffness = u.force() / u.length;
  if (const auto* m = std::get_if<mat::SpringElastic>(&material.law))
    return CurveLine{.force = Curve({0, 1}, {0, m->stiffness * stiffness}, kGoOn)};
  if (const auto* m = std::get_if<mat::DamperViscous>(&material.law))
    return CurveLine{.linear_damping = m->damping * u.force() / u.velocity()};
  if (const auto* m = std::get_if<mat::SpringNonlinearElastic>(&material.law)) {
    CurveLine law;
    const auto force =
        c.curve(m->curve, u.length, u.force(), material.source, card(material), kGoOn);
    if (!force) return std::nullopt;
    law.force = *force;
    if (m->rate_curve.given()) {
      const auto factor = c.curve(m->rate_curve, u.velocity(), 1, material.source, card(material));
      if (!factor) return std::nullopt;
      law.rate_factor = *factor;
    }
    return law;
  }
  if (const auto* m = std::get_if<mat::DamperNonlinearViscous>(&material.law)) {
    const auto force =
        c.curve(m->curve, u.velocity(), u.force(), material.source, card(material), kGoOn);
    if (!force) return std::nullopt;
    return CurveLine{.damping_force = *force};
  }
  refuse(c, material, "discrete");
  return std::nullopt;
}

std::optional<LineLaw> cable_law(BuildContext& c, const Material& material, double area) {
  const auto* m = std::get_if<mat::CableDiscreteBeam>(&material.law);
  if (m == nullptr) {
    refuse(c, material, "discrete beam (ELFORM 6)");
    return std::nullopt;
  }
  if (m->curve.given()) {
    const auto stress =
        c.curve(m->curve, 1, c.units.stress() * area, material.source, card(material), kGoOn);
    if (!stress) return std::nullopt;
    return CurveLine{.force = *stress, .is_tension_only = true, .is_strain_based = true};
  }
  return ElasticLine{.axial_stiffness = m->youngs * c.units.stress() * area,
                     .preload = m->initial_force * c.units.force(),
                     .is_tension_only = true};
}

std::optional<LineLaw> truss_law(BuildContext& c, const Material& material, double area) {
  const UnitFactors& u = c.units;
  if (const auto* m = std::get_if<mat::Elastic>(&material.law); m != nullptr && !m->is_fluid)
    return ElasticLine{.axial_stiffness = m->youngs * u.stress() * area};
  if (const auto* m = std::get_if<mat::Muscle>(&material.law)) {
    HillMuscle law{.area = area,
                   .peak_stress = m->peak_stress * u.stress(),
                   .passive_strain = m->passive_strain,
                   .passive_exponent = m->passive_exponent,
                   .maximum_rate = m->maximum_rate / u.time,
                   .damping = m->damping * u.stress() * u.time * area,
                   .initial_stretch = m->initial_stretch > 0 ? m->initial_stretch : 1.0};
    if (m->activation > 0) {
      law.activation = Curve({0}, {m->activation});
    } else if (m->activation < 0) {
      const double number = std::min(-m->activation, 2147483647.0);
      const auto a = c.curve(DeckId(static_cast<std::int32_t>(number)), u.time, 1, material.source,
                             card(material));
      if (!a) return std::nullopt;
      law.activation = *a;
    }
    return law;
  }
  refuse(c, material, "truss (ELFORM 3)");
  return std::nullopt;
}

}  // namespace

std::optional<LineProperties> line_properties(BuildContext& c, const Part& part) {
  const std::string who = fmt::format("*PART {}", part.id.value);
  const Section* section = c.section_of(part);
  const Material& material = *c.material_of(part);
  LineProperties properties;
  std::optional<LineLaw> law;
  if (section != nullptr && std::holds_alternative<SectionDiscrete>(section->law)) {
    law = discrete_law(c, material);
  } else if (const auto* beam =
                 section == nullptr ? nullptr : std::get_if<SectionBeam>(&section->law)) {
    const double square = c.units.length * c.units.length;
    const double density = material.density * c.units.density();
    if (beam->formulation == 3) {
      law = truss_law(c, material, beam->area * square);
      properties.length_density = density * beam->area * square;
    } else if (beam->formulation == 6) {
      law = cable_law(c, material, beam->cable_area * square);
      properties.length_density = density * beam->cable_area * square;
    } else {
      c.problem(part.source, who, "a truss (ELFORM 3) or cable (6) section",
                fmt::format("beam formulation {}", beam->formulation));
      return std::nullopt;
    }
  } else {
    c.problem(part.source, who, "a *SECTION_BEAM or *SECTION_DISCRETE", "none");
    return std::nullopt;
  }
  if (!law) return std::nullopt;
  properties.law = *law;
  return properties;
}

ElementControls element_controls(BuildContext& c, const Part& part) {
  ElementControls controls;
  const Control& control = c.deck.control;
  int type = control.hourglass ? control.hourglass->type : 1;
  controls.hourglass_coefficient = control.hourglass ? control.hourglass->coefficient : 0.1;
  if (control.bulk_viscosity) {
    controls.quadratic_bulk = control.bulk_viscosity->quadratic;
    controls.linear_bulk = control.bulk_viscosity->linear;
  }
  if (const auto found = c.hourglasses.find(part.hourglass); found != c.hourglasses.end()) {
    const Hourglass& hourglass = *found->second;
    if (hourglass.type != 0) type = hourglass.type;
    controls.hourglass_coefficient = hourglass.coefficient;
  }
  // 0..3 are viscous forms, 4 and more stiffness forms [hallquist2006, 3.2].
  controls.hourglass = type <= 3 ? HourglassForm::Viscous : HourglassForm::Stiffness;
  controls.precision = c.options.precision;
  return controls;
}

}  // namespace crosswalk::fe
