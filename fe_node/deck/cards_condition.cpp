// *BOUNDARY_, *INITIAL_, *LOAD_ and *DAMPING_ cards.
#include <cmath>

#include "fe_node/deck/keyword_table.h"

namespace crosswalk::fe {

namespace {

constexpr std::array<const char*, 3> kVelocity{"VX", "VY", "VZ"};
constexpr std::array<const char*, 3> kAngular{"VXR", "VYR", "VZR"};

void cards(CardIo& io, Spc& spc, bool has_times) {
  io.card();
  io.id("NID/NSID", spc.target);
  io.id("CID", spc.axes);
  constexpr std::array<const char*, 6> kNames{"DOFX", "DOFY", "DOFZ", "DOFRX", "DOFRY", "DOFRZ"};
  for (std::size_t i = 0; i < 6; ++i) io.integer(kNames[i], spc.fixed[i]);
  if (!has_times) return;
  io.card();
  io.real("BIRTH", spc.birth);
  io.real_or("DEATH", spc.death, kNever);
}

template <NodeTarget Kind>
void read_spcs(KeywordBlock& block) {
  read_records(block, block.deck.spcs, [&block](CardIo& io, Spc& spc) {
    block.read_id(spc.id, spc.title);
    spc.kind = Kind;
    cards(io, spc, block.has("BIRTH_DEATH"));
  });
}

bool has_second_card(const PrescribedMotion& motion) {
  const int dof = std::abs(motion.dof);
  return (dof >= 9 && dof <= 11) || motion.quantity == 4;
}

void cards(CardIo& io, PrescribedMotion& motion) {
  io.card();
  io.id("TYPEID", motion.target);
  io.integer("DOF", motion.dof);
  io.integer("VAD", motion.quantity);
  io.id("LCID", motion.curve);
  io.real_or("SF", motion.scale, 1);
  io.id("VID", motion.vector);
  io.real_or("DEATH", motion.death, 1e28);
  io.real("BIRTH", motion.birth);
  if (!has_second_card(motion)) return;
  io.card();
  io.real("OFFSET1", motion.offset_1);
  io.real("OFFSET2", motion.offset_2);
  io.integer("MRB", motion.master_part);
  io.id("NODE1", motion.master_nodes[0]);
  io.id("NODE2", motion.master_nodes[1]);
}

template <MotionTarget Kind>
void read_motions(KeywordBlock& block) {
  read_records(block, block.deck.prescribed_motions,
               [&block](CardIo& io, PrescribedMotion& motion) {
                 block.read_id(motion.id, motion.title);
                 motion.kind = Kind;
                 cards(io, motion);
               });
}

void cards(CardIo& io, InitialVelocity& initial) {
  io.card();
  io.id("NSID", initial.set);
  io.id("NSIDEX", initial.excepted_set);
  io.id("BOXID", initial.box);
  io.integer("IRIGID", initial.rigid_option);
  io.id("ICID", initial.axes);
  io.card();
  io.vec3(kVelocity, initial.velocity);
  io.vec3(kAngular, initial.angular);
  if (!initial.excepted_set.given()) return;
  io.card();
  io.vec3({"VXE", "VYE", "VZE"}, initial.excepted_velocity);
  io.vec3({"VXRE", "VYRE", "VZRE"}, initial.excepted_angular);
}

void cards(CardIo& io, InitialVelocityOf& initial) {
  io.card();
  io.id("NID/PID", initial.target);
  io.vec3(kVelocity, initial.velocity);
  io.vec3(kAngular, initial.angular);
  io.id("ICID", initial.axes);
}

void cards(CardIo& io, InitialVelocityGeneration& initial) {
  io.card();
  io.id("ID", initial.target);
  io.integer("STYP", initial.target_kind);
  io.real("OMEGA", initial.omega);
  io.vec3(kVelocity, initial.velocity);
  io.integer("IVATN", initial.velocity_given);
  io.id("ICID", initial.axes);
  io.card();
  io.vec3({"XC", "YC", "ZC"}, initial.center);
  io.vec3({"NX", "NY", "NZ"}, initial.axis);
  io.integer("PHASE", initial.phase);
  io.integer("IRIGID", initial.rigid_option);
}

template <class Load>
void point_load_fields(CardIo& io, DeckId& target, Load& load) {
  io.card();
  io.id("NID/NSID", target);
  io.integer("DOF", load.dof);
  io.id("LCID", load.curve);
  io.real_or("SF", load.scale, 1);
  io.id("CID", load.axes);
  io.ids("M", load.follower_nodes);
}
void cards(CardIo& io, LoadNode& load) { point_load_fields(io, load.target, load); }
void cards(CardIo& io, LoadRigidBody& load) { point_load_fields(io, load.part, load); }

template <NodeTarget Kind>
void read_nodal_loads(KeywordBlock& block) {
  read_records(block, block.deck.nodal_loads, [](CardIo& io, LoadNode& load) {
    load.kind = Kind;
    cards(io, load);
  });
}

void cards(CardIo& io, LoadPressure& load) {
  io.card();
  const bool is_segment = load.kind == LoadPressure::Target::Segment;
  if (!is_segment) io.id("SSID/EID", load.target);
  io.id("LCID", load.curve);
  io.real_or("SF", load.scale, 1);
  io.real("AT", load.arrival);
  if (is_segment) io.ids("N", load.nodes);
}

template <LoadPressure::Target Kind>
void read_pressures(KeywordBlock& block) {
  read_records(block, block.deck.pressures, [&block](CardIo& io, LoadPressure& load) {
    DeckId id;
    std::string title;
    block.read_id(id, title);
    load.kind = Kind;
    cards(io, load);
  });
}

void cards(CardIo& io, LoadBody& load) {
  io.card();
  io.id("LCID", load.curve);
  io.real_or("SF", load.scale, 1);
  io.id("LCIDDR", load.dynamic_relaxation_curve);
  io.vec3({"XC", "YC", "ZC"}, load.center);
  io.id("CID", load.axes);
}

template <int Axis>
void read_body_loads(KeywordBlock& block) {
  read_records(block, block.deck.body_loads, [](CardIo& io, LoadBody& load) {
    load.axis = Axis;
    cards(io, load);
  });
}

void cards(CardIo& io, LoadBodyParts& parts) {
  io.card();
  io.id("PSID", parts.part_set);
}

void factor_fields(CardIo& io, Damping& damping) {
  constexpr std::array<const char*, 6> kNames{"STX", "STY", "STZ", "SRX", "SRY", "SRZ"};
  for (std::size_t i = 0; i < 6; ++i) io.real(kNames[i], damping.factors[i]);
}

void cards(CardIo& io, Damping& damping) {
  io.card();
  switch (damping.kind) {
    case Damping::Kind::Global:
      io.id("LCID", damping.curve);
      io.real("VALDMP", damping.value);
      return factor_fields(io, damping);
    case Damping::Kind::PartMass:
      io.id("PID/PSID", damping.target);
      io.id("LCID", damping.curve);
      io.real_or("SF", damping.value, 1);
      io.integer("FLAG", damping.has_factors);
      if (damping.has_factors != 1) return;
      io.card();
      return factor_fields(io, damping);
    case Damping::Kind::PartStiffness:
      io.id("PID/PSID", damping.target);
      io.real("COEF", damping.value);
  }
}

template <Damping::Kind Kind>
void read_dampings(KeywordBlock& block) {
  read_records(block, block.deck.dampings, [&block](CardIo& io, Damping& damping) {
    damping.kind = Kind;
    damping.is_part_set = block.has("SET");
    cards(io, damping);
  });
}

template <auto Member>
void read_plain(KeywordBlock& block) {
  read_records(block, block.deck.*Member, [](CardIo& io, auto& record) { cards(io, record); });
}

const std::vector<KeywordEntry>& entries() {
  using Target = LoadPressure::Target;
  static const std::vector<KeywordEntry> kEntries{
      {"BOUNDARY_SPC_NODE", {"ID", "BIRTH_DEATH"}, read_spcs<NodeTarget::Node>},
      {"BOUNDARY_SPC_SET", {"ID", "BIRTH_DEATH"}, read_spcs<NodeTarget::Set>},
      {"BOUNDARY_PRESCRIBED_MOTION_NODE", {"ID"}, read_motions<MotionTarget::Node>},
      {"BOUNDARY_PRESCRIBED_MOTION_SET", {"ID"}, read_motions<MotionTarget::NodeSet>},
      {"BOUNDARY_PRESCRIBED_MOTION_RIGID", {"ID"}, read_motions<MotionTarget::Rigid>},
      {"BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL", {"ID"}, read_motions<MotionTarget::RigidLocal>},
      {"INITIAL_VELOCITY", {}, read_plain<&Deck::initial_velocities>},
      {"INITIAL_VELOCITY_NODE", {}, read_plain<&Deck::nodal_velocities>},
      {"INITIAL_VELOCITY_RIGID_BODY", {}, read_plain<&Deck::rigid_velocities>},
      {"INITIAL_VELOCITY_GENERATION", {}, read_plain<&Deck::generated_velocities>},
      {"LOAD_NODE_POINT", {}, read_nodal_loads<NodeTarget::Node>},
      {"LOAD_NODE_SET", {}, read_nodal_loads<NodeTarget::Set>},
      {"LOAD_RIGID_BODY", {}, read_plain<&Deck::rigid_loads>},
      {"LOAD_SEGMENT", {"ID"}, read_pressures<Target::Segment>},
      {"LOAD_SEGMENT_SET", {"ID"}, read_pressures<Target::SegmentSet>},
      {"LOAD_SHELL_ELEMENT", {"ID"}, read_pressures<Target::Shell>},
      {"LOAD_SHELL_SET", {"ID"}, read_pressures<Target::ShellSet>},
      {"LOAD_BODY_X", {}, read_body_loads<0>},
      {"LOAD_BODY_Y", {}, read_body_loads<1>},
      {"LOAD_BODY_Z", {}, read_body_loads<2>},
      {"LOAD_BODY_RX", {}, read_body_loads<3>},
      {"LOAD_BODY_RY", {}, read_body_loads<4>},
      {"LOAD_BODY_RZ", {}, read_body_loads<5>},
      {"LOAD_BODY_PARTS", {}, read_plain<&Deck::body_load_parts>},
      {"DAMPING_GLOBAL", {}, read_dampings<Damping::Kind::Global>},
      {"DAMPING_PART_MASS", {"SET"}, read_dampings<Damping::Kind::PartMass>},
      {"DAMPING_PART_STIFFNESS", {"SET"}, read_dampings<Damping::Kind::PartStiffness>},
  };
  return kEntries;
}

void write_spcs(CardWriter& out, const Deck& deck) {
  for (Spc spc : deck.spcs) {
    const bool has_times = spc.birth != 0 || spc.death != kNever;
    const bool has_id = spc.id.given() || !spc.title.empty();
    out.keyword(
        std::string(spc.kind == NodeTarget::Node ? "BOUNDARY_SPC_NODE" : "BOUNDARY_SPC_SET") +
        (has_id ? "_ID" : "") + (has_times ? "_BIRTH_DEATH" : ""));
    if (has_id) out.id_and_title(spc.id, spc.title);
    cards(out, spc, has_times);
  }
}

void write_motions(CardWriter& out, const Deck& deck) {
  constexpr const char* kNames[] = {"NODE", "SET", "RIGID", "RIGID_LOCAL"};
  for (PrescribedMotion motion : deck.prescribed_motions) {
    const bool has_id = motion.id.given() || !motion.title.empty();
    out.keyword(std::string("BOUNDARY_PRESCRIBED_MOTION_") + kNames[static_cast<int>(motion.kind)] +
                (has_id ? "_ID" : ""));
    if (has_id) out.id_and_title(motion.id, motion.title);
    cards(out, motion);
  }
}

/// One keyword for each record, its name from the record.
template <class Record, class Name>
void write_named(CardWriter& out, const std::vector<Record>& records, Name name) {
  for (Record record : records) {
    out.keyword(name(record));
    cards(out, record);
  }
}

std::string damping_keyword(const Damping& damping) {
  const std::string set = damping.is_part_set ? "_SET" : "";
  if (damping.kind == Damping::Kind::Global) return "DAMPING_GLOBAL";
  return (damping.kind == Damping::Kind::PartMass ? "DAMPING_PART_MASS"
                                                  : "DAMPING_PART_STIFFNESS") +
         set;
}

}  // namespace

std::span<const KeywordEntry> condition_keywords() { return entries(); }

void write_conditions(CardWriter& out, const Deck& deck) {
  const auto plain = [](CardIo& io, auto& record) { cards(io, record); };
  write_spcs(out, deck);
  write_motions(out, deck);
  write_named(out, deck.initial_velocities, [](const auto&) { return "INITIAL_VELOCITY"; });
  write_records(out, "INITIAL_VELOCITY_NODE", deck.nodal_velocities, plain);
  write_records(out, "INITIAL_VELOCITY_RIGID_BODY", deck.rigid_velocities, plain);
  write_records(out, "INITIAL_VELOCITY_GENERATION", deck.generated_velocities, plain);
  write_named(out, deck.nodal_loads, [](const LoadNode& load) {
    return load.kind == NodeTarget::Node ? "LOAD_NODE_POINT" : "LOAD_NODE_SET";
  });
  write_records(out, "LOAD_RIGID_BODY", deck.rigid_loads, plain);
  write_named(out, deck.pressures, [](const LoadPressure& load) {
    constexpr const char* kNames[] = {"LOAD_SEGMENT", "LOAD_SEGMENT_SET", "LOAD_SHELL_ELEMENT",
                                      "LOAD_SHELL_SET"};
    return kNames[static_cast<int>(load.kind)];
  });
  write_named(out, deck.body_loads, [](const LoadBody& load) {
    constexpr const char* kNames[] = {"LOAD_BODY_X",  "LOAD_BODY_Y",  "LOAD_BODY_Z",
                                      "LOAD_BODY_RX", "LOAD_BODY_RY", "LOAD_BODY_RZ"};
    return kNames[load.axis];
  });
  write_records(out, "LOAD_BODY_PARTS", deck.body_load_parts, plain);
  write_named(out, deck.dampings, damping_keyword);
}

}  // namespace crosswalk::fe
