#include "fe_node/deck/renumber.h"

#include <string>

#include "fe_node/deck/renumber_ids.h"

namespace crosswalk::fe {

namespace {

class DeckRenumbering {
 public:
  DeckRenumbering(Deck& deck, const IdOffsets& offsets)
      : deck_(deck), by_(offsets), move_(offsets) {}

  bool run() {
    mesh();
    parts();
    renumber_materials(deck_, move_);
    tables();
    sets();
    conditions();
    loads();
    constraints();
    contacts();
    output();
    return move_.fits;
  }

 private:
  template <class Element>
  void elements(std::vector<Element>& list) {
    for (Element& element : list) {
      move_(element.id, by_.element);
      move_(element.part, by_.part);
      move_.all(element.nodes, by_.node);
    }
  }

  void mesh() {
    for (DeckNode& node : deck_.nodes) move_(node.id, by_.node);
    elements(deck_.solids);
    elements(deck_.shells);
    elements(deck_.thick_shells);
    elements(deck_.beams);
    elements(deck_.discretes);
    elements(deck_.seatbelts);
    for (DiscreteElement& element : deck_.discretes) move_(element.orientation, by_.definition);
    for (SeatbeltElement& element : deck_.seatbelts) move_(element.retractor, by_.element);
    for (MassElement& element : deck_.masses) {
      const int targets[] = {by_.node, by_.set, by_.part, by_.set};
      move_(element.id, by_.element);
      move_(element.target, targets[static_cast<int>(element.kind)]);
      move_(element.part, by_.part);
    }
    for (InertiaElement& element : deck_.inertias) {
      move_(element.id, by_.element);
      move_(element.node, by_.node);
      move_(element.axes, by_.definition);
    }
    for (AccelerometerElement& element : deck_.accelerometers) {
      move_(element.id, by_.element);
      move_.all(element.nodes, by_.node);
    }
  }

  void inertia(PartInertia& inertia) {
    move_(inertia.center_node, by_.node);
    move_(inertia.axes, by_.definition);
  }

  void parts() {
    for (Part& part : deck_.parts) {
      move_(part.id, by_.part);
      move_(part.section, by_.other);
      move_(part.material, by_.material);
      move_(part.equation_of_state, by_.material);
      move_(part.hourglass, by_.other);
      move_(part.thermal, by_.material);
      if (part.inertia) inertia(*part.inertia);
      if (!part.composite) continue;
      move_(part.composite->hourglass, by_.other);
      for (CompositeLayer& layer : part.composite->layers) move_(layer.material, by_.material);
    }
    for (Section& section : deck_.sections) {
      move_(section.id, by_.other);
      if (auto* shell = std::get_if<SectionShell>(&section.law)) {
        move_.if_negative(shell->rule, by_.other);
        move_.add(shell->edge_set, by_.set);
      }
      if (auto* beam = std::get_if<SectionBeam>(&section.law)) move_(beam->axes, by_.definition);
    }
    for (Hourglass& hourglass : deck_.hourglasses) move_(hourglass.id, by_.other);
    for (IntegrationShell& rule : deck_.integrations) {
      move_(rule.id, by_.other);
      for (IntegrationPoint& point : rule.rows) move_(point.part, by_.part);
    }
  }

  void tables() {
    for (DeckCurve& curve : deck_.curves) move_(curve.id, by_.curve);
    for (CurveFunction& function : deck_.curve_functions) move_(function.id, by_.curve);
    for (DeckTable& table : deck_.tables) {
      move_(table.id, by_.curve);
      move_.all(table.curves, by_.curve);
    }
    for (CoordinateNodes& axes : deck_.coordinate_nodes) {
      move_(axes.id, by_.definition);
      move_.all(axes.nodes, by_.node);
    }
    for (CoordinateSystem& axes : deck_.coordinate_systems) {
      move_(axes.id, by_.definition);
      move_(axes.axes, by_.definition);
      move_(axes.node, by_.node);
    }
    for (DefinedVector& vector : deck_.vectors) {
      move_(vector.id, by_.definition);
      move_(vector.axes, by_.definition);
    }
    for (SpringOrientation& orientation : deck_.spring_orientations) {
      move_(orientation.id, by_.definition);
      move_.all(orientation.nodes, by_.node);
    }
    for (DefinedBox& box : deck_.boxes) move_(box.id, by_.definition);
    for (Transformation& transformation : deck_.transformations)
      move_(transformation.id, by_.definition);
  }

  /// What the ids of a GENERAL row name; `own` is the offset of the set's own kind of member.
  int named_by(const std::string& option, int own) const {
    const auto has = [&](const char* word) { return option.find(word) != option.npos; };
    if (has("SET")) return by_.set;
    if (has("BOX") || has("VOL")) return by_.definition;
    if (has("PART")) return by_.part;
    if (has("NODE") || has("SEG")) return by_.node;
    return has("SHELL") || has("SOLID") || has("BEAM") || has("DISCRETE") || has("ELEM")
               ? by_.element
               : own;
  }

  void sets() {
    for (DeckSet& set : deck_.sets) {
      move_(set.id, by_.set);
      const int own = set.kind == SetKind::Node   ? by_.node
                      : set.kind == SetKind::Part ? by_.part
                                                  : by_.element;
      move_.all(set.ids, own);
      for (auto& [first, last] : set.ranges) {
        move_(first, own);
        move_(last, own);
      }
      for (GeneralEntry& entry : set.general) move_.all(entry.ids, named_by(entry.option, own));
      move_.all(set.added_sets, by_.set);
    }
    for (SegmentSet& set : deck_.segment_sets) {
      move_(set.id, by_.set);
      for (auto& segment : set.segments) move_.all(segment, by_.node);
      for (GeneralEntry& entry : set.general)
        move_.all(entry.ids, named_by(entry.option, by_.node));
    }
  }

  int of(NodeTarget kind) const { return kind == NodeTarget::Node ? by_.node : by_.set; }

  void conditions() {
    for (Spc& spc : deck_.spcs) {
      move_(spc.id, by_.other);
      move_(spc.target, of(spc.kind));
      move_(spc.axes, by_.definition);
    }
    for (PrescribedMotion& motion : deck_.prescribed_motions) {
      const int targets[] = {by_.node, by_.set, by_.part, by_.part};
      move_(motion.id, by_.other);
      move_(motion.target, targets[static_cast<int>(motion.kind)]);
      move_(motion.curve, by_.curve);
      move_(motion.vector, by_.definition);
      move_.add(motion.master_part, by_.part);
      move_.all(motion.master_nodes, by_.node);
    }
    for (InitialVelocity& initial : deck_.initial_velocities) {
      move_(initial.set, by_.set);
      move_(initial.excepted_set, by_.set);
      move_(initial.box, by_.definition);
      move_(initial.axes, by_.definition);
    }
    for (InitialVelocityOf& initial : deck_.nodal_velocities) {
      move_(initial.target, by_.node);
      move_(initial.axes, by_.definition);
    }
    for (InitialVelocityOf& initial : deck_.rigid_velocities) {
      move_(initial.target, by_.part);
      move_(initial.axes, by_.definition);
    }
    for (InitialVelocityGeneration& initial : deck_.generated_velocities) {
      move_(initial.target, initial.target_kind == 2 ? by_.part : by_.set);
      move_(initial.axes, by_.definition);
    }
    for (Damping& damping : deck_.dampings) {
      move_(damping.target, damping.is_part_set ? by_.set : by_.part);
      move_(damping.curve, by_.curve);
    }
  }

  void loads() {
    for (LoadNode& load : deck_.nodal_loads) {
      move_(load.target, of(load.kind));
      move_(load.curve, by_.curve);
      move_(load.axes, by_.definition);
      move_.all(load.follower_nodes, by_.node);
    }
    for (LoadRigidBody& load : deck_.rigid_loads) {
      move_(load.part, by_.part);
      move_(load.curve, by_.curve);
      move_(load.axes, by_.definition);
      move_.all(load.follower_nodes, by_.node);
    }
    for (LoadPressure& load : deck_.pressures) {
      move_(load.target, load.kind == LoadPressure::Target::Shell ? by_.element : by_.set);
      move_.all(load.nodes, by_.node);
      move_(load.curve, by_.curve);
    }
    for (LoadBody& load : deck_.body_loads) {
      move_(load.curve, by_.curve);
      move_(load.dynamic_relaxation_curve, by_.curve);
      move_(load.axes, by_.definition);
    }
    for (LoadBodyParts& parts : deck_.body_load_parts) move_(parts.part_set, by_.set);
  }

  void constraints() {
    for (MergedRigidBodies& merged : deck_.merged_rigid_bodies) {
      move_(merged.lead, by_.part);
      move_(merged.follower, by_.part);
    }
    for (ExtraNodes& extra : deck_.extra_nodes) {
      move_(extra.part, by_.part);
      move_(extra.target, of(extra.kind));
    }
    for (NodalRigidBody& body : deck_.nodal_rigid_bodies) {
      if (!body.node_set.given()) body.node_set = body.id;  // the manual's default
      move_(body.id, by_.part);
      move_(body.node_set, by_.set);
      move_(body.axes, by_.definition);
      move_(body.center_node, by_.node);
      inertia(body.inertia);
      if (body.spc[0] == -1) move_.add_to_number(body.spc[1], by_.definition);
    }
    for (Joint& joint : deck_.joints) {
      move_(joint.id, by_.other);
      move_.all(joint.nodes, by_.node);
      move_(joint.accelerometer, by_.element);
    }
    for (JointStiffness& stiffness : deck_.joint_stiffnesses) {
      move_(stiffness.id, by_.other);
      move_.all(stiffness.parts, by_.part);
      move_.all(stiffness.axes, by_.definition);
      move_(stiffness.joint, by_.other);
      move_.all(stiffness.stiffness_curves, by_.curve);
      move_.all(stiffness.damping_curves, by_.curve);
      for (double& limit : stiffness.friction_limit) move_.if_negative(limit, by_.curve);
    }
    for (NodeTie& tie : deck_.node_ties) {
      move_(tie.id, by_.other);
      move_.all(tie.nodes, by_.node);
      move_(tie.node_set, by_.set);
      move_(tie.axes, by_.definition);
    }
    for (Interpolation& interpolation : deck_.interpolations) {
      move_(interpolation.id, by_.other);
      move_(interpolation.dependent, by_.node);
      move_(interpolation.axes, by_.definition);
      const int independent = interpolation.independent_kind == 1 ? by_.set : by_.node;
      for (InterpolationNode& node : interpolation.nodes) move_(node.node, independent);
    }
    walls();
  }

  void walls() {
    for (RigidWall& wall : deck_.rigid_walls) {
      move_(wall.id, by_.other);
      move_(wall.node_set, by_.set);
      move_(wall.excepted_set, by_.set);
      move_(wall.box, by_.definition);
      move_(wall.motion_curve, by_.curve);
      move_.add_to_number(wall.display[0], by_.part);
      move_.add_to_number(wall.forces[1], by_.set);
      for (std::size_t i = 2; i < 6; ++i) move_.add_to_number(wall.forces[i], by_.node);
    }
  }

  void contacts() {
    for (Contact& contact : deck_.contacts) {
      move_(contact.id, by_.other);
      for (ContactSide* side : {&contact.slave, &contact.master}) {
        const int sides[] = {by_.set, by_.set, by_.set, by_.part, by_.set, 0, by_.set};
        move_(side->id, sides[static_cast<int>(side->kind)]);
        move_(side->box, by_.definition);
      }
      if (contact.card_a) move_(contact.card_a->airbag_curve, by_.curve);
      if (contact.card_c) move_(contact.card_c->output_axes, by_.definition);
    }
  }

  void output() {
    if (deck_.control.time_step) move_(deck_.control.time_step->limit_curve, by_.curve);
    if (deck_.control.accuracy) move_(deck_.control.accuracy->part_set, by_.set);
    for (HistoryRequest& request : deck_.histories) {
      move_(request.id, request.is_set ? by_.set : request.kind == "NODE" ? by_.node : by_.element);
      move_(request.axes, by_.definition);
    }
    for (CrossSection& section : deck_.cross_sections) {
      const int references[] = {by_.part, by_.element, by_.definition};
      move_(section.id, by_.other);
      for (DeckId* set : {&section.nodes, &section.solids, &section.beams, &section.shells,
                          &section.thick_shells, &section.discretes})
        move_(*set, by_.set);
      if (section.reference_kind >= 0 && section.reference_kind <= 2)
        move_(section.reference, references[section.reference_kind]);
    }
  }

  Deck& deck_;
  const IdOffsets& by_;
  Renumbering move_;
};

}  // namespace

bool renumber(Deck& deck, const IdOffsets& offsets) {
  return offsets == IdOffsets{} || DeckRenumbering(deck, offsets).run();
}

}  // namespace crosswalk::fe
