#include "fe_node/model_builder/plastic_cards.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace crosswalk::fe {
namespace {

std::string card(const Material& material) {
  return fmt::format("*{} {}", material_keyword(material), material.id.value);
}

/// What plasticity needs of a card, SI.
struct PlasticCard {
  double youngs = 0, poisson = 0;
  YieldStress yield;
  double kinematic_modulus = 0, failure_strain = 0;
};

/// Plastic strain from zero: an earlier point is prepended where the curve starts later.
HardeningCurve hardening(const Curve& curve) {
  std::vector<double> x(curve.x().begin(), curve.x().end()), y(curve.y().begin(), curve.y().end());
  if (x.front() > 0) {
    x.insert(x.begin(), 0.0);
    y.insert(y.begin(), y.front());
  }
  return {x, y};
}

class PlasticReader {
 public:
  PlasticReader(BuildContext& context, const Material& material)
      : c_(context), material_(material), stress_(context.units.stress()) {}

  std::optional<PlasticCard> read() {
    try {
      if (const auto* m = std::get_if<mat::PlasticKinematic>(&material_.law)) return kinematic(*m);
      if (const auto* m = std::get_if<mat::PiecewiseLinearPlasticity>(&material_.law))
        return piecewise(*m);
    } catch (const std::invalid_argument& reason) {
      c_.problem(material_.source, card(material_), "a hardening law that can be run",
                 reason.what());
    }
    return std::nullopt;
  }

 private:
  PlasticCard kinematic(const mat::PlasticKinematic& m) {
    PlasticCard out{m.youngs * stress_, m.poisson, {}, 0, failure(m.failure_strain)};
    const double modulus = hardening_modulus(m.youngs, m.tangent) * stress_;
    const double share = std::clamp(m.hardening, 0.0, 1.0);
    out.yield = YieldStress(HardeningCurve::linear(m.yield * stress_, share * modulus));
    out.yield.set_cowper_symonds(m.rate_c / c_.units.time, m.rate_p);
    out.kinematic_modulus = (1 - share) * modulus;
    return out;
  }

  std::optional<PlasticCard> piecewise(const mat::PiecewiseLinearPlasticity& m) {
    PlasticCard out{m.youngs * stress_, m.poisson, {}, 0, failure(m.failure_strain)};
    if (m.stress_curve.given()) {
      const std::optional<YieldStress> yield = curve_or_table(m.stress_curve);
      if (!yield) return std::nullopt;
      out.yield = *yield;
    } else if (const std::optional<HardeningCurve> points = point_list(m)) {
      out.yield = YieldStress(*points);
    } else {
      out.yield = YieldStress(HardeningCurve::linear(
          m.yield * stress_, hardening_modulus(m.youngs, m.tangent) * stress_));
    }
    out.yield.set_cowper_symonds(m.rate_c / c_.units.time, m.rate_p);
    if (m.rate_curve.given() || m.failure_curve.given())
      c_.note(card(material_) + ": LCSR and LCF are not used");
    return out;
  }

  static double failure(double strain) { return strain > 0 && strain < kNever ? strain : 0; }

  std::optional<HardeningCurve> point_list(const mat::PiecewiseLinearPlasticity& m) const {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < m.strain.size(); ++i)
      if (m.stress[i] > 0 && (x.empty() || m.strain[i] > x.back())) {
        x.push_back(m.strain[i]);
        y.push_back(m.stress[i] * stress_);
      }
    if (x.empty()) return std::nullopt;
    if (x.front() > 0) {
      x.insert(x.begin(), 0.0);
      y.insert(y.begin(), y.front());
    }
    return HardeningCurve(x, y);
  }

  std::optional<YieldStress> curve_or_table(DeckId id) {
    const auto table = std::find_if(c_.deck.tables.begin(), c_.deck.tables.end(),
                                    [&](const DeckTable& t) { return t.id == id; });
    if (table == c_.deck.tables.end()) {
      const auto curve = c_.curve(id, 1, stress_, material_.source, card(material_));
      if (!curve) return std::nullopt;
      return YieldStress(hardening(*curve));
    }
    // a negative first value marks natural logarithms of the rates
    const double scale = table->scale != 0 ? table->scale : 1;
    const bool is_logarithmic =
        !table->values.empty() && scale * (table->values.front() + table->offset) < 0;
    std::vector<double> rates;
    std::vector<HardeningCurve> curves;
    for (std::size_t i = 0; i < table->values.size(); ++i) {
      const double value = scale * (table->values[i] + table->offset);
      rates.push_back((is_logarithmic ? std::exp(value) : value) / c_.units.time);
      const auto curve = c_.curve(table->curves[i], 1, stress_, material_.source, card(material_));
      if (!curve) return std::nullopt;
      curves.push_back(hardening(*curve));
    }
    return YieldStress(std::move(rates), std::move(curves));
  }

  BuildContext& c_;
  const Material& material_;
  double stress_;
};

Viscoelastic prony(const std::vector<mat::PronyTerm>& terms, const UnitFactors& u) {
  Viscoelastic out;
  for (const mat::PronyTerm& term : terms)
    if (term.shear > 0 && out.term_count < Viscoelastic::kMaxTerms)
      out.terms[out.term_count++] = {term.shear * u.stress(), term.shear_decay / u.time};
  return out;
}

bool fits_curves(BuildContext& c, const Material& material, int fitted_terms) {
  if (fitted_terms == 0) return false;
  c.problem(material.source, card(material) + " field N", "constants (N = 0)",
            "a fit to a test curve");
  return true;
}

std::optional<SolidLaw> ogden(BuildContext& c, const Material& material, const mat::OgdenRubber& m,
                              double density) {
  if (fits_curves(c, material, m.fitted_terms)) return std::nullopt;
  Ogden law;
  law.density = density;
  for (std::size_t i = 0; i < m.mu.size(); ++i)
    if (m.mu[i] != 0 && m.alpha[i] != 0) {
      law.mu[law.term_count] = m.mu[i] * c.units.stress();
      law.alpha[law.term_count++] = m.alpha[i];
    }
  const double equilibrium = law.shear_modulus();
  law.overstress = prony(m.terms, c.units);
  law.bulk = bulk_from_poisson(equilibrium, m.poisson);
  return law;
}

std::optional<SolidLaw> rubber(BuildContext& c, const Material& material,
                               const mat::HyperelasticRubber& m, double density) {
  if (fits_curves(c, material, m.fitted_terms)) return std::nullopt;
  const double s = c.units.stress();
  Rubber law;
  law.density = density;
  law.c10 = m.c10 * s, law.c01 = m.c01 * s, law.c11 = m.c11 * s;
  law.c20 = m.c20 * s, law.c02 = m.c02 * s, law.c30 = m.c30 * s;
  law.bulk = bulk_from_poisson(law.shear_modulus(), m.poisson);
  law.overstress = prony(m.terms, c.units);
  return law;
}

std::optional<SolidLaw> foam(BuildContext& c, const Material& material,
                             const mat::LowDensityFoam& m, double density) {
  const auto curve = c.curve(m.curve, 1, c.units.stress(), material.source, card(material));
  if (!curve) return std::nullopt;
  std::vector<double> x(curve->x().begin(), curve->x().end()),
      y(curve->y().begin(), curve->y().end());
  if (x.front() > 0) {
    x.insert(x.begin(), 0.0);
    y.insert(y.begin(), 0.0);
  }
  Foam law;
  law.density = density;
  law.tension_modulus = m.youngs * c.units.stress();
  law.curve = LaneCurve(x, y);
  if (m.tension_cutoff > 0 && m.tension_cutoff < kNever)
    law.tension_cutoff = m.tension_cutoff * c.units.stress();
  law.unloading_share = m.hysteresis;
  law.shape = m.shape > 0 ? m.shape : 1;
  return law;
}

}  // namespace

double hardening_modulus(double youngs, double tangent) {
  return tangent > 0 && tangent < youngs ? youngs * tangent / (youngs - tangent) : 0;
}

std::optional<SolidLaw> solid_law_of_matter(BuildContext& c, const Material& material) {
  const double density = material.density * c.units.density(), s = c.units.stress();
  if (const auto plastic = PlasticReader(c, material).read())
    return Plastic{density,
                   plastic->youngs / (3 * (1 - 2 * plastic->poisson)),
                   0.5 * plastic->youngs / (1 + plastic->poisson),
                   plastic->yield,
                   plastic->kinematic_modulus,
                   plastic->failure_strain};
  if (const auto* m = std::get_if<mat::OgdenRubber>(&material.law))
    return ogden(c, material, *m, density);
  if (const auto* m = std::get_if<mat::HyperelasticRubber>(&material.law))
    return rubber(c, material, *m, density);
  if (const auto* m = std::get_if<mat::MooneyRivlin>(&material.law); m && !m->curve.given()) {
    Rubber law;
    law.density = density;
    law.c10 = m->a * s, law.c01 = m->b * s;
    law.bulk = bulk_from_poisson(law.shear_modulus(), m->poisson);
    return law;
  }
  if (const auto* m = std::get_if<mat::LowDensityFoam>(&material.law))
    return foam(c, material, *m, density);
  if (const auto* m = std::get_if<mat::Elastic>(&material.law); m && m->is_fluid) {
    Fluid law;
    law.density = density;
    law.bulk = m->bulk * s;
    if (m->cavitation_pressure > 0 && m->cavitation_pressure < kNever)
      law.cavitation_tension = m->cavitation_pressure * s;
    if (m->viscosity_coefficient > 0) c.note(card(material) + ": VC is not used");
    return law;
  }
  return std::nullopt;
}

std::optional<ShellLaw> shell_law_of_matter(BuildContext& c, const Material& material) {
  const auto plastic = PlasticReader(c, material).read();
  if (!plastic) return std::nullopt;
  return ShellPlastic{material.density * c.units.density(),
                      plastic->youngs,
                      plastic->poisson,
                      plastic->yield,
                      plastic->kinematic_modulus,
                      plastic->failure_strain};
}

}  // namespace crosswalk::fe
