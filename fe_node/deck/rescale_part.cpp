// Dimensions of nodes, elements, sections, parts, geometry and controls.
#include <cmath>

#include <fmt/format.h>

#include "fe_node/deck/rescale_units.h"

namespace crosswalk::fe {

namespace {

void inertia(const UnitChange& c, double& value) { c.by(c.u.inertia(), value); }

template <class Tensor>
void tensor(const UnitChange& c, Tensor& t) {
  for (double* value : {&t.ixx, &t.ixy, &t.ixz, &t.iyy, &t.iyz, &t.izz}) inertia(c, *value);
}

void rescale(UnitChange& c, PartInertia& given) {
  given.center *= c.u.length;
  c.mass(given.mass);
  tensor(c, given);
  given.velocity *= c.u.velocity();
  given.angular_velocity /= c.u.time;
}

void elements(UnitChange& c) {
  Deck& deck = c.deck;
  for (DeckNode& node : deck.nodes) node.position *= c.u.length;
  for (ShellElement& element : deck.shells) {
    for (double& thickness : element.thickness) c.length(thickness);
    c.length(element.offset);
  }
  for (BeamElement& element : deck.beams)
    if (element.thickness != std::array<double, 5>{})
      c.refuse(element.source, fmt::format("beam {}", element.id.value), "a size of its own");
  for (DiscreteElement& element : deck.discretes) c.length(element.offset);
  for (SeatbeltElement& element : deck.seatbelts) c.length(element.slack_length);
  for (MassElement& element : deck.masses) c.mass(element.mass, element.final_mass);
  for (InertiaElement& element : deck.inertias) {
    tensor(c, element);
    c.mass(element.mass);
  }
  for (AccelerometerElement& element : deck.accelerometers) c.mass(element.mass);
}

void beam_section(UnitChange& c, SectionBeam& beam) {
  const double area = c.u.length * c.u.length;
  for (std::size_t i = 0; i < 2; ++i) c.length(beam.outer_s[i], beam.outer_t[i]);
  c.length(beam.location_s, beam.location_t);
  for (double& size : beam.dimensions) c.length(size);
  for (double* value : {&beam.area, &beam.shear_area, &beam.cable_area}) c.by(area, *value);
  for (double* value : {&beam.iss, &beam.itt, &beam.torsion, &beam.ist}) c.by(area * area, *value);
  c.by(c.u.mass / c.u.length, beam.length_mass);
  c.by(area * c.u.length, beam.volume);
  inertia(c, beam.inertia);
  c.length(beam.cable_offset);
  c.time(beam.ramp_time);
  c.stress(beam.initial_stress);
}

void section(UnitChange& c, Section& section) {
  if (auto* shell = std::get_if<SectionShell>(&section.law)) {
    for (double& thickness : shell->thickness) c.length(thickness);
    c.by(c.u.mass / (c.u.length * c.u.length), shell->area_mass);
  } else if (auto* beam = std::get_if<SectionBeam>(&section.law)) {
    beam_section(c, *beam);
  } else if (auto* spring = std::get_if<SectionDiscrete>(&section.law)) {
    if (spring->is_rotational != 0)
      c.refuse(section.source, fmt::format("*SECTION_DISCRETE {}", section.id.value),
               "a rotational spring");
    c.velocity(spring->test_velocity);
    c.length(spring->clearance, spring->failure_deflection);
    c.length(spring->compression_limit, spring->tension_limit);
  } else if (auto* belt = std::get_if<SectionSeatbelt>(&section.law)) {
    c.by(c.u.length * c.u.length, belt->area);
    c.length(belt->thickness);
  }
}

void parts(UnitChange& c) {
  for (Part& part : c.deck.parts) {
    if (part.inertia) rescale(c, *part.inertia);
    if (part.contact) {
      c.stress(part.contact->viscous);
      c.by(1 / c.u.velocity(), part.contact->decay);
      c.length(part.contact->thickness);
    }
    if (!part.composite) continue;
    c.by(c.u.mass / (c.u.length * c.u.length), part.composite->area_mass);
    for (CompositeLayer& layer : part.composite->layers) c.length(layer.thickness);
  }
  for (Section& one : c.deck.sections) section(c, one);
  for (NodalRigidBody& body : c.deck.nodal_rigid_bodies) rescale(c, body.inertia);
}

void geometry(UnitChange& c) {
  for (CoordinateSystem& axes : c.deck.coordinate_systems) {
    if (axes.is_vector_form) continue;
    for (Vec3* point : {&axes.origin, &axes.x_point, &axes.xy_point}) *point *= c.u.length;
  }
  for (DefinedVector& vector : c.deck.vectors) {
    vector.tail *= c.u.length;
    vector.head *= c.u.length;
  }
  for (DefinedBox& box : c.deck.boxes) {
    box.low *= c.u.length;
    box.high *= c.u.length;
  }
  for (Transformation& transformation : c.deck.transformations)
    for (auto& [option, a] : transformation.rows) {
      if (option == "TRANSL") c.length(a[0], a[1], a[2]);
      if (option == "ROTATE") c.length(a[3], a[4], a[5]);
      if (option == "POINT") c.length(a[1], a[2], a[3]);
      if (option == "TRANSL2ND") c.length(a[2]);
    }
}

void controls(UnitChange& c) {
  Control& control = c.deck.control;
  if (control.end_time) c.time(*control.end_time);
  if (control.time_step) {
    c.time(control.time_step->initial, control.time_step->shell_limit,
           control.time_step->mass_scaled_step);
    c.curve(control.time_step->limit_curve, c.u.time, c.u.time, {});
  }
  if (control.contact) {
    c.by(1 / c.u.velocity(), control.contact->decay);
    c.stress(control.contact->viscous);
    c.length(control.contact->thickness);
  }
  for (DatabaseRequest& request : c.deck.databases) c.time(request.interval);
}

}  // namespace

void rescale_parts(UnitChange& c) {
  elements(c);
  parts(c);
  geometry(c);
  controls(c);
}

}  // namespace crosswalk::fe
