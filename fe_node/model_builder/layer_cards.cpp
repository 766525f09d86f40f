#include "fe_node/model_builder/layer_cards.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fe_node/model_builder/plastic_cards.h"

namespace crosswalk::fe {
namespace {

ShellPlastic interlayer(const mat::LaminatedGlass& m, double density, double stress) {
  ShellPlastic law;
  law.density = density;
  law.youngs_modulus = m.polymer_youngs * stress;
  law.poisson_ratio = m.polymer_poisson;
  law.yield = YieldStress(HardeningCurve::linear(
      m.polymer_yield * stress, hardening_modulus(m.polymer_youngs, m.polymer_tangent) * stress));
  return law;
}

ShellGlass pane(const mat::LaminatedGlass& m, double density, double stress) {
  ShellGlass law;
  law.density = density;
  law.youngs_modulus = m.glass_youngs * stress;
  law.poisson_ratio = m.glass_poisson;
  law.strength = m.glass_yield * stress;
  law.fracture = m.glass_yield > 0 ? GlassFracture::Local : GlassFracture::Off;
  return law;
}

/// Plies of equal thickness, two Gauss points in a pane and one in an interlayer.
ShellSection equal_plies(const std::vector<double>& flags, const ShellLaw& glass,
                         const ShellLaw& polymer, double thickness) {
  std::vector<Ply> plies;
  for (double flag : flags) {
    const bool is_polymer = flag > 0.5;
    plies.push_back({is_polymer ? polymer : glass, thickness / static_cast<double>(flags.size()),
                     is_polymer ? 1 : 2});
  }
  return laminate(plies);
}

}  // namespace

std::optional<std::vector<ShellPoint>> ruled_points(BuildContext& c, const Part& part,
                                                    const SectionShell& card) {
  std::vector<ShellPoint> points;
  if (!(card.rule < 0)) return points;
  const double number = std::min(-card.rule, 2147483647.0);
  const DeckId id(static_cast<std::int32_t>(std::lround(number)));
  const std::string who = fmt::format("*INTEGRATION_SHELL {} of part {}", id.value, part.id.value);
  const IntegrationShell* rule = nullptr;
  for (const IntegrationShell& candidate : c.deck.integrations)
    if (candidate.id == id) rule = &candidate;
  if (rule == nullptr) {
    c.problem(part.source, who, "a rule of the deck", "none");
    return std::nullopt;
  }
  double weights = 0;
  for (const IntegrationPoint& row : rule->rows) {
    points.push_back({0.5 * row.position, row.weight});
    weights += row.weight;
    if (row.part.given() && row.part != part.id) {
      c.problem(rule->source, who, "points of the part's own material",
                fmt::format("one of part {}", row.part.value), "use *PART_COMPOSITE");
      return std::nullopt;
    }
  }
  constexpr int kMostPoints = 1000;
  if (rule->equally_spaced == 1 && (rule->points < 1 || rule->points > kMostPoints)) {
    c.problem(rule->source, who + " field NIP", fmt::format("1 .. {} points", kMostPoints),
              fmt::format("{}", rule->points));
    return std::nullopt;
  }
  if (rule->equally_spaced == 1)
    for (int i = 0; i < rule->points; ++i)
      points.push_back({(i + 0.5) / rule->points - 0.5, 1.0 / rule->points});
  constexpr double kRounded = 1e-3;  // ten-column cards round the weights
  if (rule->equally_spaced != 1 && std::abs(weights - 1) > kRounded) {
    c.problem(rule->source, who, "weights that sum to one", fmt::format("{:g}", weights));
    return std::nullopt;
  }
  return points;
}

std::optional<ShellSection> glass_section(BuildContext& c, const Part& part,
                                          const mat::LaminatedGlass& m, const SectionShell& card) {
  const Material& material = *c.material_of(part);
  const double density = material.density * c.units.density(), stress = c.units.stress();
  const double thickness = card.thickness[0] * c.units.length;
  const std::string who = fmt::format("*MAT_LAMINATED_GLASS {}", material.id.value);
  const std::optional<std::vector<ShellPoint>> points = ruled_points(c, part, card);
  if (!points) return std::nullopt;
  const std::vector<double> flags =
      m.layer_is_polymer.empty() ? std::vector<double>{0, 1, 0} : m.layer_is_polymer;
  if (!points->empty() && points->size() > flags.size()) {
    c.problem(material.source, who + " flags F1..",
              fmt::format("{}, one per point", points->size()), fmt::format("{}", flags.size()));
    return std::nullopt;
  }
  if (!(m.glass_youngs > 0) || !(m.polymer_youngs > 0)) {
    c.problem(material.source, who, "positive moduli EG and EP",
              fmt::format("{:g} and {:g}", m.glass_youngs, m.polymer_youngs));
    return std::nullopt;
  }
  const ShellGlass glass = pane(m, density, stress);
  if (!(m.polymer_yield > 0)) {
    c.problem(material.source, who + " field SYP", "a positive yield stress of the interlayer",
              fmt::format("{:g}", m.polymer_yield));
    return std::nullopt;
  }
  c.note(
      fmt::format("{}: panes crack where the principal tension has stood above SYG for {:g} us, "
                  "and the faces of cracks rub with a friction of {:g} (an estimate); EFG and ETG "
                  "are not used",
                  who, 1e6 * glass.delay, glass.friction));
  const ShellLaw polymer = interlayer(m, density, stress);
  if (points->empty()) {
    c.note(fmt::format("{}: {} plies of equal thickness, for want of an *INTEGRATION_SHELL", who,
                       flags.size()));
    return equal_plies(flags, glass, polymer, thickness);
  }
  ShellSection section;
  section.thickness = thickness;
  const auto is_polymer = [&flags](std::size_t point) { return flags[point] > 0.5; };
  for (std::size_t i = 0; i < points->size(); ++i) {
    if (i == 0 || is_polymer(i) != is_polymer(i - 1))
      section.layers.push_back({is_polymer(i) ? polymer : ShellLaw(glass), {}});
    section.layers.back().points.push_back((*points)[i]);
  }
  section.shear_factor = series_shear_factor(section);
  return section;
}

}  // namespace crosswalk::fe
