// *PART, *SECTION_, *HOURGLASS, *INTEGRATION_SHELL and *EOS_ cards.
#include "fe_node/deck/cards_part.h"

#include "fe_node/deck/keyword_table.h"
#include "fe_node/deck/number.h"

namespace crosswalk::fe {

void inertia_cards(CardIo& io, PartInertia& inertia) {
  io.card();
  io.vec3({"XC", "YC", "ZC"}, inertia.center);
  io.real("TM", inertia.mass);
  io.integer("IRCS", inertia.axes_kind);
  io.id("NODEID", inertia.center_node);
  io.card();
  io.real("IXX", inertia.ixx);
  io.real("IXY", inertia.ixy);
  io.real("IXZ", inertia.ixz);
  io.real("IYY", inertia.iyy);
  io.real("IYZ", inertia.iyz);
  io.real("IZZ", inertia.izz);
  io.card();
  io.vec3({"VTX", "VTY", "VTZ"}, inertia.velocity);
  io.vec3({"VRX", "VRY", "VRZ"}, inertia.angular_velocity);
  if (inertia.axes_kind != 1) return;
  io.card();
  io.vec3({"XL", "YL", "ZL"}, inertia.x_axis);
  io.vec3({"XLIP", "YLIP", "ZLIP"}, inertia.in_plane);
  io.id("CID", inertia.axes);
}

namespace {

void cards(CardIo& io, PartContact& contact) {
  io.card();
  io.real("FS", contact.static_friction);
  io.real("FD", contact.dynamic_friction);
  io.real("DC", contact.decay);
  io.real("VC", contact.viscous);
  io.real("OPTT", contact.thickness);
  io.real("SFT", contact.thickness_scale);
  io.real("SSF", contact.stiffness_scale);
  io.real("CPARM8", contact.damping_percent);
}

void part_cards(CardIo& io, Part& part) {
  io.line("TITLE", part.title);
  io.card();
  io.id("PID", part.id);
  io.id("SECID", part.section);
  io.id("MID", part.material);
  io.id("EOSID", part.equation_of_state);
  io.id("HGID", part.hourglass);
  io.integer("GRAV", part.gravity_option);
  io.integer("ADPOPT", part.adaptive_option);
  io.id("TMID", part.thermal);
  if (part.inertia) inertia_cards(io, *part.inertia);
  if (part.contact) cards(io, *part.contact);
}

/// Two layers a line: material, thickness, angle, (thermal).
void layer_cards(CardIo& io, std::vector<CompositeLayer>& layers) {
  const auto layer = [&io](CompositeLayer& one) {
    io.id("MID", one.material);
    io.real("THICK", one.thickness);
    io.real("B", one.angle_deg);
    io.skip();
  };
  if (io.is_reading()) {
    while (io.has_content()) {
      io.card();
      for (int i = 0; i < 2; ++i) {
        CompositeLayer one;
        layer(one);
        if (one.material.given() || one.thickness != 0) layers.push_back(one);
      }
    }
    return;
  }
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (i % 2 == 0) io.card();
    layer(layers[i]);
  }
}

void composite_cards(CardIo& io, Part& part) {
  PartComposite& composite = *part.composite;
  io.line("TITLE", part.title);
  io.card();
  io.id("PID", part.id);
  io.integer_or("ELFORM", composite.formulation, 2);
  io.real_or("SHRF", composite.shear_factor, 1);
  io.real("NLOC", composite.reference_position);
  io.real("MAREA", composite.area_mass);
  io.id("HGID", composite.hourglass);
  io.integer("ADPOPT", composite.adaptive);
  io.integer("THSHEL", composite.thick_shell_option);
  if (part.contact) cards(io, *part.contact);
  layer_cards(io, composite.layers);
}

void read_parts(KeywordBlock& block) {
  read_records(block, block.deck.parts, [&block](CardIo& io, Part& part) {
    part.is_averaged = block.has("AVERAGED");
    if (block.has("INERTIA")) part.inertia.emplace();
    if (block.has("CONTACT")) part.contact.emplace();
    if (block.has("COMPOSITE")) part.composite.emplace();
    part.composite ? composite_cards(io, part) : part_cards(io, part);
  });
}

std::string part_keyword(const Part& part) {
  return std::string("PART") + (part.is_averaged ? "_AVERAGED" : "") +
         (part.inertia ? "_INERTIA" : "") + (part.composite ? "_COMPOSITE" : "") +
         (part.contact ? "_CONTACT" : "");
}

void cards(CardIo& io, Section& section, SectionSolid& law) {
  io.card();
  io.id("SECID", section.id);
  io.integer_or("ELFORM", law.formulation, 1);
  io.integer("AET", law.ambient);
}

void angle_cards(CardIo& io, int points, std::vector<double>& angles) {
  constexpr int kMaxPoints = 1000;
  if (io.is_reading()) {
    if (points < 0 || points > kMaxPoints) {
      io.problem("NIP", "0 .. 1000 points", std::to_string(points));
      return;
    }
    angles.assign(static_cast<std::size_t>(points), 0.0);
  }
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (i % 8 == 0) io.card();
    io.real("B", angles[i]);
  }
}

void cards(CardIo& io, Section& section, SectionShell& law) {
  io.card();
  io.id("SECID", section.id);
  io.integer_or("ELFORM", law.formulation, 2);
  io.real_or("SHRF", law.shear_factor, 1);
  io.integer_or("NIP", law.points, 2);
  io.real("PROPT", law.print_option);
  io.real("QR/IRID", law.rule);
  io.integer("ICOMP", law.composite_flag);
  io.integer_or("SETYP", law.setting, 1);
  io.card();
  io.real("T1", law.thickness[0]);
  io.real("T2", law.thickness[1]);
  io.real("T3", law.thickness[2]);
  io.real("T4", law.thickness[3]);
  const auto& t = law.thickness;
  if (io.is_reading() && t[1] == 0 && t[2] == 0 && t[3] == 0) law.thickness.fill(t[0]);
  io.real("NLOC", law.reference_position);
  io.real("MAREA", law.area_mass);
  io.real("IDOF", law.in_plane_rule);
  io.integer("EDGSET", law.edge_set);
  if (law.composite_flag == 1) angle_cards(io, law.points, law.angles_deg);
}

void cards(CardIo& io, Section& section, SectionThickShell& law) {
  io.card();
  io.id("SECID", section.id);
  io.integer_or("ELFORM", law.formulation, 1);
  io.real_or("SHRF", law.shear_factor, 1);
  io.integer_or("NIP", law.points, 2);
  io.real("PROPT", law.print_option);
  io.real("QR/IRID", law.rule);
  io.integer("ICOMP", law.composite_flag);
  if (law.composite_flag == 1) angle_cards(io, law.points, law.angles_deg);
}

/// Outer and inner sizes of the integrated beams.
void beam_size_fields(CardIo& io, SectionBeam& law) {
  io.real("TS1", law.outer_s[0]);
  io.real("TS2", law.outer_s[1]);
  io.real("TT1", law.outer_t[0]);
  io.real("TT2", law.outer_t[1]);
  if (law.formulation == 9) return;
  io.real("NSLOC", law.location_s);
  io.real("NTLOC", law.location_t);
}

void resultant_beam_fields(CardIo& io, SectionBeam& law) {
  if (!law.shape.empty()) {
    io.text("STYPE", law.shape);
    io.reals("D", law.dimensions);
    return;
  }
  io.real("A", law.area);
  io.real("ISS", law.iss);
  io.real("ITT", law.itt);
  io.real("J", law.torsion);
  io.real("SA", law.shear_area);
  io.real("IST", law.ist);
}

void discrete_beam_fields(CardIo& io, SectionBeam& law) {
  io.real("VOL", law.volume);
  io.real("INER", law.inertia);
  io.id("CID", law.axes);
  io.real("CA", law.cable_area);
  io.real("OFFSET", law.cable_offset);
  io.reals("RRCON", law.axis_control);
}

void cards(CardIo& io, Section& section, SectionBeam& law) {
  io.card();
  io.id("SECID", section.id);
  io.integer_or("ELFORM", law.formulation, 1);
  io.real_or("SHRF", law.shear_factor, 1);
  io.real("QR/IRID", law.rule);
  io.real("CST", law.cross_section);
  io.real("SCOOR", law.third_node);
  io.real("NSM", law.length_mass);
  io.integer("NAUPD", law.area_update);
  if (io.is_reading() && upper_case(trimmed(io.next_line())).starts_with("SECTION_"))
    law.shape = "SECTION_";  // read in full below
  io.card();
  switch (law.formulation) {
    case 2:
    case 12:
    case 13:
      return resultant_beam_fields(io, law);
    case 3:
      io.real("A", law.area);
      io.real("RAMPT", law.ramp_time);
      io.real("STRESS", law.initial_stress);
      return;
    case 6:
      return discrete_beam_fields(io, law);
    default:
      return beam_size_fields(io, law);
  }
}

void cards(CardIo& io, Section& section, SectionDiscrete& law) {
  io.card();
  io.id("SECID", section.id);
  io.integer("DRO", law.is_rotational);
  io.real("KD", law.dynamic_factor);
  io.real("V0", law.test_velocity);
  io.real("CL", law.clearance);
  io.real("FD", law.failure_deflection);
  io.card();
  io.real("CDL", law.compression_limit);
  io.real("TDL", law.tension_limit);
}

void cards(CardIo& io, Section& section, SectionSeatbelt& law) {
  io.card();
  io.id("SECID", section.id);
  io.real("AREA", law.area);
  io.real("THICK", law.thickness);
}

template <class Law>
void read_sections(KeywordBlock& block) {
  read_records(block, block.deck.sections, [&block](CardIo& io, Section& section) {
    block.read_title(section.title);
    cards(io, section, section.law.emplace<Law>());
  });
}

void write_section(CardWriter& out, Section section) {
  constexpr const char* kNames[] = {"SECTION_SOLID", "SECTION_SHELL",    "SECTION_TSHELL",
                                    "SECTION_BEAM",  "SECTION_DISCRETE", "SECTION_SEATBELT"};
  out.keyword_with_title(kNames[section.law.index()], section.title);
  std::visit([&](auto& law) { cards(out, section, law); }, section.law);
}

void cards(CardIo& io, Hourglass& hourglass) {
  io.card();
  io.id("HGID", hourglass.id);
  io.integer("IHQ", hourglass.type);
  io.real_or("QM", hourglass.coefficient, 0.1);
  io.integer("IBQ", hourglass.bulk_type);
  io.real_or("Q1", hourglass.quadratic_bulk, 1.5);
  io.real_or("Q2", hourglass.linear_bulk, 0.06);
  io.real("QB/VDC", hourglass.bending);
  io.real("QW", hourglass.warping);
}

void read_hourglasses(KeywordBlock& block) {
  read_records(block, block.deck.hourglasses, [&block](CardIo& io, Hourglass& hourglass) {
    block.read_title(hourglass.title);
    cards(io, hourglass);
  });
}

void cards(CardIo& io, IntegrationShell& rule) {
  io.card();
  io.id("IRID", rule.id);
  io.integer("NIP", rule.points);
  io.integer("ESOP", rule.equally_spaced);
  io.integer("FAILOPT", rule.failure_option);
  if (rule.equally_spaced != 0) return;
  io.rows(
      rule.rows,
      [&io](IntegrationPoint& row) {
        io.card();
        io.real("S", row.position);
        io.real("WF", row.weight);
        io.id("PID", row.part);
      },
      rule.points);
}

void read_integrations(KeywordBlock& block) {
  read_records(block, block.deck.integrations,
               [](CardIo& io, IntegrationShell& rule) { cards(io, rule); });
}

void cards(CardIo& io, EquationOfState& eos, EosLinearPolynomial& law) {
  io.card();
  io.id("EOSID", eos.id);
  io.reals("C", law.c);
  io.card();
  io.real("E0", law.energy);
  io.real_or("V0", law.volume, 1);
}

void cards(CardIo& io, EquationOfState& eos, EosGruneisen& law) {
  io.card();
  io.id("EOSID", eos.id);
  io.real("C", law.c);
  io.real("S1", law.s1);
  io.real("S2", law.s2);
  io.real("S3", law.s3);
  io.real("GAMAO", law.gamma0);
  io.real("A", law.a);
  io.real("E0", law.energy);
  io.card();
  io.real_or("V0", law.volume, 1);
}

void cards(CardIo& io, EquationOfState& eos, EosTabulated& law) {
  io.card();
  io.id("EOSID", eos.id);
  io.real("GAMA", law.gamma);
  io.real("E0", law.energy);
  io.real_or("V0", law.volume, 1);
  io.id("LCC", law.c_curve);
  io.id("LCT", law.t_curve);
  if (law.c_curve.given()) return;
  constexpr int kTableWidth = 16;
  for (auto* values : {&law.strain, &law.c, &law.t})
    for (std::size_t i = 0; i < values->size(); ++i) {
      if (i % 5 == 0) io.card();
      io.real("EV/C/T", (*values)[i], kTableWidth);
    }
}

template <class Law>
void read_eos(KeywordBlock& block) {
  EquationOfState eos;
  block.read_title(eos.title);
  cards(block.io, eos, eos.law.emplace<Law>());
  eos.source = block.io.keyword_source();
  block.deck.equations_of_state.push_back(std::move(eos));
}

const std::vector<KeywordEntry>& entries() {
  static const std::vector<KeywordEntry> kEntries{
      {"PART", {"AVERAGED", "INERTIA", "CONTACT", "COMPOSITE"}, read_parts},
      {"SECTION_SOLID", {"TITLE"}, read_sections<SectionSolid>},
      {"SECTION_SHELL", {"TITLE"}, read_sections<SectionShell>},
      {"SECTION_TSHELL", {"TITLE"}, read_sections<SectionThickShell>},
      {"SECTION_BEAM", {"TITLE"}, read_sections<SectionBeam>},
      {"SECTION_DISCRETE", {"TITLE"}, read_sections<SectionDiscrete>},
      {"SECTION_SEATBELT", {"TITLE"}, read_sections<SectionSeatbelt>},
      {"HOURGLASS", {"TITLE"}, read_hourglasses},
      {"INTEGRATION_SHELL", {}, read_integrations},
      {"EOS_LINEAR_POLYNOMIAL", {"TITLE"}, read_eos<EosLinearPolynomial>},
      {"EOS_GRUNEISEN", {"TITLE"}, read_eos<EosGruneisen>},
      {"EOS_TABULATED", {"TITLE"}, read_eos<EosTabulated>},
  };
  return kEntries;
}

}  // namespace

std::span<const KeywordEntry> part_keywords() { return entries(); }

void write_parts(CardWriter& out, const Deck& deck) {
  for (Part part : deck.parts) {
    out.keyword(part_keyword(part));
    part.composite ? composite_cards(out, part) : part_cards(out, part);
  }
  for (const Section& section : deck.sections) write_section(out, section);
  for (Hourglass hourglass : deck.hourglasses) {
    out.keyword_with_title("HOURGLASS", hourglass.title);
    cards(out, hourglass);
  }
  for (IntegrationShell rule : deck.integrations) {
    out.keyword("INTEGRATION_SHELL");
    cards(out, rule);
  }
  for (EquationOfState eos : deck.equations_of_state) {
    constexpr const char* kNames[] = {"EOS_LINEAR_POLYNOMIAL", "EOS_GRUNEISEN", "EOS_TABULATED"};
    out.keyword_with_title(kNames[eos.law.index()], eos.title);
    std::visit([&](auto& law) { cards(out, eos, law); }, eos.law);
  }
}

}  // namespace crosswalk::fe
