// *NODE and *ELEMENT_ cards.
#include "fe_node/deck/keyword_table.h"

namespace crosswalk::fe {

namespace {

constexpr int kElementWidth = 8;
constexpr int kCoordinateWidth = 16;

void cards(CardIo& io, DeckNode& node) {
  io.card();
  io.id("NID", node.id, kElementWidth);
  io.vec3({"X", "Y", "Z"}, node.position, kCoordinateWidth);
  io.integer("TC", node.fixed_translation, kElementWidth);
  io.integer("RC", node.fixed_rotation, kElementWidth);
}

template <std::size_t N>
void node_ids(CardIo& io, std::array<DeckId, N>& nodes, std::size_t count = N,
              int width = kElementWidth) {
  constexpr std::array<const char*, 10> kNames{"N1", "N2", "N3", "N4", "N5",
                                               "N6", "N7", "N8", "N9", "N10"};
  for (std::size_t i = 0; i < count; ++i) io.id(kNames[i], nodes[i], width);
}

/// One line with part and eight nodes, or a line with the part and one with up to ten nodes.
void cards(CardIo& io, SolidElement& element) {
  io.card();
  io.id("EID", element.id, kElementWidth);
  io.id("PID", element.part, kElementWidth);
  const auto is_empty = [&element] { return element.nodes == decltype(element.nodes){}; };
  const bool is_one_line =
      element.nodes[8] == DeckId() && element.nodes[9] == DeckId() && !is_empty();
  if (io.is_reading() || is_one_line) node_ids(io, element.nodes, 8);
  if (io.is_reading() ? !is_empty() : is_one_line) return;
  io.card();
  node_ids(io, element.nodes);
}

void cards(CardIo& io, ThickShellElement& element) {
  io.card();
  io.id("EID", element.id, kElementWidth);
  io.id("PID", element.part, kElementWidth);
  node_ids(io, element.nodes);
}

enum ShellOption : unsigned { kThickness = 1, kOffset = 2 };

void cards(CardIo& io, ShellElement& element, unsigned options) {
  io.card();
  io.id("EID", element.id, kElementWidth);
  io.id("PID", element.part, kElementWidth);
  node_ids(io, element.nodes);
  if ((options & kThickness) != 0) {
    io.card();
    io.reals("THIC", element.thickness, kCoordinateWidth);
    io.real("BETA", element.material_angle_deg, kCoordinateWidth);
    if (element.nodes[4].given() && io.is_reading()) io.card();  // mid-side thicknesses
    if (element.nodes[4].given() && !io.is_reading()) {
      io.card();
      std::array<double, 4> mid_side{};
      io.reals("THIC", mid_side, kCoordinateWidth);
    }
  }
  if ((options & kOffset) != 0) {
    io.card();
    io.real("OFFSET", element.offset, kCoordinateWidth);
  }
}

void cards(CardIo& io, BeamElement& element, bool has_thickness, bool has_orientation) {
  io.card();
  io.id("EID", element.id, kElementWidth);
  io.id("PID", element.part, kElementWidth);
  node_ids(io, element.nodes);
  constexpr std::array<const char*, 4> kNames{"RT1", "RR1", "RT2", "RR2"};
  for (std::size_t i = 0; i < 4; ++i) io.integer(kNames[i], element.released[i], kElementWidth);
  io.integer_or("LOCAL", element.local, 2, kElementWidth);
  if (has_thickness) {
    io.card();
    io.reals("PARM", element.thickness, kCoordinateWidth);
  }
  if (has_orientation) {
    io.card();
    io.vec3({"VX", "VY", "VZ"}, element.orientation, kCoordinateWidth);
  }
}

void cards(CardIo& io, DiscreteElement& element) {
  io.card();
  io.id("EID", element.id, kElementWidth);
  io.id("PID", element.part, kElementWidth);
  node_ids(io, element.nodes);
  io.id("VID", element.orientation, kElementWidth);
  io.real_or("S", element.scale, 1, kCoordinateWidth);
  io.integer("PF", element.print, kElementWidth);
  io.real("OFFSET", element.offset, kCoordinateWidth);
}

void cards(CardIo& io, SeatbeltElement& element) {
  io.card();
  io.id("EID", element.id, kElementWidth);
  io.id("PID", element.part, kElementWidth);
  node_ids(io, element.nodes);
  io.id("SBRID", element.retractor, kElementWidth);
  io.real("SLEN", element.slack_length, kCoordinateWidth);
}

void mass_cards(CardIo& io, MassElement& element) {
  io.card();
  io.id("EID", element.id, kElementWidth);
  io.id("ID", element.target, kElementWidth);
  io.real("MASS", element.mass, kCoordinateWidth);
  io.id("PID", element.part, kElementWidth);
}

void part_mass_cards(CardIo& io, MassElement& element) {
  io.card();
  io.id("ID", element.target, kElementWidth);
  io.real("ADDMASS", element.mass, kCoordinateWidth);
  io.real("FINMASS", element.final_mass, kCoordinateWidth);
}

void cards(CardIo& io, InertiaElement& element) {
  io.card();
  io.id("EID", element.id, kElementWidth);
  io.id("NID", element.node, kElementWidth);
  io.id("CSID", element.axes, kElementWidth);
  io.card();
  io.real("IXX", element.ixx);
  io.real("IXY", element.ixy);
  io.real("IXZ", element.ixz);
  io.real("IYY", element.iyy);
  io.real("IYZ", element.iyz);
  io.real("IZZ", element.izz);
  io.real("MASS", element.mass);
}

void cards(CardIo& io, AccelerometerElement& element) {
  io.card();
  io.id("SBACID", element.id);
  node_ids(io, element.nodes, 3, CardIo::kWidth);
  io.integer("IGRAV", element.gravity_removed);
  io.integer("INTOPT", element.interval_option);
  io.real("MASS", element.mass);
}

template <auto Member>
void read_plain(KeywordBlock& block) {
  read_records(block, block.deck.*Member, [](CardIo& io, auto& record) { cards(io, record); });
}

void read_shells(KeywordBlock& block) {
  const unsigned options =
      (block.has("THICKNESS") || block.has("BETA") || block.has("MCID") ? kThickness : 0U) |
      (block.has("OFFSET") ? kOffset : 0U);
  const bool has_axes = block.has("MCID");
  read_records(block, block.deck.shells, [=](CardIo& io, ShellElement& element) {
    cards(io, element, options);
    if (has_axes && element.material_angle_deg != 0)
      io.problem("MCID", "no material axes per element", "a coordinate system");
  });
}

void read_beams(KeywordBlock& block) {
  read_records(block, block.deck.beams, [&block](CardIo& io, BeamElement& element) {
    cards(io, element, block.has("THICKNESS"), block.has("ORIENTATION"));
  });
}

template <MassTarget Kind>
void read_masses(KeywordBlock& block) {
  constexpr bool is_of_parts = Kind == MassTarget::Part || Kind == MassTarget::PartSet;
  read_records(block, block.deck.masses, [](CardIo& io, MassElement& element) {
    element.kind = Kind;
    is_of_parts ? part_mass_cards(io, element) : mass_cards(io, element);
  });
}

const std::vector<KeywordEntry>& entries() {
  static const std::vector<KeywordEntry> kEntries{
      {"NODE", {}, read_plain<&Deck::nodes>},
      {"ELEMENT_SOLID", {}, read_plain<&Deck::solids>},
      {"ELEMENT_SHELL", {"THICKNESS", "BETA", "MCID", "OFFSET"}, read_shells},
      {"ELEMENT_TSHELL", {}, read_plain<&Deck::thick_shells>},
      {"ELEMENT_BEAM", {"THICKNESS", "ORIENTATION"}, read_beams},
      {"ELEMENT_DISCRETE", {}, read_plain<&Deck::discretes>},
      {"ELEMENT_SEATBELT", {}, read_plain<&Deck::seatbelts>},
      {"ELEMENT_SEATBELT_ACCELEROMETER", {}, read_plain<&Deck::accelerometers>},
      {"ELEMENT_MASS", {}, read_masses<MassTarget::Node>},
      {"ELEMENT_MASS_NODE_SET", {}, read_masses<MassTarget::NodeSet>},
      {"ELEMENT_MASS_PART", {}, read_masses<MassTarget::Part>},
      {"ELEMENT_MASS_PART_SET", {}, read_masses<MassTarget::PartSet>},
      {"ELEMENT_INERTIA", {}, read_plain<&Deck::inertias>},
  };
  return kEntries;
}

bool has_thickness(const ShellElement& element) {
  return element.thickness != std::array<double, 4>{} || element.material_angle_deg != 0;
}

void write_shells(CardWriter& out, const Deck& deck) {
  unsigned present = ~0U;
  for (ShellElement element : deck.shells) {
    const unsigned options =
        (has_thickness(element) ? kThickness : 0U) | (element.offset != 0 ? kOffset : 0U);
    if (options != present)
      out.keyword(std::string("ELEMENT_SHELL") + ((options & kThickness) != 0 ? "_THICKNESS" : "") +
                  ((options & kOffset) != 0 ? "_OFFSET" : ""));
    present = options;
    cards(out, element, options);
  }
}

void write_beams(CardWriter& out, const Deck& deck) {
  int present = -1;
  for (BeamElement element : deck.beams) {
    const bool has_size = element.thickness != std::array<double, 5>{};
    const bool has_orientation = !element.orientation.isZero(0);
    const int options = (has_size ? 1 : 0) + (has_orientation ? 2 : 0);
    if (options != present)
      out.keyword(std::string("ELEMENT_BEAM") + (has_size ? "_THICKNESS" : "") +
                  (has_orientation ? "_ORIENTATION" : ""));
    present = options;
    cards(out, element, has_size, has_orientation);
  }
}

void write_masses(CardWriter& out, const Deck& deck) {
  constexpr const char* kNames[] = {"ELEMENT_MASS", "ELEMENT_MASS_NODE_SET", "ELEMENT_MASS_PART",
                                    "ELEMENT_MASS_PART_SET"};
  const MassElement* previous = nullptr;
  for (const MassElement& element : deck.masses) {
    if (previous == nullptr || previous->kind != element.kind)
      out.keyword(kNames[static_cast<int>(element.kind)]);
    previous = &element;
    MassElement copy = element;
    const bool is_of_parts =
        element.kind == MassTarget::Part || element.kind == MassTarget::PartSet;
    is_of_parts ? part_mass_cards(out, copy) : mass_cards(out, copy);
  }
}

}  // namespace

std::span<const KeywordEntry> mesh_keywords() { return entries(); }

void write_mesh(CardWriter& out, const Deck& deck) {
  const auto plain = [](CardIo& io, auto& record) { cards(io, record); };
  write_records(out, "NODE", deck.nodes, plain);
  write_records(out, "ELEMENT_SOLID", deck.solids, plain);
  write_shells(out, deck);
  write_records(out, "ELEMENT_TSHELL", deck.thick_shells, plain);
  write_beams(out, deck);
  write_records(out, "ELEMENT_DISCRETE", deck.discretes, plain);
  write_records(out, "ELEMENT_SEATBELT", deck.seatbelts, plain);
  write_records(out, "ELEMENT_SEATBELT_ACCELEROMETER", deck.accelerometers, plain);
  write_masses(out, deck);
  write_records(out, "ELEMENT_INERTIA", deck.inertias, plain);
}

}  // namespace crosswalk::fe
