// *MAT_ cards of continua: solids, shells, rigid.
#include "fe_node/deck/cards_material.h"

namespace crosswalk::fe::mat {

namespace {

/// MID and RO, the first two fields of every law.
void head(CardIo& io, Material& material) {
  io.card();
  io.id("MID", material.id);
  io.real("RO", material.density);
}

void shear_terms(CardIo& io, std::vector<PronyTerm>& terms) {
  io.rows(terms, [&io](PronyTerm& term) {
    io.card();
    io.real("GI", term.shear);
    io.real("BETAI", term.shear_decay);
  });
}

void specimen(CardIo& io, auto& law) {
  io.card();
  io.real("SGL", law.specimen_length);
  io.real("SW", law.specimen_width);
  io.real("ST", law.specimen_thickness);
  io.id("LCID1", law.curve);
  io.real("DATA", law.data_type);
  io.id("LCID2", law.relaxation_curve);
  io.real("BSTART", law.fit_start);
  io.real("TRAMP", law.ramp);
}

/// First card of both rubbers of law 077.
void rubber_head(CardIo& io, Material& material, auto& law) {
  head(io, material);
  io.real("PR", law.poisson);
  io.integer("N", law.fitted_terms);
  io.integer("NV", law.prony_terms);
  io.real("G", law.shear_friction);
  io.real("SIGF", law.friction_stress);
  io.real("REF", law.reference);
}

}  // namespace

void cards(CardIo& io, Material& material, Elastic& law) {
  head(io, material);
  io.real("E", law.youngs);
  io.real("PR", law.poisson);
  io.real("DA", law.axial_damping);
  io.real("DB", law.bending_damping);
  io.real("K", law.bulk);
  if (!law.is_fluid) return;
  io.card();
  io.real("VC", law.viscosity_coefficient);
  io.real_or("CP", law.cavitation_pressure, kNever);
}

void cards(CardIo& io, Material& material, PlasticKinematic& law) {
  head(io, material);
  io.real("E", law.youngs);
  io.real("PR", law.poisson);
  io.real("SIGY", law.yield);
  io.real("ETAN", law.tangent);
  io.real("BETA", law.hardening);
  io.card();
  io.real("SRC", law.rate_c);
  io.real("SRP", law.rate_p);
  io.real_or("FS", law.failure_strain, kNever);
  io.real("VP", law.viscoplastic);
}

void cards(CardIo& io, Material& material, Viscoelastic& law) {
  head(io, material);
  io.real("BULK", law.bulk);
  io.real("G0", law.shear_short);
  io.real("GI", law.shear_long);
  io.real("BETA", law.decay);
}

void cards(CardIo& io, Material& material, Null& law) {
  head(io, material);
  io.real("PC", law.pressure_cutoff);
  io.real("MU", law.viscosity);
  io.real("TEROD", law.erosion_tension);
  io.real("CEROD", law.erosion_compression);
  io.real("YM", law.youngs);
  io.real("PR", law.poisson);
}

void cards(CardIo& io, Material& material, Rigid& law) {
  head(io, material);
  io.real("E", law.youngs);
  io.real("PR", law.poisson);
  io.real("N", law.coupling_n);
  io.real("COUPLE", law.coupling);
  io.text("M", law.coupling_m);
  io.card();
  io.real("CMO", law.constraint_option);
  io.real("CON1", law.constraint_1);
  io.real("CON2", law.constraint_2);
  io.card();
  io.reals("A/V", law.axes);
}

void cards(CardIo& io, Material& material, PiecewiseLinearPlasticity& law) {
  head(io, material);
  io.real("E", law.youngs);
  io.real("PR", law.poisson);
  io.real("SIGY", law.yield);
  io.real("ETAN", law.tangent);
  io.real_or("FAIL", law.failure_strain, kNever);
  io.real("TDEL", law.minimum_step);
  io.card();
  io.real("C", law.rate_c);
  io.real("P", law.rate_p);
  io.id("LCSS", law.stress_curve);
  io.id("LCSR", law.rate_curve);
  io.real("VP", law.viscoplastic);
  io.id("LCF", law.failure_curve);
  io.card();
  io.reals("EPS", law.strain);
  io.card();
  io.reals("ES", law.stress);
}

void cards(CardIo& io, Material& material, MooneyRivlin& law) {
  head(io, material);
  io.real("PR", law.poisson);
  io.real("A", law.a);
  io.real("B", law.b);
  io.real("REF", law.reference);
  io.card();
  io.real("SGL", law.specimen_length);
  io.real("SW", law.specimen_width);
  io.real("ST", law.specimen_thickness);
  io.id("LCID", law.curve);
}

void cards(CardIo& io, Material& material, LaminatedGlass& law) {
  head(io, material);
  io.real("EG", law.glass_youngs);
  io.real("PRG", law.glass_poisson);
  io.real("SYG", law.glass_yield);
  io.real("ETG", law.glass_tangent);
  io.real("EFG", law.glass_failure_strain);
  io.real("EP", law.polymer_youngs);
  io.card();
  io.real("PRP", law.polymer_poisson);
  io.real("SYP", law.polymer_yield);
  io.real("ETP", law.polymer_tangent);
  // Eight flags a line; written in full lines, so zeros at the end are kept as read.
  if (io.is_reading()) {
    while (io.has_content()) {
      io.card();
      for (int i = 0; i < 8; ++i) io.real("F", law.layer_is_polymer.emplace_back(0.0));
    }
    return;
  }
  law.layer_is_polymer.resize((law.layer_is_polymer.size() + 7) / 8 * 8, 0.0);
  for (std::size_t i = 0; i < law.layer_is_polymer.size(); ++i) {
    if (i % 8 == 0) io.card();
    io.real("F", law.layer_is_polymer[i]);
  }
}

namespace {
void fabric_axes(CardIo& io, Fabric& law) {
  io.card();
  io.real("AOPT", law.axes_option);
  io.real("FLC", law.leak_coefficient);
  io.real("FAC", law.leak_area);
  io.real("ELA", law.blocked_area);
  io.real("LNRC", law.no_compression);
  io.integer("FORM", law.form);
  io.real("FVOPT", law.leak_law);
  io.real("TSRFAC", law.stress_free_factor);
  io.card();
  io.skip();
  io.real("RGBRTH", law.reference_birth);
  io.real("A0REF", law.reference_area);
  io.reals("A", law.a);
  io.reals("X", law.cut);
  io.card();
  io.reals("V", law.v);
  io.skip(30);
  io.real("BETA", law.angle_deg);
  io.real("ISREFG", law.reference_stress);
}
}  // namespace

void cards(CardIo& io, Material& material, Fabric& law) {
  head(io, material);
  io.real("EA", law.ea);
  io.real("EB", law.eb);
  io.skip();
  io.real("PRBA", law.prba);
  io.real("PRAB", law.prab);
  io.card();
  io.real("GAB", law.gab);
  io.skip(20);
  io.real("CSE", law.compression_off);
  io.real("EL", law.liner_youngs);
  io.real("PRL", law.liner_poisson);
  io.real("LRATIO", law.liner_ratio);
  io.real("DAMP", law.damping);
  fabric_axes(io, law);
  const int form = law.form < 0 ? -law.form : law.form;
  if (form != 4 && form != 14 && form != 24) return;
  io.card();
  io.id("LCA", law.load_a);
  io.id("LCB", law.load_b);
  io.id("LCAB", law.shear);
  io.id("LCUA", law.unload_a);
  io.id("LCUB", law.unload_b);
  io.id("LCUAB", law.unload_shear);
  io.real("RL", law.reload);
  if (law.form >= 0) return;
  io.card();
  io.id("LCAA", law.rate_a);
  io.id("LCBB", law.rate_b);
  io.real("H", law.hysteresis);
  io.real("DT", law.rate_cutoff);
  io.skip();
  io.real("ECOAT", law.coat_youngs);
  io.real("SCOAT", law.coat_strength);
  io.real("TCOAT", law.coat_thickness);
}

void cards(CardIo& io, Material& material, LowDensityFoam& law) {
  head(io, material);
  io.real("E", law.youngs);
  io.id("LCID", law.curve);
  io.real_or("TC", law.tension_cutoff, kNever);
  io.real("HU", law.hysteresis);
  io.real("BETA", law.decay);
  io.real("DAMP", law.damping);
  io.card();
  io.real_or("SHAPE", law.shape, 1);
  io.real("FAIL", law.failure);
  io.real("BVFLAG", law.bulk_viscosity);
  io.real("ED", law.relaxation_youngs);
  io.real("BETA1", law.relaxation_decay);
  io.real("KCON", law.contact_stiffness);
  io.real("REF", law.reference);
}

void cards(CardIo& io, Material& material, KelvinMaxwell& law) {
  head(io, material);
  io.real("BULK", law.bulk);
  io.real("G0", law.shear_short);
  io.real("GI", law.shear_long);
  io.real("DC", law.decay);
  io.real("FO", law.formulation);
  io.real("SO", law.strain_output);
}

void cards(CardIo& io, Material& material, GeneralViscoelastic& law) {
  head(io, material);
  io.real("BULK", law.bulk);
  io.real("PCF", law.pressure_cutoff);
  io.real("EF", law.formulation);
  io.real("TREF", law.temperature);
  io.real("A", law.shift_a);
  io.real("B", law.shift_b);
  io.card();
  io.id("LCID", law.shear_curve);
  io.integer("NT", law.shear_terms);
  io.real("BSTART", law.fit_start);
  io.real("TRAMP", law.ramp);
  io.id("LCIDK", law.bulk_curve);
  io.integer("NTK", law.bulk_terms);
  io.real("BSTARTK", law.bulk_fit_start);
  io.real("TRAMPK", law.bulk_ramp);
  io.rows(law.terms, [&io](PronyTerm& term) {
    io.card();
    io.real("GI", term.shear);
    io.real("BETAI", term.shear_decay);
    io.real("KI", term.bulk);
    io.real("BETAKI", term.bulk_decay);
  });
}

void cards(CardIo& io, Material& material, HyperelasticRubber& law) {
  rubber_head(io, material, law);
  if (law.fitted_terms > 0) {
    specimen(io, law);
  } else {
    io.card();
    io.real("C10", law.c10);
    io.real("C01", law.c01);
    io.real("C11", law.c11);
    io.real("C20", law.c20);
    io.real("C02", law.c02);
    io.real("C30", law.c30);
  }
  shear_terms(io, law.terms);
}

void cards(CardIo& io, Material& material, OgdenRubber& law) {
  rubber_head(io, material, law);
  if (law.fitted_terms > 0) {
    specimen(io, law);
  } else {
    io.card();
    io.reals("MU", law.mu);
    io.card();
    io.reals("ALPHA", law.alpha);
  }
  bool is_first = true;
  io.rows(law.terms, [&](PronyTerm& term) {
    io.card();
    io.real("GI", term.shear);
    io.real("BETAI", term.shear_decay);
    if (is_first) io.integer("VFLAG", law.viscous_form);
    is_first = false;
  });
}

void cards(CardIo& io, Material& material, FuChangFoam& law) {
  head(io, material);
  io.real("E", law.youngs);
  io.real("KCON", law.contact_stiffness);
  io.real_or("TC", law.tension_cutoff, kNever);
  io.real("FAIL", law.failure);
  io.real("DAMP", law.damping);
  io.id("TBID", law.table);
  io.card();
  io.real("BVFLAG", law.bulk_viscosity);
  io.real("SFLAG", law.rate_option);
  io.real("RFLAG", law.rate_type);
  io.real("TFLAG", law.tension_option);
  io.id("PVID", law.viscous_part);
  io.real("SRAF", law.rate_averaging);
  io.real("REF", law.reference);
  io.real("HU", law.hysteresis);
  io.card();
  io.reals("D0/N", law.d);
  for (std::size_t i = 0; i < 3; ++i) io.real("C", law.c[i]);
  io.card();
  for (std::size_t i = 3; i < 6; ++i) io.real("C", law.c[i]);
  io.real("AIJ", law.aij);
  io.real("SIJ", law.sij);
  io.real("MINR", law.minimum_rate);
  io.real("MAXR", law.maximum_rate);
  io.real("SHAPE", law.shape);
  if (!io.has_optional(law.exponent != 0 || law.unloading != 0)) return;
  io.card();
  io.real("EXPON", law.exponent);
  io.real("RIULD", law.unloading);
}

void cards(CardIo& io, Material& material, SoftTissue& law) {
  head(io, material);
  io.reals("C", law.c);
  io.card();
  io.real("XK", law.bulk);
  io.real("XLAM", law.straight_stretch);
  io.real("FANG", law.fiber_angle_deg);
  io.real("XLAM0", law.initial_stretch);
  io.real("FAILSF", law.failure_strength);
  io.real("FAILSM", law.failure_matrix);
  io.real("FAILSHR", law.failure_shear);
  io.card();
  io.real("AOPT", law.axes_option);
  io.reals("AX/BX", law.axes);
  io.card();
  io.reals("LA", law.local_fiber);
  io.integer("MACF", law.axes_change);
  if (!law.is_viscous) return;
  io.card();
  io.reals("S", law.s);
  io.card();
  io.reals("T", law.t);
}

void cards(CardIo& io, Material& material, PlasticityCompressionTension& law) {
  head(io, material);
  io.real("E", law.youngs);
  io.real("PR", law.poisson);
  io.real("C", law.rate_c);
  io.real("P", law.rate_p);
  io.real_or("FAIL", law.failure_strain, kNever);
  io.real("TDEL", law.minimum_step);
  io.card();
  io.id("LCIDC", law.compression_curve);
  io.id("LCIDT", law.tension_curve);
  io.id("LCSRC", law.compression_rate_curve);
  io.id("LCSRT", law.tension_rate_curve);
  io.real("SRFLAG", law.rate_option);
  io.id("LCFAIL", law.failure_curve);
  io.real("EC", law.compression_youngs);
  io.real("RPCT", law.transition);
  io.card();
  io.real("PC", law.mean_compression);
  io.real("PT", law.mean_tension);
  io.real("PCUTC", law.cutoff_compression);
  io.real("PCUTT", law.cutoff_tension);
  io.real("PCUTF", law.cutoff_option);
  io.card();
  io.real("K", law.bulk);
  shear_terms(io, law.terms);
}

void cards(CardIo& io, Material& material, HillFoam& law) {
  head(io, material);
  io.real("K", law.bulk);
  io.real("N", law.n);
  io.real("MU", law.damping);
  io.id("LCID", law.curve);
  io.real_or("FITTYPE", law.fit_type, 1);
  io.id("LCSR", law.ratio_curve);
  if (!law.curve.given()) {
    io.card();
    io.reals("C", law.c);
    io.card();
    io.reals("B", law.b);
  }
  io.card();
  io.real("R", law.mullins_r);
  io.real("M", law.mullins_m);
}

void cards(CardIo& io, Material& material, SimplifiedRubber& law) {
  head(io, material);
  io.real("KM", law.bulk);
  io.real("MU", law.damping);
  io.real("G", law.shear);
  io.real("SIGF", law.friction_stress);
  io.real("REF", law.reference);
  io.real("PRTEN", law.principal_tension);
  io.card();
  io.real("SGL", law.specimen_length);
  io.real("SW", law.specimen_width);
  io.real("ST", law.specimen_thickness);
  io.id("LC/TBID", law.curve);
  io.real("TENSION", law.tension);
  io.real("RTYPE", law.rate_type);
  io.real("AVGOPT", law.averaging);
  io.real("PR/BETA", law.poisson);
  io.card();
  io.id("LCUNLD", law.unload_curve);
  io.real("HU", law.hysteresis);
  io.real("SHAPE", law.shape);
  io.real("STOL", law.tolerance);
  io.real("VISCO", law.viscous);
  io.real("HISOUT", law.output);
}

}  // namespace crosswalk::fe::mat
