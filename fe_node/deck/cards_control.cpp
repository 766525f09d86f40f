// *CONTROL_ and *DATABASE_ cards that are interpreted.
#include <algorithm>

#include "fe_node/deck/keyword_table.h"

namespace crosswalk::fe {

namespace {

/// Cards after the interpreted ones, as text.
void more_cards(CardIo& io, std::vector<std::string>& lines) {
  if (io.is_reading()) {
    while (io.has_content()) io.raw_line(lines.emplace_back());
    return;
  }
  for (std::string& line : lines) io.raw_line(line);
}

void termination_cards(CardIo& io, Control& control) {
  double end_time = control.end_time.value_or(0);
  io.card();
  io.real("ENDTIM", end_time);
  io.integer("ENDCYC", control.end_cycle);
  io.real("DTMIN", control.minimum_step_ratio);
  io.real("ENDENG", control.energy_change);
  io.real("ENDMAS", control.mass_change);
  control.end_time = end_time;
}

void cards(CardIo& io, TimeStepControl& step) {
  io.card();
  io.real("DTINIT", step.initial);
  io.real_or("TSSFAC", step.scale, 0.9);
  io.integer("ISDO", step.shell_basis);
  io.real("TSLIMT", step.shell_limit);
  io.real("DT2MS", step.mass_scaled_step);
  io.id("LCTM", step.limit_curve);
  io.integer("ERODE", step.erode);
  io.integer("MS1ST", step.mass_scaled_option);
}

void cards(CardIo& io, EnergyControl& energy) {
  io.card();
  io.integer("HGEN", energy.hourglass);
  io.integer("RWEN", energy.rigid_wall);
  io.integer("SLNTEN", energy.sliding);
  io.integer("RYLEN", energy.damping);
  io.integer("IRGEN", energy.initial_reference);
}

void cards(CardIo& io, HourglassControl& hourglass) {
  io.card();
  io.integer_or("IHQ", hourglass.type, 1);
  io.real_or("QH", hourglass.coefficient, 0.1);
}

void cards(CardIo& io, BulkViscosityControl& viscosity) {
  io.card();
  io.real_or("Q1", viscosity.quadratic, 1.5);
  io.real_or("Q2", viscosity.linear, 0.06);
  io.integer_or("TYPE", viscosity.type, 1);
  io.integer("BTYPE", viscosity.beam_type);
}

void first_contact_cards(CardIo& io, ContactControl& contact) {
  io.card();
  io.real_or("SLSFAC", contact.stiffness_scale, 0.1);
  io.real("RWPNAL", contact.wall_penalty);
  io.integer_or("ISLCHK", contact.initial_check, 1);
  io.integer("SHLTHK", contact.shell_thickness);
  io.integer_or("PENOPT", contact.penalty_option, 1);
  io.integer("THKCHG", contact.thickness_change);
  io.integer_or("ORIEN", contact.orientation, 1);
  io.integer("ENMASS", contact.eroded_mass);
  io.card();
  io.integer("USRSTR", contact.user_storage);
  io.integer("USRFRC", contact.user_friction);
  io.integer("NSBCS", contact.bucket_steps);
  io.integer("INTERM", contact.interference);
  io.real("XPENE", contact.large_penetration);
  io.integer("SSTHK", contact.self_thickness);
  io.integer("ECDT", contact.eroded_step);
  io.integer("TIEDPRJ", contact.tied_projection);
}

void cards(CardIo& io, ContactControl& contact) {
  first_contact_cards(io, contact);
  if (!io.has_optional(true)) return;
  io.card();
  io.real("SFRIC", contact.static_friction);
  io.real("DFRIC", contact.dynamic_friction);
  io.real("EDC", contact.decay);
  io.real("VFC", contact.viscous);
  io.real("TH", contact.thickness);
  io.real("TH_SF", contact.thickness_scale);
  io.real("PEN_SF", contact.penalty_scale);
  io.card();
  io.integer("IGNORE", contact.ignore);
  io.integer("FRCENG", contact.friction_energy);
  more_cards(io, contact.more_cards);
}

void cards(CardIo& io, ShellControl& shell) {
  io.card();
  io.real_or("WRPANG", shell.warp_angle_deg, 20);
  io.integer("ESORT", shell.sort_triangles);
  io.integer_or("IRNXX", shell.normal_update, -1);
  io.integer("ISTUPD", shell.thickness_update);
  io.integer_or("THEORY", shell.theory, 2);
  io.integer_or("BWC", shell.warping_stiffness, 2);
  io.integer_or("MITER", shell.plane_stress, 1);
  io.integer("PROJ", shell.projection);
  more_cards(io, shell.more_cards);
}

void cards(CardIo& io, SolidControl& solid) {
  io.card();
  io.integer("ESORT", solid.sort_degenerate);
  io.integer("FMATRIX", solid.matrix_form);
  io.integer_or("NIPTETS", solid.tet_points, 4);
  io.integer_or("SWLOCL", solid.local_axes, 1);
  io.integer("PSFAIL", solid.failure_output);
  io.real("T10JTOL", solid.tet10_tolerance);
  more_cards(io, solid.more_cards);
}

void cards(CardIo& io, AccuracyControl& accuracy) {
  io.card();
  io.integer("OSU", accuracy.objective_update);
  io.integer_or("INN", accuracy.invariant_numbering, 1);
  io.id("PIDOSU", accuracy.part_set);
}

void read_termination(KeywordBlock& block) { termination_cards(block.io, block.deck.control); }

template <auto Member>
void read_control(KeywordBlock& block) {
  auto& record = (block.deck.control.*Member).emplace();
  cards(block.io, record);
}

void history_ids(KeywordBlock& block, HistoryRequest request) {
  std::vector<DeckId> ids;
  block.io.id_list("ID", ids);
  for (const DeckId id : ids) {
    request.id = id;
    block.deck.histories.push_back(request);
  }
}

void read_history(KeywordBlock& block) {
  HistoryRequest request;
  request.kind = block.base.substr(block.base.rfind('_') + 1);
  request.is_set = block.has("SET");
  request.source = block.io.keyword_source();
  const bool has_title = block.has("ID"), is_local = block.has("LOCAL");
  if (!has_title && !is_local) return history_ids(block, request);
  read_records(block, block.deck.histories, [&](CardIo& io, HistoryRequest& one) {
    one.kind = request.kind;
    if (!is_local) return io.id_and_title(one.id, one.title);
    io.card();
    io.id("ID", one.id);
    io.id("CID", one.axes);
    if (has_title) io.line("HEADING", one.title);
  });
}

void cards(CardIo& io, CrossSection& section) {
  io.card();
  io.id("NSID", section.nodes);
  io.id("HSID", section.solids);
  io.id("BSID", section.beams);
  io.id("SSID", section.shells);
  io.id("TSID", section.thick_shells);
  io.id("DSID", section.discretes);
  io.id("ID", section.reference);
  io.integer("ITYPE", section.reference_kind);
}

void read_cross_sections(KeywordBlock& block) {
  read_records(block, block.deck.cross_sections, [&block](CardIo& io, CrossSection& section) {
    block.read_id(section.id, section.title);
    cards(io, section);
  });
}

const std::vector<KeywordEntry>& entries() {
  static const std::vector<std::string_view> kHistory{"SET", "ID", "LOCAL"};
  static const std::vector<KeywordEntry> kEntries{
      {"CONTROL_TERMINATION", {}, read_termination},
      {"CONTROL_TIMESTEP", {}, read_control<&Control::time_step>},
      {"CONTROL_ENERGY", {}, read_control<&Control::energy>},
      {"CONTROL_HOURGLASS", {}, read_control<&Control::hourglass>},
      {"CONTROL_BULK_VISCOSITY", {}, read_control<&Control::bulk_viscosity>},
      {"CONTROL_CONTACT", {}, read_control<&Control::contact>},
      {"CONTROL_SHELL", {}, read_control<&Control::shell>},
      {"CONTROL_SOLID", {}, read_control<&Control::solid>},
      {"CONTROL_ACCURACY", {}, read_control<&Control::accuracy>},
      {"DATABASE_HISTORY_NODE", kHistory, read_history},
      {"DATABASE_HISTORY_SHELL", kHistory, read_history},
      {"DATABASE_HISTORY_SOLID", kHistory, read_history},
      {"DATABASE_HISTORY_BEAM", kHistory, read_history},
      {"DATABASE_HISTORY_DISCRETE", kHistory, read_history},
      {"DATABASE_CROSS_SECTION_SET", {"ID"}, read_cross_sections},
  };
  return kEntries;
}

/// Databases whose first field is the output interval.
constexpr std::string_view kIntervals[] = {
    "ABSTAT",  "BNDOUT",  "DEFORC", "DISBOUT",       "ELOUT",         "GCEOUT",
    "GLSTAT",  "JNTFORC", "MATSUM", "NCFORC",        "NODFOR",        "NODOUT",
    "RBDOUT",  "RCFORC",  "RWFORC", "SBTOUT",        "SECFORC",       "SLEOUT",
    "SPCFORC", "SSSTAT",  "SWFORC", "BINARY_D3PLOT", "BINARY_D3THDT", "BINARY_INTFOR"};

void database_card(CardIo& io, DatabaseRequest& request) {
  io.card();
  io.real("DT", request.interval);
}

template <class Record>
void write_control_card(CardWriter& out, const char* keyword, const std::optional<Record>& record) {
  if (!record) return;
  out.keyword(keyword);
  Record copy = *record;
  cards(out, copy);
}

void write_history(CardWriter& out, HistoryRequest request) {
  const bool has_title = !request.title.empty();
  const bool is_local = request.axes.given();
  out.keyword("DATABASE_HISTORY_" + request.kind + (request.is_set ? "_SET" : "") +
              (is_local ? "_LOCAL" : "") + (has_title ? "_ID" : ""));
  if (!is_local && has_title) return out.id_and_title(request.id, request.title);
  out.card();
  out.id("ID", request.id);
  if (!is_local) return;
  out.id("CID", request.axes);
  if (has_title) out.line("HEADING", request.title);
}

}  // namespace

std::span<const KeywordEntry> control_keywords() { return entries(); }

bool read_database(KeywordBlock& block, const std::string& keyword) {
  if (std::find(std::begin(kIntervals), std::end(kIntervals), keyword) == std::end(kIntervals))
    return false;
  DatabaseRequest request;
  request.keyword = "DATABASE_" + keyword;
  request.source = block.io.keyword_source();
  database_card(block.io, request);
  // The second card of *DATABASE_BINARY_D3PLOT names an output file's form.
  if (keyword.starts_with("BINARY_") && block.io.has_content()) block.io.card();
  block.deck.databases.push_back(std::move(request));
  return true;
}

void write_control(CardWriter& out, const Deck& deck) {
  const Control& control = deck.control;
  if (control.end_time) {
    out.keyword("CONTROL_TERMINATION");
    Control copy = control;
    termination_cards(out, copy);
  }
  write_control_card(out, "CONTROL_TIMESTEP", control.time_step);
  write_control_card(out, "CONTROL_ENERGY", control.energy);
  write_control_card(out, "CONTROL_HOURGLASS", control.hourglass);
  write_control_card(out, "CONTROL_BULK_VISCOSITY", control.bulk_viscosity);
  write_control_card(out, "CONTROL_CONTACT", control.contact);
  write_control_card(out, "CONTROL_SHELL", control.shell);
  write_control_card(out, "CONTROL_SOLID", control.solid);
  write_control_card(out, "CONTROL_ACCURACY", control.accuracy);
  for (DatabaseRequest request : deck.databases) {
    out.keyword(request.keyword);
    database_card(out, request);
  }
  for (const HistoryRequest& request : deck.histories) write_history(out, request);
  for (CrossSection section : deck.cross_sections) {
    const bool has_id = section.id.given() || !section.title.empty();
    out.keyword(has_id ? "DATABASE_CROSS_SECTION_SET_ID" : "DATABASE_CROSS_SECTION_SET");
    if (has_id) out.id_and_title(section.id, section.title);
    cards(out, section);
  }
}

}  // namespace crosswalk::fe
