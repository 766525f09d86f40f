// A keyword deck in memory: typed records as read or generated, user ids, user units.
//
// The reader (keyword_reader.h), the generators and the writer (deck_writer.h) meet here;
// model_builder turns a Deck into a Model and converts units once. Records keep their order. Every
// record knows where it stands (Source, place()); a generated one has no place. Two decks compare
// equal when they say the same, wherever their records stand.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "fe_node/deck/condition_records.h"
#include "fe_node/deck/contact_records.h"
#include "fe_node/deck/control_records.h"
#include "fe_node/deck/deck_id.h"
#include "fe_node/deck/material_records.h"
#include "fe_node/deck/mesh_records.h"
#include "fe_node/deck/part_records.h"
#include "fe_node/deck/table_records.h"

namespace crosswalk::fe {

/// Consistent systems by their length-mass-time units.
enum class UnitSystem { Unknown, MKgS, MmTonneS, MmKgMs, MmGramMs, CmGramUs, InchSlinchS };

/// SI value of one deck unit: 1 deck length = `length` m and so on. Derived units follow.
struct UnitFactors {
  double length = 1, mass = 1, time = 1;
  double velocity() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double force() const { return mass * length / (time * time); }
  double stress() const { return mass / (length * time * time); }
  double density() const { return mass / (length * length * length); }
  double energy() const { return force() * length; }
  double inertia() const { return mass * length * length; }
};
UnitFactors unit_factors(UnitSystem system);
/// "mm-kg-ms" and so on, as in `$ crosswalk: unit_system=mm-kg-ms`; and back (Unknown when none).
std::string_view unit_system_name(UnitSystem system);
UnitSystem unit_system_from(std::string_view name);

/// A file named by *INCLUDE that could not be found.
struct MissingInclude {
  std::string name;
  Source source;
  bool operator==(const MissingInclude&) const = default;
};

/// Names of the files a deck was read from; not part of what the deck says.
struct DeckFiles {
  std::vector<std::string> names;
  friend bool operator==(const DeckFiles&, const DeckFiles&) { return true; }
};

struct Deck {
  std::string title;
  UnitSystem units = UnitSystem::Unknown;  ///< stated by the deck; Unknown: not stated
  DeckFiles files;                         ///< in reading order; Source::file indexes it

  std::vector<DeckNode> nodes;
  std::vector<SolidElement> solids;
  std::vector<ShellElement> shells;
  std::vector<ThickShellElement> thick_shells;
  std::vector<BeamElement> beams;
  std::vector<DiscreteElement> discretes;
  std::vector<SeatbeltElement> seatbelts;
  std::vector<MassElement> masses;
  std::vector<InertiaElement> inertias;
  std::vector<AccelerometerElement> accelerometers;

  std::vector<Part> parts;
  std::vector<Section> sections;
  std::vector<Material> materials;
  std::vector<AddErosion> erosions;
  std::vector<Hourglass> hourglasses;
  std::vector<EquationOfState> equations_of_state;
  std::vector<IntegrationShell> integrations;

  std::vector<DeckCurve> curves;
  std::vector<CurveFunction> curve_functions;
  std::vector<DeckTable> tables;
  std::vector<DeckSet> sets;
  std::vector<SegmentSet> segment_sets;
  std::vector<CoordinateNodes> coordinate_nodes;
  std::vector<CoordinateSystem> coordinate_systems;
  std::vector<DefinedVector> vectors;
  std::vector<SpringOrientation> spring_orientations;
  std::vector<DefinedBox> boxes;
  std::vector<Transformation> transformations;

  std::vector<Spc> spcs;
  std::vector<PrescribedMotion> prescribed_motions;
  std::vector<InitialVelocity> initial_velocities;
  std::vector<InitialVelocityOf> nodal_velocities;
  std::vector<InitialVelocityOf> rigid_velocities;
  std::vector<InitialVelocityGeneration> generated_velocities;
  std::vector<LoadNode> nodal_loads;
  std::vector<LoadRigidBody> rigid_loads;
  std::vector<LoadPressure> pressures;
  std::vector<LoadBody> body_loads;
  std::vector<LoadBodyParts> body_load_parts;
  std::vector<Damping> dampings;

  std::vector<Contact> contacts;
  std::vector<MergedRigidBodies> merged_rigid_bodies;
  std::vector<ExtraNodes> extra_nodes;
  std::vector<NodalRigidBody> nodal_rigid_bodies;
  std::vector<Joint> joints;
  std::vector<JointStiffness> joint_stiffnesses;
  std::vector<NodeTie> node_ties;
  std::vector<Interpolation> interpolations;
  std::vector<RigidWall> rigid_walls;

  Control control;
  std::vector<DatabaseRequest> databases;
  std::vector<HistoryRequest> histories;
  std::vector<CrossSection> cross_sections;
  std::vector<UnreadKeyword> unread;
  std::vector<MissingInclude> missing_includes;

  /// Where a record stands, for messages.
  Place place(Source source) const;
  /// Same content; files and places do not count.
  bool operator==(const Deck& other) const = default;
};

}  // namespace crosswalk::fe
