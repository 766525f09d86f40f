// *CONSTRAINED_ and *RIGIDWALL_ cards.
#include "fe_node/deck/cards_part.h"
#include "fe_node/deck/keyword_table.h"

namespace crosswalk::fe {

namespace {

void cards(CardIo& io, MergedRigidBodies& merged) {
  io.card();
  io.id("PIDL", merged.lead);
  io.id("PIDC", merged.follower);
  io.integer("IFLAG", merged.flag);
}

void cards(CardIo& io, ExtraNodes& extra) {
  io.card();
  io.id("PID", extra.part);
  io.id("NID/NSID", extra.target);
  io.integer("IFLAG", extra.flag);
}

template <NodeTarget Kind>
void read_extra_nodes(KeywordBlock& block) {
  read_records(block, block.deck.extra_nodes, [](CardIo& io, ExtraNodes& extra) {
    extra.kind = Kind;
    cards(io, extra);
  });
}

void cards(CardIo& io, NodalRigidBody& body) {
  io.card();
  io.id("PID", body.id);
  io.id("CID", body.axes);
  io.id("NSID", body.node_set);
  io.id("PNODE", body.center_node);
  io.integer("IPRT", body.print);
  io.integer("DRFLAG", body.released_translation);
  io.integer("RRFLAG", body.released_rotation);
  if (body.has_spc) {
    io.card();
    io.reals("CMO/CON", body.spc);
  }
  if (body.has_inertia) inertia_cards(io, body.inertia);
}

void read_nodal_rigid_bodies(KeywordBlock& block) {
  read_records(block, block.deck.nodal_rigid_bodies, [&block](CardIo& io, NodalRigidBody& body) {
    block.read_title(body.title);
    body.has_spc = block.has("SPC");
    body.has_inertia = block.has("INERTIA");
    cards(io, body);
  });
}

void cards(CardIo& io, Joint& joint) {
  constexpr std::array<const char*, 6> kNames{"N1", "N2", "N3", "N4", "N5", "N6"};
  io.card();
  for (std::size_t i = 0; i < 6; ++i) io.id(kNames[i], joint.nodes[i]);
  io.real_or("RPS", joint.penalty_scale, 1);
  io.real_or("DAMP", joint.damping, 1);
  if (!joint.is_local) return;
  io.card();
  io.id("RAID", joint.accelerometer);
  io.integer("LST", joint.axes_option);
}

template <JointKind Kind>
void read_joints(KeywordBlock& block) {
  read_records(block, block.deck.joints, [&block](CardIo& io, Joint& joint) {
    block.read_id(joint.id, joint.title);
    joint.kind = Kind;
    joint.is_local = block.has("LOCAL");
    cards(io, joint);
  });
}

void cards(CardIo& io, JointStiffness& stiffness) {
  io.card();
  io.id("JSID", stiffness.id);
  io.id("PIDA", stiffness.parts[0]);
  io.id("PIDB", stiffness.parts[1]);
  io.id("CIDA", stiffness.axes[0]);
  io.id("CIDB", stiffness.axes[1]);
  io.id("JID", stiffness.joint);
  io.card();
  io.ids("LCID", stiffness.stiffness_curves);
  io.ids("DLCID", stiffness.damping_curves);
  io.card();
  for (std::size_t i = 0; i < 3; ++i) {
    io.real("ES", stiffness.friction_stiffness[i]);
    io.real("FM", stiffness.friction_limit[i]);
  }
  io.card();
  for (std::size_t i = 0; i < 3; ++i) {
    io.real("NSA", stiffness.stop_negative[i]);
    io.real("PSA", stiffness.stop_positive[i]);
  }
}

template <bool IsTranslational>
void read_joint_stiffnesses(KeywordBlock& block) {
  read_records(block, block.deck.joint_stiffnesses,
               [&block](CardIo& io, JointStiffness& stiffness) {
                 block.read_title(stiffness.title);
                 stiffness.is_translational = IsTranslational;
                 cards(io, stiffness);
               });
}

void failure_force_fields(CardIo& io, NodeTie& tie) {
  io.real("SN", tie.normal_force);
  io.real("SS", tie.shear_force);
  io.real("N", tie.normal_exponent);
  io.real("M", tie.shear_exponent);
}

void cards(CardIo& io, NodeTie& tie) {
  io.card();
  switch (tie.kind) {
    case NodeTie::Kind::Spotweld:
      io.id("N1", tie.nodes[0]);
      io.id("N2", tie.nodes[1]);
      failure_force_fields(io, tie);
      io.real_or("TF", tie.failure_time, kNever);
      return io.real("EP", tie.failure_strain);
    case NodeTie::Kind::GeneralizedSpot:
      io.id("NSID", tie.node_set);
      io.id("CID", tie.axes);
      io.integer("FILTER", tie.filter);
      io.real("WINDOW", tie.window);
      io.integer("NPR", tie.print);
      io.integer("NPRT", tie.print_type);
      io.card();
      io.real_or("TFAIL", tie.failure_time, kNever);
      io.real("EPSF", tie.failure_strain);
      return failure_force_fields(io, tie);
    case NodeTie::Kind::NodeSet:
      io.id("NSID", tie.node_set);
      io.integer("DOF", tie.dof);
      return io.real_or("TF", tie.failure_time, kNever);
    case NodeTie::Kind::TiedNodesFailure:
      io.id("NSID", tie.node_set);
      return io.real("EPPF", tie.failure_strain);
  }
}

template <NodeTie::Kind Kind>
void read_ties(KeywordBlock& block) {
  read_records(block, block.deck.node_ties, [&block](CardIo& io, NodeTie& tie) {
    block.read_id(tie.id, tie.title);
    tie.kind = Kind;
    cards(io, tie);
  });
}

void cards(CardIo& io, Interpolation& interpolation) {
  io.card();
  io.id("ICID", interpolation.id);
  io.id("DNID", interpolation.dependent);
  io.integer_or("DDOF", interpolation.dofs, 123456);
  io.id("CIDD", interpolation.axes);
  io.integer("ITYP", interpolation.independent_kind);
  io.integer("IDNSW", interpolation.set_option);
  io.rows(interpolation.nodes, [&io](InterpolationNode& node) {
    io.card();
    io.id("INID", node.node);
    io.integer_or("IDOF", node.dofs, 123456);
    io.real_or("TWGHTX", node.weight, 1);
    io.reals("WGHT", node.more_weights);
  });
}

void read_interpolation(KeywordBlock& block) {
  Interpolation interpolation;
  interpolation.source = block.io.keyword_source();
  cards(block.io, interpolation);
  block.deck.interpolations.push_back(std::move(interpolation));
}

void edge_fields(CardIo& io, RigidWall& wall) {
  io.card();
  io.vec3({"XHEV", "YHEV", "ZHEV"}, wall.edge_head);
  io.real("LENL", wall.length_l);
  io.real("LENM", wall.length_m);
}

void plane_cards(CardIo& io, RigidWall& wall) {
  io.card();
  io.id("NSID", wall.node_set);
  io.id("NSIDEX", wall.excepted_set);
  io.id("BOXID", wall.box);
  io.real("OFFSET", wall.offset);
  io.real("BIRTH", wall.birth);
  io.real_or("DEATH", wall.death, kNever);
  io.real("RWKSF", wall.stiffness);
  io.card();
  io.vec3({"XT", "YT", "ZT"}, wall.tail);
  io.vec3({"XH", "YH", "ZH"}, wall.head);
  io.real("FRIC", wall.friction);
  io.real("WVEL", wall.critical_speed);
  if (wall.is_finite) edge_fields(io, wall);
  if (wall.is_moving) {
    io.card();
    io.real("MASS", wall.mass);
    io.real("V0", wall.initial_speed);
  }
  if (wall.has_forces) {
    io.card();
    io.reals("SOFT/N", wall.forces);
  }
}

void geometric_cards(CardIo& io, RigidWall& wall) {
  using Shape = RigidWall::Shape;
  io.card();
  io.id("NSID", wall.node_set);
  io.id("NSIDEX", wall.excepted_set);
  io.id("BOXID", wall.box);
  io.real("BIRTH", wall.birth);
  io.real_or("DEATH", wall.death, kNever);
  io.card();
  io.vec3({"XT", "YT", "ZT"}, wall.tail);
  io.vec3({"XH", "YH", "ZH"}, wall.head);
  io.real("FRIC", wall.friction);
  if (wall.shape == Shape::Flat || wall.shape == Shape::Prism) edge_fields(io, wall);
  if (wall.shape == Shape::Prism) io.real("LENP", wall.length_n);
  if (wall.shape == Shape::Cylinder) {
    io.card();
    io.real("RADCYL", wall.radius);
    io.real("LENCYL", wall.cylinder_length);
  }
  if (wall.shape == Shape::Sphere) {
    io.card();
    io.real("RADSPH", wall.radius);
  }
  if (wall.is_moving) {
    io.card();
    io.id("LCID", wall.motion_curve);
    io.integer("OPT", wall.motion_option);
    io.vec3({"VX", "VY", "VZ"}, wall.motion_direction);
  }
  if (wall.has_display && io.has_optional(wall.display != std::array<double, 8>{})) {
    io.card();
    io.reals("PID/RO/E", wall.display);
  }
}

void cards(CardIo& io, RigidWall& wall) {
  wall.shape == RigidWall::Shape::Plane ? plane_cards(io, wall) : geometric_cards(io, wall);
}

template <RigidWall::Shape Shape>
void read_walls(KeywordBlock& block) {
  read_records(block, block.deck.rigid_walls, [&block](CardIo& io, RigidWall& wall) {
    block.read_id(wall.id, wall.title);
    wall.shape = Shape;
    wall.is_finite = block.has("FINITE");
    wall.is_moving = block.has("MOVING") || block.has("MOTION");
    wall.has_forces = block.has("FORCES");
    wall.has_display = block.has("DISPLAY");
    cards(io, wall);
  });
}

template <auto Member>
void read_plain(KeywordBlock& block) {
  read_records(block, block.deck.*Member, [](CardIo& io, auto& record) { cards(io, record); });
}

constexpr const char* kJointNames[] = {"SPHERICAL", "REVOLUTE",      "CYLINDRICAL", "PLANAR",
                                       "UNIVERSAL", "TRANSLATIONAL", "LOCKING"};
constexpr const char* kTieNames[] = {"SPOTWELD", "GENERALIZED_WELD_SPOT", "NODE_SET",
                                     "TIED_NODES_FAILURE"};
constexpr const char* kWallNames[] = {"PLANAR", "GEOMETRIC_FLAT", "GEOMETRIC_PRISM",
                                      "GEOMETRIC_CYLINDER", "GEOMETRIC_SPHERE"};

const std::vector<KeywordEntry>& entries() {
  using Shape = RigidWall::Shape;
  static const std::vector<std::string_view> kJoint{"ID", "LOCAL"};
  static const std::vector<std::string_view> kGeometric{"ID", "MOTION", "DISPLAY"};
  static const std::vector<KeywordEntry> kEntries{
      {"CONSTRAINED_RIGID_BODIES", {}, read_plain<&Deck::merged_rigid_bodies>},
      {"CONSTRAINED_EXTRA_NODES_NODE", {}, read_extra_nodes<NodeTarget::Node>},
      {"CONSTRAINED_EXTRA_NODES_SET", {}, read_extra_nodes<NodeTarget::Set>},
      {"CONSTRAINED_NODAL_RIGID_BODY", {"SPC", "INERTIA", "TITLE"}, read_nodal_rigid_bodies},
      {"CONSTRAINED_JOINT_SPHERICAL", kJoint, read_joints<JointKind::Spherical>},
      {"CONSTRAINED_JOINT_REVOLUTE", kJoint, read_joints<JointKind::Revolute>},
      {"CONSTRAINED_JOINT_CYLINDRICAL", kJoint, read_joints<JointKind::Cylindrical>},
      {"CONSTRAINED_JOINT_PLANAR", kJoint, read_joints<JointKind::Planar>},
      {"CONSTRAINED_JOINT_UNIVERSAL", kJoint, read_joints<JointKind::Universal>},
      {"CONSTRAINED_JOINT_TRANSLATIONAL", kJoint, read_joints<JointKind::Translational>},
      {"CONSTRAINED_JOINT_LOCKING", kJoint, read_joints<JointKind::Locking>},
      {"CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", {"TITLE"}, read_joint_stiffnesses<false>},
      {"CONSTRAINED_JOINT_STIFFNESS_TRANSLATIONAL", {"TITLE"}, read_joint_stiffnesses<true>},
      {"CONSTRAINED_SPOTWELD", {"ID"}, read_ties<NodeTie::Kind::Spotweld>},
      {"CONSTRAINED_GENERALIZED_WELD_SPOT", {"ID"}, read_ties<NodeTie::Kind::GeneralizedSpot>},
      {"CONSTRAINED_NODE_SET", {"ID"}, read_ties<NodeTie::Kind::NodeSet>},
      {"CONSTRAINED_TIED_NODES_FAILURE", {}, read_ties<NodeTie::Kind::TiedNodesFailure>},
      {"CONSTRAINED_INTERPOLATION", {}, read_interpolation},
      {"RIGIDWALL_PLANAR",
       {"ID", "FINITE", "MOVING", "FORCES", "DISPLAY"},
       read_walls<Shape::Plane>},
      {"RIGIDWALL_GEOMETRIC_FLAT", kGeometric, read_walls<Shape::Flat>},
      {"RIGIDWALL_GEOMETRIC_PRISM", kGeometric, read_walls<Shape::Prism>},
      {"RIGIDWALL_GEOMETRIC_CYLINDER", kGeometric, read_walls<Shape::Cylinder>},
      {"RIGIDWALL_GEOMETRIC_SPHERE", kGeometric, read_walls<Shape::Sphere>},
  };
  return kEntries;
}

/// A keyword, the options of its record, and the number-and-title line where the record has one.
template <class Record>
void write_one(CardWriter& out, std::string keyword, Record record) {
  const bool has_id = record.id.given() || !record.title.empty();
  out.keyword(keyword + (has_id ? "_ID" : ""));
  if (has_id) out.id_and_title(record.id, record.title);
  cards(out, record);
}

void write_rigid_walls(CardWriter& out, const Deck& deck) {
  for (const RigidWall& wall : deck.rigid_walls) {
    const bool is_plane = wall.shape == RigidWall::Shape::Plane;
    write_one(out,
              std::string("RIGIDWALL_") + kWallNames[static_cast<int>(wall.shape)] +
                  (wall.is_finite ? "_FINITE" : "") +
                  (wall.is_moving ? (is_plane ? "_MOVING" : "_MOTION") : "") +
                  (wall.has_forces ? "_FORCES" : "") + (wall.has_display ? "_DISPLAY" : ""),
              wall);
  }
}

}  // namespace

std::span<const KeywordEntry> constraint_keywords() { return entries(); }

void write_constraints(CardWriter& out, const Deck& deck) {
  const auto plain = [](CardIo& io, auto& record) { cards(io, record); };
  write_records(out, "CONSTRAINED_RIGID_BODIES", deck.merged_rigid_bodies, plain);
  for (ExtraNodes extra : deck.extra_nodes) {
    out.keyword(extra.kind == NodeTarget::Node ? "CONSTRAINED_EXTRA_NODES_NODE"
                                               : "CONSTRAINED_EXTRA_NODES_SET");
    cards(out, extra);
  }
  for (NodalRigidBody body : deck.nodal_rigid_bodies) {
    out.keyword_with_title(std::string("CONSTRAINED_NODAL_RIGID_BODY") +
                               (body.has_spc ? "_SPC" : "") + (body.has_inertia ? "_INERTIA" : ""),
                           body.title);
    cards(out, body);
  }
  for (const Joint& joint : deck.joints)
    write_one(out,
              std::string("CONSTRAINED_JOINT_") + kJointNames[static_cast<int>(joint.kind)] +
                  (joint.is_local ? "_LOCAL" : ""),
              joint);
  for (JointStiffness stiffness : deck.joint_stiffnesses) {
    out.keyword_with_title(std::string("CONSTRAINED_JOINT_STIFFNESS_") +
                               (stiffness.is_translational ? "TRANSLATIONAL" : "GENERALIZED"),
                           stiffness.title);
    cards(out, stiffness);
  }
  for (const NodeTie& tie : deck.node_ties)
    write_one(out, std::string("CONSTRAINED_") + kTieNames[static_cast<int>(tie.kind)], tie);
  for (Interpolation interpolation : deck.interpolations) {
    out.keyword("CONSTRAINED_INTERPOLATION");
    cards(out, interpolation);
  }
  write_rigid_walls(out, deck);
}

}  // namespace crosswalk::fe
