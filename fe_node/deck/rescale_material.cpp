// Dimensions of the fields of material laws and equations of state.
#include <fmt/format.h>

#include "fe_node/deck/rescale_units.h"

namespace crosswalk::fe {

namespace {

using namespace mat;

/// One law at a time; false for laws whose dimensions are not known here.
class LawUnits {
 public:
  LawUnits(UnitChange& change, Source source) : c_(change), source_(source) {}

  bool operator()(Elastic& m) {
    c_.stress(m.youngs, m.bulk, m.cavitation_pressure);
    return true;
  }
  bool operator()(PlasticKinematic& m) {
    c_.stress(m.youngs, m.yield, m.tangent);
    c_.rate(m.rate_c);
    return true;
  }
  bool operator()(Viscoelastic& m) {
    c_.stress(m.bulk, m.shear_short, m.shear_long);
    c_.rate(m.decay);
    return true;
  }
  bool operator()(Null& m) {
    c_.stress(m.pressure_cutoff, m.youngs);
    c_.by(c_.u.stress() * c_.u.time, m.viscosity);
    return true;
  }
  bool operator()(Rigid& m) {
    c_.stress(m.youngs);
    return true;
  }
  bool operator()(PiecewiseLinearPlasticity& m) {
    c_.stress(m.youngs, m.yield, m.tangent);
    c_.time(m.minimum_step);
    c_.rate(m.rate_c);
    for (double& stress : m.stress) c_.stress(stress);
    c_.curve_or_rate_table(m.stress_curve, c_.u.stress(), source_);
    c_.curve(m.rate_curve, 1 / c_.u.time, 1, source_);
    c_.curve(m.failure_curve, 1 / c_.u.time, 1, source_);
    return true;
  }
  bool operator()(MooneyRivlin& m) {
    c_.stress(m.a, m.b);
    return !m.curve.given();
  }
  bool operator()(LaminatedGlass& m) {
    c_.stress(m.glass_youngs, m.glass_yield, m.glass_tangent);
    c_.stress(m.polymer_youngs, m.polymer_yield, m.polymer_tangent);
    return true;
  }
  bool operator()(Fabric& m) {
    c_.stress(m.ea, m.eb, m.gab, m.liner_youngs);
    return m.form == 0 && m.leak_coefficient == 0 && m.leak_area == 0;
  }
  bool operator()(LowDensityFoam& m) {
    c_.stress(m.youngs, m.tension_cutoff, m.relaxation_youngs, m.contact_stiffness);
    c_.rate(m.decay, m.relaxation_decay);
    c_.curve(m.curve, 1, c_.u.stress(), source_);
    return true;
  }
  bool operator()(KelvinMaxwell& m) {
    c_.stress(m.bulk, m.shear_short, m.shear_long);
    m.formulation == 0 ? c_.rate(m.decay) : c_.time(m.decay);
    return true;
  }
  bool operator()(CableDiscreteBeam& m) {
    c_.by(m.youngs < 0 ? c_.u.force() / c_.u.length : c_.u.stress(), m.youngs);
    c_.force(m.initial_force, m.failure_force);
    c_.time(m.force_time, m.ramp_time, m.start_time);
    c_.curve(m.curve, 1, c_.u.stress(), source_);
    return true;
  }
  bool operator()(GeneralViscoelastic& m) {
    c_.stress(m.bulk, m.pressure_cutoff);
    c_.time(m.fit_start, m.bulk_fit_start, m.ramp, m.bulk_ramp);
    c_.curve(m.shear_curve, c_.u.time, c_.u.stress(), source_);
    c_.curve(m.bulk_curve, c_.u.time, c_.u.stress(), source_);
    prony(m.terms);
    return true;
  }
  bool operator()(HyperelasticRubber& m) {
    c_.stress(m.c10, m.c01, m.c11, m.c20, m.c02, m.c30);
    return rubber(m);
  }
  bool operator()(OgdenRubber& m) {
    for (double& mu : m.mu) c_.stress(mu);
    return rubber(m);
  }
  bool operator()(Muscle& m) {
    c_.rate(m.maximum_rate);
    c_.stress(m.peak_stress);
    c_.by(c_.u.stress() * c_.u.time, m.damping);
    if (m.activation < 0)
      c_.curve(DeckId(static_cast<std::int32_t>(std::max(m.activation, -2e9)) * -1), c_.u.time, 1,
               source_);
    return m.stretch_factor >= 0 && m.rate_factor >= 0 && m.passive_factor >= 0;
  }
  bool operator()(SpringElastic& m) {
    c_.by(stiffness(), m.stiffness);
    return true;
  }
  bool operator()(DamperViscous& m) {
    c_.by(c_.u.force() / c_.u.velocity(), m.damping);
    return true;
  }
  bool operator()(SpringElastoplastic& m) {
    c_.by(stiffness(), m.stiffness);
    c_.by(stiffness(), m.tangent);
    c_.force(m.yield_force);
    return true;
  }
  bool operator()(SpringNonlinearElastic& m) {
    c_.curve(m.curve, c_.u.length, c_.u.force(), source_);
    c_.curve(m.rate_curve, c_.u.velocity(), 1, source_);
    return true;
  }
  bool operator()(DamperNonlinearViscous& m) {
    c_.curve(m.curve, c_.u.velocity(), c_.u.force(), source_);
    return true;
  }
  bool operator()(SpringInelastic& m) {
    c_.by(stiffness(), m.unload_stiffness);
    c_.curve(m.curve, c_.u.length, c_.u.force(), source_);
    return true;
  }
  template <class Law>
  bool operator()(Law&) {
    return false;
  }

 private:
  double stiffness() const { return c_.u.force() / c_.u.length; }

  bool rubber(auto& m) {
    c_.stress(m.shear_friction, m.friction_stress);
    prony(m.terms);
    return m.fitted_terms == 0;
  }
  void prony(std::vector<PronyTerm>& terms) {
    for (PronyTerm& term : terms) {
      c_.stress(term.shear, term.bulk);
      c_.rate(term.shear_decay, term.bulk_decay);
    }
  }

  UnitChange& c_;
  Source source_;
};

}  // namespace

void rescale_materials(UnitChange& c) {
  for (Material& material : c.deck.materials) {
    c.by(c.u.density(), material.density);
    if (!std::visit(LawUnits(c, material.source), material.law))
      c.refuse(material.source,
               fmt::format("*{} {}", material_keyword(material), material.id.value),
               "a law with fields of unknown units");
  }
  for (EquationOfState& eos : c.deck.equations_of_state) {
    if (auto* polynomial = std::get_if<EosLinearPolynomial>(&eos.law)) {
      for (std::size_t i = 0; i < 4; ++i) c.stress(polynomial->c[i]);  // C4 to C6 have no unit
      c.stress(polynomial->energy);
    } else if (auto* shock = std::get_if<EosGruneisen>(&eos.law)) {
      c.velocity(shock->c);
      c.stress(shock->energy);
    } else {
      c.refuse(eos.source, fmt::format("*EOS {}", eos.id.value), "a tabulated law");
    }
  }
  for (AddErosion& erosion : c.deck.erosions)
    c.refuse(erosion.source, "*MAT_ADD_EROSION", "criteria of several dimensions");
}

}  // namespace crosswalk::fe
