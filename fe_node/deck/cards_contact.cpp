// *CONTACT_ cards.
#include "fe_node/deck/keyword_table.h"
#include "fe_node/deck/number.h"

namespace crosswalk::fe {

namespace {

void card_a(CardIo& io, ContactCardA& a) {
  io.card();
  io.integer("SOFT", a.soft);
  io.real_or("SOFSCL", a.soft_scale, 0.1);
  io.id("LCIDAB", a.airbag_curve);
  io.real_or("MAXPAR", a.segment_extension, 1.025);
  io.real_or("SBOPT", a.segment_option, 2);
  io.integer_or("DEPTH", a.depth, 2);
  io.integer("BSORT", a.bucket_steps);
  io.integer_or("FRCFRQ", a.force_steps, 1);
}

void card_b(CardIo& io, ContactCardB& b) {
  io.card();
  io.real("PENMAX", b.maximum_penetration);
  io.integer("THKOPT", b.thickness_option);
  io.integer("SHLTHK", b.shell_thickness);
  io.integer("SNLOG", b.shooting_node);
  io.integer("ISYM", b.symmetry);
  io.integer("I2D3D", b.search);
  io.real("SLDTHK", b.solid_thickness);
  io.real("SLDSTF", b.solid_stiffness);
}

void card_c(CardIo& io, ContactCardC& c) {
  io.card();
  io.integer_or("IGAP", c.igap, 1);
  io.integer("IGNORE", c.ignore);
  io.real("DPRFAC", c.depth_reduction);
  io.real("DTSTIF", c.time_step_stiffness);
  io.real("EDGEK", c.edge_scale);
  io.skip();
  io.real("FLANGL", c.flange_angle);
  io.id("CID_RCF", c.output_axes);
}

void surface_kind(CardIo& io, const char* name, SurfaceKind& kind) {
  std::int32_t value = static_cast<std::int32_t>(kind);
  io.integer(name, value);
  if (!io.is_reading()) return;
  if (value < 0 || value > static_cast<std::int32_t>(SurfaceKind::ExemptedPartSet)) {
    io.problem(name, "0 .. 6", std::to_string(value));
    return;
  }
  kind = static_cast<SurfaceKind>(value);
}

void main_cards(CardIo& io, Contact& contact) {
  io.card();
  io.id("SSID", contact.slave.id);
  io.id("MSID", contact.master.id);
  surface_kind(io, "SSTYP", contact.slave.kind);
  surface_kind(io, "MSTYP", contact.master.kind);
  io.id("SBOXID", contact.slave.box);
  io.id("MBOXID", contact.master.box);
  io.integer("SPR", contact.slave.print);
  io.integer("MPR", contact.master.print);
  io.card();
  io.real("FS", contact.static_friction);
  io.real("FD", contact.dynamic_friction);
  io.real("DC", contact.decay);
  io.real("VC", contact.viscous_friction);
  io.real("VDC", contact.damping_percent);
  io.integer("PENCHK", contact.penetration_check);
  io.real("BT", contact.birth);
  io.real_or("DT", contact.death, kNever);
  io.card();
  io.real_or("SFS", contact.slave.stiffness_scale, 1);
  io.real_or("SFM", contact.master.stiffness_scale, 1);
  io.real("SST", contact.slave.thickness);
  io.real("MST", contact.master.thickness);
  io.real_or("SFST", contact.slave.thickness_scale, 1);
  io.real_or("SFMT", contact.master.thickness_scale, 1);
  io.real_or("FSF", contact.friction_scale, 1);
  io.real_or("VSF", contact.viscous_scale, 1);
}

/// The fourth card some kinds have: erosion options, failure forces of tie-breaks.
bool has_special_card(const Contact& contact) {
  return contact.is_eroding || contact.is_tiebreak || contact.keyword.starts_with("CONSTRAINT_") ||
         contact.keyword.starts_with("RIGID_");
}

void cards(CardIo& io, Contact& contact) {
  main_cards(io, contact);
  if (has_special_card(contact)) {
    io.card();
    io.reals("SPECIAL", contact.special);
  }
  // Each optional card needs the ones before it.
  const bool needs_c = contact.card_c || !contact.extra_cards.empty();
  const bool needs_b = contact.card_b || needs_c;
  if (!io.has_optional(contact.card_a || needs_b)) return;
  card_a(io, contact.card_a ? *contact.card_a : contact.card_a.emplace());
  if (!io.has_optional(needs_b)) return;
  card_b(io, contact.card_b ? *contact.card_b : contact.card_b.emplace());
  if (!io.has_optional(needs_c)) return;
  card_c(io, contact.card_c ? *contact.card_c : contact.card_c.emplace());
  if (io.is_reading()) {
    while (io.has_content()) io.raw_line(contact.extra_cards.emplace_back());
    return;
  }
  for (std::string& line : contact.extra_cards) io.raw_line(line);
}

struct NamedKind {
  std::string_view part;  ///< of the keyword, without the adjectives
  ContactKind kind;
};
// The first that the keyword contains counts.
constexpr NamedKind kKinds[] = {
    {"FORCE_TRANSDUCER", ContactKind::ForceTransducer},
    {"TIED_SHELL_EDGE_TO_SURFACE", ContactKind::TiedShellEdgeToSurface},
    {"TIED_SURFACE_TO_SURFACE", ContactKind::TiedSurfaceToSurface},
    {"TIED_NODES_TO_SURFACE", ContactKind::TiedNodesToSurface},
    {"SPOTWELD", ContactKind::TiedNodesToSurface},
    {"AUTOMATIC_GENERAL", ContactKind::General},
    {"SINGLE_SURFACE", ContactKind::SingleSurface},
    {"ONE_WAY_SURFACE_TO_SURFACE", ContactKind::OneWaySurfaceToSurface},
    {"SURFACE_TO_SURFACE", ContactKind::SurfaceToSurface},
    {"NODES_TO_SURFACE", ContactKind::NodesToSurface},
};
// Kinds with cards of their own, or laws that are not penalty contact.
constexpr std::string_view kForeign[] = {
    "FORMING", "DRAWBEAD",     "GUIDED",   "1D",     "2D",          "RIGID_",      "GEBOD",
    "ENTITY",  "SLIDING_ONLY", "ADD_WEAR", "MORTAR", "LUBRICATION", "CONSTRAINT_", "COUPLING"};

void classify(Contact& contact) {
  const std::string_view name = contact.keyword;
  const auto contains = [&](std::string_view part) { return name.find(part) != name.npos; };
  contact.is_automatic = name.starts_with("AUTOMATIC");
  contact.is_eroding = name.starts_with("ERODING");
  contact.is_tiebreak = contains("TIEBREAK");
  contact.has_offset = contains("OFFSET");
  contact.kind = ContactKind::Unsupported;
  for (const std::string_view foreign : kForeign)
    if (contains(foreign)) return;
  for (const NamedKind& named : kKinds) {
    if (!contains(named.part)) continue;
    contact.kind = named.kind;
    return;
  }
}

/// One or two cards of option MPP; the second starts with &.
void mpp_cards(CardIo& io, std::vector<std::string>& lines) {
  if (!io.is_reading()) {
    for (std::string& line : lines) io.raw_line(line);
    return;
  }
  io.raw_line(lines.emplace_back());
  if (io.next_line().starts_with('&')) io.raw_line(lines.emplace_back());
}

/// Takes `suffix` off the end of `name`.
bool take_suffix(std::string& name, std::string_view suffix) {
  if (!name.ends_with(suffix)) return false;
  name.erase(name.size() - suffix.size());
  return true;
}

}  // namespace

Contact contact_named(const std::string& keyword) {
  Contact contact;
  contact.keyword = keyword;
  classify(contact);
  return contact;
}

bool read_contact(KeywordBlock& block, const std::string& keyword) {
  std::string name = keyword;
  bool has_id = false, has_mpp = false, has_changed = true;
  while (has_changed) {
    const bool id = take_suffix(name, "_ID") || take_suffix(name, "_TITLE");
    const bool mpp = take_suffix(name, "_MPP");
    has_id = has_id || id;
    has_mpp = has_mpp || mpp;
    has_changed = id || mpp;
  }
  Contact contact = contact_named(name);
  if (contact.kind == ContactKind::Unsupported) return false;
  contact.source = block.io.keyword_source();
  if (has_id) block.io.id_and_title(contact.id, contact.title);
  if (has_mpp) mpp_cards(block.io, contact.mpp_cards);
  cards(block.io, contact);
  block.deck.contacts.push_back(std::move(contact));
  return true;
}

void write_contacts(CardWriter& out, const Deck& deck) {
  for (Contact contact : deck.contacts) {
    const bool has_id = contact.id.given() || !contact.title.empty();
    out.keyword("CONTACT_" + contact.keyword + (has_id ? "_ID" : "") +
                (contact.mpp_cards.empty() ? "" : "_MPP"));
    if (has_id) out.id_and_title(contact.id, contact.title);
    mpp_cards(out, contact.mpp_cards);
    cards(out, contact);
  }
}

}  // namespace crosswalk::fe
