// *MAT_ cards of line elements: beams, cables, springs, dampers, muscles, belts.
#include "fe_node/deck/cards_material.h"

namespace crosswalk::fe::mat {

namespace {

/// MID and RO of beam laws.
void head(CardIo& io, Material& material) {
  io.card();
  io.id("MID", material.id);
  io.real("RO", material.density);
}

/// MID of laws without a density.
void spring_head(CardIo& io, Material& material) {
  io.card();
  io.id("MID", material.id);
}

}  // namespace

void cards(CardIo& io, Material& material, CableDiscreteBeam& law) {
  head(io, material);
  io.real("E", law.youngs);
  io.id("LCID", law.curve);
  io.real("F0", law.initial_force);
  io.real("TMAXF0", law.force_time);
  io.real("TRAMP", law.ramp_time);
  io.integer("IREAD", law.extra_card);
  if (law.extra_card <= 1) return;
  io.card();
  io.real("OUTPUT", law.output);
  io.real("TSTART", law.start_time);
  io.real("FRACL0", law.length_fraction);
  io.real_or("MXEPS", law.failure_strain, kNever);
  io.real_or("MXFRC", law.failure_force, kNever);
}

void cards(CardIo& io, Material& material, Spotweld& law) {
  head(io, material);
  io.real("E", law.youngs);
  io.real("PR", law.poisson);
  io.real("SIGY", law.yield);
  io.real("EH", law.hardening);
  io.real("DT", law.minimum_step);
  io.real("TFAIL", law.failure_time);
  io.card();
  io.real("EFAIL", law.failure_strain);
  io.reals("N/M", law.failure_resultants);
  io.real("NF", law.filter);
}

void cards(CardIo& io, Material& material, Nonlinear6DofBeam& law) {
  head(io, material);
  io.real("KT", law.translational);
  io.real("KR", law.rotational);
  io.real("UNLDOPT", law.unloading_option);
  io.real("OFFSET", law.offset);
  io.real("DAMPF", law.damping_factor);
  io.real("IFLAG", law.flag);
  io.card();
  io.ids("LCIDT", law.load);
  io.card();
  io.ids("LCIDTU", law.unload);
  io.card();
  io.ids("LCIDTD", law.damping);
  io.card();
  io.ids("LCIDTE", law.damping_scale);
  io.card();
  io.reals("UTFAIL", law.tension_failure);
  io.card();
  io.reals("UCFAIL", law.compression_failure);
  io.card();
  io.reals("IU", law.initial);
}

void cards(CardIo& io, Material& material, Nonlinear1DofBeam& law) {
  head(io, material);
  io.real("K", law.stiffness);
  io.real("UNLDOPT", law.unloading_option);
  io.real("OFFSET", law.offset);
  io.real("DAMPF", law.damping_factor);
  io.card();
  io.id("LCIDT", law.load);
  io.id("LCIDTU", law.unload);
  io.id("LCIDTD", law.damping);
  io.id("LCIDTE", law.damping_scale);
  io.card();
  io.real("UTFAIL", law.tension_failure);
  io.real("UCFAIL", law.compression_failure);
  io.real("IU", law.initial);
}

void cards(CardIo& io, Material& material, Muscle& law) {
  head(io, material);
  io.real_or("SNO", law.initial_stretch, 1);
  io.real("SRM", law.maximum_rate);
  io.real("PIS", law.peak_stress);
  io.real("SSM", law.passive_strain);
  io.real("CER", law.passive_exponent);
  io.real("DMP", law.damping);
  io.card();
  io.real("ALM", law.activation);
  io.real_or("SFR", law.stretch_scale, 1);
  io.real_or("SVS", law.stretch_factor, 1);
  io.real_or("SVR", law.rate_factor, 1);
  io.real("SSP", law.passive_factor);
}

void cards(CardIo& io, Material& material, Seatbelt& law) {
  spring_head(io, material);
  io.real("MPUL", law.length_mass);
  io.id("LLCID", law.load);
  io.id("ULCID", law.unload);
  io.real("LMIN", law.minimum_length);
  io.real("CSE", law.compression_off);
  io.real("DAMP", law.damping);
  io.real("E", law.youngs);
}

void cards(CardIo& io, Material& material, SpringElastic& law) {
  spring_head(io, material);
  io.real("K", law.stiffness);
}

void cards(CardIo& io, Material& material, DamperViscous& law) {
  spring_head(io, material);
  io.real("DC", law.damping);
}

void cards(CardIo& io, Material& material, SpringElastoplastic& law) {
  spring_head(io, material);
  io.real("K", law.stiffness);
  io.real("KT", law.tangent);
  io.real("FY", law.yield_force);
}

void cards(CardIo& io, Material& material, SpringNonlinearElastic& law) {
  spring_head(io, material);
  io.id("LCD", law.curve);
  io.id("LCR", law.rate_curve);
}

void cards(CardIo& io, Material& material, DamperNonlinearViscous& law) {
  spring_head(io, material);
  io.id("LCDR", law.curve);
}

void cards(CardIo& io, Material& material, SpringGeneralNonlinear& law) {
  spring_head(io, material);
  io.id("LCDL", law.load);
  io.id("LCDU", law.unload);
  io.real("BETA", law.hardening);
  io.real("TYI", law.tension_yield);
  io.real("CYI", law.compression_yield);
}

void cards(CardIo& io, Material& material, SpringMaxwell& law) {
  spring_head(io, material);
  io.real("K0", law.stiffness_short);
  io.real("KI", law.stiffness_long);
  io.real("BETA", law.decay);
  io.real_or("TC", law.tension_limit, kNever);
  io.real_or("FC", law.compression_limit, kNever);
  io.real("COPT", law.option);
}

void cards(CardIo& io, Material& material, SpringInelastic& law) {
  spring_head(io, material);
  io.id("LCFD", law.curve);
  io.real("KU", law.unload_stiffness);
  io.real_or("CTF", law.direction, 1);
}

void cards(CardIo& io, Material& material, SpringMuscle& law) {
  spring_head(io, material);
  io.real_or("L0", law.initial_length, 1);
  io.real("VMAX", law.maximum_speed);
  io.real_or("SV", law.speed_scale, 1);
  io.real("A", law.activation);
  io.real("FMAX", law.peak_force);
  io.real_or("TL", law.tension_length, 1);
  io.real_or("TV", law.tension_speed, 1);
  io.card();
  io.real("FPE", law.passive);
  io.real("LMAX", law.maximum_length);
  io.real("KSH", law.shape);
}

void cards(CardIo& io, Material& material, Unsupported& law) {
  if (io.is_reading()) {
    while (io.has_card()) io.raw_line(law.cards.emplace_back());
    return;
  }
  (void)material;
  for (std::string& card : law.cards) io.raw_line(card);
}

}  // namespace crosswalk::fe::mat
