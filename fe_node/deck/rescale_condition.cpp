// Dimensions of conditions, loads, constraints and contacts.
#include <cmath>

#include <fmt/format.h>

#include "fe_node/deck/rescale_units.h"

namespace crosswalk::fe {

namespace {

void motion(UnitChange& c, PrescribedMotion& m) {
  const int dof = std::abs(m.dof);
  const bool turns = dof >= 5;
  const double place = turns ? 1 : c.u.length;
  const double ordinates[] = {place / c.u.time, place / (c.u.time * c.u.time), place};
  if (m.quantity < 0 || m.quantity > 2 || dof > 8)
    c.refuse(m.source, "*BOUNDARY_PRESCRIBED_MOTION", "a motion relative to another");
  else
    c.curve(m.curve, c.u.time, ordinates[m.quantity], m.source);
  c.time(m.birth, m.death);
}

/// Forces of directions 1 to 4, moments of 5 to 8.
double load_unit(const UnitChange& c, int dof) {
  return std::abs(dof) >= 5 ? c.u.force() * c.u.length : c.u.force();
}

void velocities(UnitChange& c) {
  const double v = c.u.velocity(), w = 1 / c.u.time;
  for (InitialVelocity& initial : c.deck.initial_velocities) {
    initial.velocity *= v;
    initial.excepted_velocity *= v;
    initial.angular *= w;
    initial.excepted_angular *= w;
  }
  for (auto* list : {&c.deck.nodal_velocities, &c.deck.rigid_velocities})
    for (InitialVelocityOf& initial : *list) {
      initial.velocity *= v;
      initial.angular *= w;
    }
  for (InitialVelocityGeneration& initial : c.deck.generated_velocities) {
    c.rate(initial.omega);
    initial.velocity *= v;
    initial.center *= c.u.length;
  }
}

void loads(UnitChange& c) {
  for (LoadNode& load : c.deck.nodal_loads)
    c.curve(load.curve, c.u.time, load_unit(c, load.dof), load.source);
  for (LoadRigidBody& load : c.deck.rigid_loads)
    c.curve(load.curve, c.u.time, load_unit(c, load.dof), load.source);
  for (LoadPressure& load : c.deck.pressures) {
    c.curve(load.curve, c.u.time, c.u.stress(), load.source);
    c.time(load.arrival);
  }
  for (LoadBody& load : c.deck.body_loads) {
    const double base = load.axis < 3 ? c.u.acceleration() : 1 / c.u.time;
    c.curve(load.curve, c.u.time, base, load.source);
    c.curve(load.dynamic_relaxation_curve, c.u.time, base, load.source);
    load.center *= c.u.length;
  }
}

void dampings(UnitChange& c) {
  for (Damping& damping : c.deck.dampings) {
    c.curve(damping.curve, c.u.time, 1 / c.u.time, damping.source);
    // Of mass damping with a curve the value is a plain factor; a stiffness coefficient is a share
    // of critical damping when positive and a time when negative.
    if (damping.kind == Damping::Kind::Global) c.rate(damping.value);
    if (damping.kind == Damping::Kind::PartStiffness && damping.value < 0) c.time(damping.value);
  }
}

void joint_stiffness(UnitChange& c, JointStiffness& stiffness) {
  const bool slides = stiffness.is_translational;
  const double way = slides ? c.u.length : 1;  // rad, whatever the units
  const double load = slides ? c.u.force() : c.u.force() * c.u.length;
  for (std::size_t i = 0; i < 3; ++i) {
    c.curve(stiffness.stiffness_curves[i], way, load, stiffness.source);
    c.curve(stiffness.damping_curves[i], way / c.u.time, load, stiffness.source);
    c.by(load / way, stiffness.friction_stiffness[i]);
    if (stiffness.friction_limit[i] < 0)
      c.refuse(stiffness.source, "*CONSTRAINED_JOINT_STIFFNESS", "a friction curve");
    c.by(load, stiffness.friction_limit[i]);
    if (slides) c.length(stiffness.stop_negative[i], stiffness.stop_positive[i]);
  }
}

void wall(UnitChange& c, RigidWall& wall) {
  c.length(wall.offset, wall.length_l, wall.length_m, wall.length_n, wall.radius,
           wall.cylinder_length);
  c.time(wall.birth, wall.death);
  for (Vec3* point : {&wall.tail, &wall.head, &wall.edge_head}) *point *= c.u.length;
  c.velocity(wall.critical_speed, wall.initial_speed);
  c.mass(wall.mass);
  const double way = wall.motion_option == 1 ? c.u.length : c.u.velocity();
  c.curve(wall.motion_curve, c.u.time, way, wall.source);
}

void contact(UnitChange& c, Contact& contact) {
  c.by(1 / c.u.velocity(), contact.decay);
  c.stress(contact.viscous_friction);
  c.time(contact.birth, contact.death);
  c.length(contact.slave.thickness, contact.master.thickness);
  if (contact.card_a && contact.card_a->airbag_curve.given())
    c.refuse(contact.source, "*CONTACT field LCIDAB", "an airbag curve");
  if (contact.card_b) c.length(contact.card_b->solid_thickness);
  if (contact.card_b) c.stress(contact.card_b->solid_stiffness);
  if (!contact.is_tiebreak) return;
  // OPTION NFLS SFLS of automatic kinds; NFLF SFLF, forces, of nodes; else NFLS SFLS.
  const bool counts_forces =
      !contact.is_automatic && contact.keyword.find("NODES") != std::string::npos;
  const double limit = counts_forces ? c.u.force() : c.u.stress();
  const std::size_t first = contact.is_automatic ? 1 : 0;
  c.by(limit, contact.special[first]);
  c.by(limit, contact.special[first + 1]);
}

}  // namespace

void rescale_conditions(UnitChange& c) {
  for (Spc& spc : c.deck.spcs) c.time(spc.birth, spc.death);
  for (PrescribedMotion& one : c.deck.prescribed_motions) motion(c, one);
  velocities(c);
  loads(c);
  dampings(c);
}

void rescale_constraints(UnitChange& c) {
  for (JointStiffness& stiffness : c.deck.joint_stiffnesses) joint_stiffness(c, stiffness);
  for (NodeTie& tie : c.deck.node_ties) {
    c.force(tie.normal_force, tie.shear_force);
    c.time(tie.failure_time, tie.window);
  }
  for (RigidWall& one : c.deck.rigid_walls) wall(c, one);
  for (Contact& one : c.deck.contacts) contact(c, one);
}

}  // namespace crosswalk::fe
