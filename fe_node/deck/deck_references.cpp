#include "fe_node/deck/deck_references.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "fe_node/deck/cards_material.h"

namespace crosswalk::fe {

namespace {

using Visit = std::function<void(const Reference&)>;

/// Finds the curve and table fields of a material by their names on the card.
class CurveFields final : public CardIo {
 public:
  explicit CurveFields(std::vector<DeckId>& found) : found_(found) {}
  bool is_reading() const override { return false; }
  void card() override {}
  bool has_card() override { return false; }
  bool has_content() override { return false; }
  std::string_view next_line() override { return {}; }
  void real(const char*, double&, int) override {}
  void integer(const char* name, std::int32_t& value, int) override {
    const std::string_view field(name);
    const bool is_curve = field.starts_with("LC") || field.starts_with("TBID") ||
                          field == "LLCID" || field == "ULCID";
    if (is_curve && value != 0) found_.emplace_back(std::abs(value));
  }
  void text(const char*, std::string&, int) override {}
  void line(const char*, std::string&) override {}
  void raw_line(std::string&) override {}
  void id_and_title(DeckId&, std::string&) override {}
  void problem(const char*, const std::string&, const std::string&) override {}
  Source source() const override { return {}; }

 private:
  std::vector<DeckId>& found_;
};

/// Fields that are a value when positive and a curve when negative.
void add_if_negative(double value, std::vector<DeckId>& found) {
  if (value < 0 && value > -2e9) found.emplace_back(static_cast<std::int32_t>(-value));
}

std::vector<DeckId> curves_of(const Material& material) {
  std::vector<DeckId> found;
  CurveFields fields(found);
  Material copy = material;
  std::visit([&](auto& law) { cards(fields, copy, law); }, copy.law);
  if (const auto* muscle = std::get_if<mat::Muscle>(&material.law))
    for (const double value :
         {muscle->activation, muscle->stretch_factor, muscle->rate_factor, muscle->passive_factor})
      add_if_negative(value, found);
  if (const auto* muscle = std::get_if<mat::SpringMuscle>(&material.law))
    for (const double value : {muscle->activation, muscle->speed_scale, muscle->tension_length,
                               muscle->tension_speed, muscle->passive})
      add_if_negative(value, found);
  return found;
}

class Walk {
 public:
  Walk(const Deck& deck, const Visit& visit) : deck_(deck), visit_(visit) {}

  void parts() {
    for (const Part& part : deck_.parts) {
      by(fmt::format("*PART {}", part.id.value), part.source);
      to(Named::Section, part.section);
      to(Named::Material, part.material);
      to(Named::EquationOfState, part.equation_of_state);
      to(Named::Hourglass, part.hourglass);
      if (!part.composite) continue;
      to(Named::Hourglass, part.composite->hourglass);
      for (const CompositeLayer& layer : part.composite->layers)
        to(Named::Material, layer.material);
    }
    for (const Section& section : deck_.sections) {
      by(fmt::format("*SECTION {}", section.id.value), section.source);
      if (const auto* shell = std::get_if<SectionShell>(&section.law))
        if (shell->rule < 0 && shell->rule > -2e9)
          to(Named::Integration, DeckId(static_cast<std::int32_t>(-shell->rule)));
      if (const auto* beam = std::get_if<SectionBeam>(&section.law)) to(Named::Axes, beam->axes);
    }
    for (const Material& material : deck_.materials) {
      by(fmt::format("*{} {}", material_keyword(material), material.id.value), material.source);
      for (const DeckId curve : curves_of(material)) to(Named::Curve, curve);
    }
    for (const AddErosion& erosion : deck_.erosions) {
      by("*MAT_ADD_EROSION", erosion.source);
      to(Named::Material, erosion.material);
    }
    for (const EquationOfState& eos : deck_.equations_of_state) {
      by(fmt::format("*EOS {}", eos.id.value), eos.source);
      if (const auto* table = std::get_if<EosTabulated>(&eos.law)) {
        to(Named::Curve, table->c_curve);
        to(Named::Curve, table->t_curve);
      }
    }
  }

  void tables() {
    for (const DeckTable& table : deck_.tables) {
      by(fmt::format("*DEFINE_TABLE {}", table.id.value), table.source);
      for (const DeckId curve : table.curves) to(Named::Curve, curve);
    }
    for (const CoordinateNodes& axes : deck_.coordinate_nodes) {
      by(fmt::format("*DEFINE_COORDINATE_NODES {}", axes.id.value), axes.source);
      for (const DeckId node : axes.nodes) to(Named::Node, node);
    }
    for (const DeckSet& set : deck_.sets) {
      constexpr Named kSets[] = {Named::NodeSet,  Named::PartSet, Named::ShellSet,
                                 Named::SolidSet, Named::BeamSet, Named::DiscreteSet};
      const Named kind = kSets[static_cast<int>(set.kind)];
      by(fmt::format("*SET {} ({})", set.id.value, named_word(kind)), set.source);
      for (const DeckId added : set.added_sets) to(kind, added);
      if (set.kind == SetKind::Node || set.kind == SetKind::Part)
        for (const DeckId id : set.ids)
          to(set.kind == SetKind::Node ? Named::Node : Named::Part, id);
    }
    for (const SegmentSet& set : deck_.segment_sets) {
      by(fmt::format("*SET_SEGMENT {}", set.id.value), set.source);
      for (const auto& segment : set.segments)
        for (const DeckId node : segment) to(Named::Node, node);
    }
  }

  void conditions() {
    for (const Spc& spc : deck_.spcs) {
      by("*BOUNDARY_SPC", spc.source);
      to(spc.kind == NodeTarget::Node ? Named::Node : Named::NodeSet, spc.target);
      to(Named::Axes, spc.axes);
    }
    for (const PrescribedMotion& motion : deck_.prescribed_motions) {
      constexpr Named kTargets[] = {Named::Node, Named::NodeSet, Named::Part, Named::Part};
      by("*BOUNDARY_PRESCRIBED_MOTION", motion.source);
      to(kTargets[static_cast<int>(motion.kind)], motion.target);
      to(Named::Curve, motion.curve);
      to(Named::Vector, motion.vector);
    }
    for (const InitialVelocity& initial : deck_.initial_velocities) {
      by("*INITIAL_VELOCITY", initial.source);
      to(Named::NodeSet, initial.set);
      to(Named::NodeSet, initial.excepted_set);
      to(Named::Box, initial.box);
    }
    for (const InitialVelocityOf& initial : deck_.nodal_velocities) {
      by("*INITIAL_VELOCITY_NODE", initial.source);
      to(Named::Node, initial.target);
    }
    for (const InitialVelocityOf& initial : deck_.rigid_velocities) {
      by("*INITIAL_VELOCITY_RIGID_BODY", initial.source);
      to(Named::Part, initial.target);
    }
    for (const InitialVelocityGeneration& initial : deck_.generated_velocities) {
      by("*INITIAL_VELOCITY_GENERATION", initial.source);
      if (initial.target_kind >= 1 && initial.target_kind <= 3) {
        constexpr Named kTargets[] = {Named::PartSet, Named::Part, Named::NodeSet};
        to(kTargets[initial.target_kind - 1], initial.target);
      }
    }
    loads();
  }

  void constraints() {
    for (const MergedRigidBodies& merged : deck_.merged_rigid_bodies) {
      by("*CONSTRAINED_RIGID_BODIES", merged.source);
      to(Named::Part, merged.lead);
      to(Named::Part, merged.follower);
    }
    for (const ExtraNodes& extra : deck_.extra_nodes) {
      by("*CONSTRAINED_EXTRA_NODES", extra.source);
      to(Named::Part, extra.part);
      to(extra.kind == NodeTarget::Node ? Named::Node : Named::NodeSet, extra.target);
    }
    for (const NodalRigidBody& body : deck_.nodal_rigid_bodies) {
      by(fmt::format("*CONSTRAINED_NODAL_RIGID_BODY {}", body.id.value), body.source);
      to(Named::NodeSet, body.node_set.given() ? body.node_set : body.id);
      to(Named::Node, body.center_node);
    }
    for (const Joint& joint : deck_.joints) {
      by(fmt::format("*CONSTRAINED_JOINT {}", joint.id.value), joint.source);
      for (const DeckId node : joint.nodes) to(Named::Node, node);
    }
    for (const JointStiffness& stiffness : deck_.joint_stiffnesses) {
      by(fmt::format("*CONSTRAINED_JOINT_STIFFNESS {}", stiffness.id.value), stiffness.source);
      for (const DeckId part : stiffness.parts) to(Named::Part, part);
      for (const DeckId axes : stiffness.axes) to(Named::Axes, axes);
      for (const DeckId curve : stiffness.stiffness_curves) to(Named::Curve, curve);
      for (const DeckId curve : stiffness.damping_curves) to(Named::Curve, curve);
      to(Named::Joint, stiffness.joint);
    }
    for (const NodeTie& tie : deck_.node_ties) {
      by("*CONSTRAINED spot weld or node set", tie.source);
      for (const DeckId node : tie.nodes) to(Named::Node, node);
      to(Named::NodeSet, tie.node_set);
    }
    for (const Interpolation& interpolation : deck_.interpolations) {
      by(fmt::format("*CONSTRAINED_INTERPOLATION {}", interpolation.id.value),
         interpolation.source);
      to(Named::Node, interpolation.dependent);
      for (const InterpolationNode& node : interpolation.nodes)
        to(interpolation.independent_kind == 1 ? Named::NodeSet : Named::Node, node.node);
    }
    for (const RigidWall& wall : deck_.rigid_walls) {
      by(fmt::format("*RIGIDWALL {}", wall.id.value), wall.source);
      to(Named::NodeSet, wall.node_set);
      to(Named::NodeSet, wall.excepted_set);
      to(Named::Box, wall.box);
      to(Named::Curve, wall.motion_curve);
    }
  }

  void contacts() {
    for (const Contact& contact : deck_.contacts) {
      by(fmt::format("*CONTACT {}", contact.id.value), contact.source);
      for (const ContactSide* side : {&contact.slave, &contact.master}) {
        to(Named::Box, side->box);
        switch (side->kind) {
          case SurfaceKind::SegmentSet:
            to(Named::SegmentSet, side->id);
            break;
          case SurfaceKind::ShellSet:
            to(Named::ShellSet, side->id);
            break;
          case SurfaceKind::PartSet:
          case SurfaceKind::ExemptedPartSet:
            to(Named::PartSet, side->id);
            break;
          case SurfaceKind::Part:
            to(Named::Part, side->id);
            break;
          case SurfaceKind::NodeSet:
            to(Named::NodeSet, side->id);
            break;
          case SurfaceKind::All:
            break;
        }
      }
    }
  }

 private:
  void loads() {
    for (const LoadNode& load : deck_.nodal_loads) {
      by("*LOAD_NODE", load.source);
      to(load.kind == NodeTarget::Node ? Named::Node : Named::NodeSet, load.target);
      to(Named::Curve, load.curve);
    }
    for (const LoadRigidBody& load : deck_.rigid_loads) {
      by("*LOAD_RIGID_BODY", load.source);
      to(Named::Part, load.part);
      to(Named::Curve, load.curve);
    }
    for (const LoadPressure& load : deck_.pressures) {
      by("*LOAD_SEGMENT", load.source);
      if (load.kind == LoadPressure::Target::SegmentSet) to(Named::SegmentSet, load.target);
      if (load.kind == LoadPressure::Target::ShellSet) to(Named::ShellSet, load.target);
      for (const DeckId node : load.nodes) to(Named::Node, node);
      if (load.curve.value > 0) to(Named::Curve, load.curve);
    }
    for (const LoadBody& load : deck_.body_loads) {
      by("*LOAD_BODY", load.source);
      to(Named::Curve, load.curve);
    }
    for (const LoadBodyParts& parts : deck_.body_load_parts) {
      by("*LOAD_BODY_PARTS", parts.source);
      to(Named::PartSet, parts.part_set);
    }
    for (const Damping& damping : deck_.dampings) {
      by("*DAMPING", damping.source);
      to(damping.is_part_set ? Named::PartSet : Named::Part, damping.target);
      to(Named::Curve, damping.curve);
    }
  }

  void by(std::string name, Source source) {
    reference_.by = std::move(name);
    reference_.source = source;
  }
  void to(Named kind, DeckId id) {
    if (!id.given()) return;
    reference_.kind = kind;
    reference_.id = kind == Named::Curve && id.value < 0 ? DeckId(-id.value) : id;
    visit_(reference_);
  }

  const Deck& deck_;
  const Visit& visit_;
  Reference reference_{};
};

}  // namespace

const char* named_word(Named kind) {
  constexpr const char* kWords[] = {"node",
                                    "part",
                                    "section",
                                    "material",
                                    "equation of state",
                                    "hourglass",
                                    "integration",
                                    "curve",
                                    "node set",
                                    "part set",
                                    "shell set",
                                    "solid set",
                                    "beam set",
                                    "discrete set",
                                    "segment set",
                                    "coordinate system",
                                    "vector",
                                    "spring orientation",
                                    "box",
                                    "joint"};
  return kWords[static_cast<int>(kind)];
}

void for_each_reference(const Deck& deck, const Visit& visit) {
  Walk walk(deck, visit);
  walk.parts();
  walk.tables();
  walk.conditions();
  walk.constraints();
  walk.contacts();
}

}  // namespace crosswalk::fe
