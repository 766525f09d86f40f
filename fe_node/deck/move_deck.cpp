#include "fe_node/deck/move_deck.h"

#include <algorithm>

#include <fmt/format.h>

namespace crosswalk::fe {

namespace {

/// Some but not all of three directions: turning would change what is held.
bool is_partial(bool x, bool y, bool z) { return (x || y || z) && !(x && y && z); }
bool is_partial_code(int code) { return code >= 1 && code <= 6; }

class DeckMove {
 public:
  DeckMove(Deck& deck, const AffineMap& map, DeckProblems& problems)
      : deck_(deck), map_(map), problems_(problems) {}

  void run() {
    points();
    inertias();
    directions();
    if (map_.turns()) tell_of_global_axes();
  }

 private:
  void at(Vec3& point) const { point = map_.point(point); }
  void turn(Vec3& direction) const { direction = map_.rotation * direction; }

  void points() {
    for (DeckNode& node : deck_.nodes) at(node.position);
    for (CoordinateSystem& axes : deck_.coordinate_systems) {
      if (axes.is_vector_form) {
        turn(axes.x_point);
        turn(axes.xy_point);
      } else if (!axes.axes.given()) {
        for (Vec3* point : {&axes.origin, &axes.x_point, &axes.xy_point}) at(*point);
      }
    }
    for (DefinedVector& vector : deck_.vectors)
      if (!vector.axes.given()) {
        at(vector.tail);
        at(vector.head);
      }
    for (DefinedBox& box : deck_.boxes) {
      if (map_.turns())
        problems_.errors.add(deck_.place(box.source), fmt::format("*DEFINE_BOX {}", box.id.value),
                             "a box along the global axes", "one that the transformation turns",
                             "use sets of nodes instead");
      at(box.low);
      at(box.high);
    }
    for (RigidWall& wall : deck_.rigid_walls) {
      for (Vec3* point : {&wall.tail, &wall.head}) at(*point);
      if (!wall.edge_head.isZero(0)) at(wall.edge_head);
      turn(wall.motion_direction);
    }
  }

  template <class Tensor>
  void turn_tensor(Tensor& t) const {
    Mat3 I;
    I << t.ixx, t.ixy, t.ixz, t.ixy, t.iyy, t.iyz, t.ixz, t.iyz, t.izz;
    I = map_.rotation * I * map_.rotation.transpose();
    t.ixx = I(0, 0), t.iyy = I(1, 1), t.izz = I(2, 2);
    t.ixy = I(0, 1), t.ixz = I(0, 2), t.iyz = I(1, 2);
  }

  void inertia(PartInertia& given) const {
    at(given.center);
    turn(given.velocity);
    turn(given.angular_velocity);
    if (given.axes_kind != 1) return turn_tensor(given);
    turn(given.x_axis);
    turn(given.in_plane);
  }

  void inertias() {
    for (Part& part : deck_.parts)
      if (part.inertia) inertia(*part.inertia);
    for (NodalRigidBody& body : deck_.nodal_rigid_bodies)
      if (body.has_inertia) inertia(body.inertia);
    for (InertiaElement& element : deck_.inertias)
      if (!element.axes.given()) turn_tensor(element);
  }

  void directions() {
    for (BeamElement& element : deck_.beams) turn(element.orientation);
    for (SpringOrientation& orientation : deck_.spring_orientations) turn(orientation.direction);
    for (InitialVelocity& initial : deck_.initial_velocities) {
      if (initial.axes.given()) continue;
      for (Vec3* v : {&initial.velocity, &initial.angular, &initial.excepted_velocity,
                      &initial.excepted_angular})
        turn(*v);
    }
    for (auto* list : {&deck_.nodal_velocities, &deck_.rigid_velocities})
      for (InitialVelocityOf& initial : *list) {
        if (initial.axes.given()) continue;
        turn(initial.velocity);
        turn(initial.angular);
      }
    for (InitialVelocityGeneration& initial : deck_.generated_velocities) {
      at(initial.center);
      turn(initial.axis);
      if (!initial.axes.given()) turn(initial.velocity);
    }
  }

  void tell(Source source, const char* keyword) {
    problems_.warnings.add(deck_.place(source), keyword, "axes of its own",
                           "the global axes in a file that is turned",
                           "it still acts along the global axes");
  }

  void tell_of_global_axes() {
    for (const DeckNode& node : deck_.nodes)
      if (is_partial_code(node.fixed_translation) || is_partial_code(node.fixed_rotation))
        tell(node.source, "*NODE fields TC, RC");
    for (const Spc& spc : deck_.spcs) {
      const auto& f = spc.fixed;
      if (!spc.axes.given() && (is_partial(f[0] != 0, f[1] != 0, f[2] != 0) ||
                                is_partial(f[3] != 0, f[4] != 0, f[5] != 0)))
        tell(spc.source, "*BOUNDARY_SPC");
    }
    for (const PrescribedMotion& motion : deck_.prescribed_motions)
      if (!motion.vector.given() && motion.kind != MotionTarget::RigidLocal)
        tell(motion.source, "*BOUNDARY_PRESCRIBED_MOTION");
    for (const LoadNode& load : deck_.nodal_loads)
      if (!load.axes.given()) tell(load.source, "*LOAD_NODE");
    for (const LoadRigidBody& load : deck_.rigid_loads)
      if (!load.axes.given()) tell(load.source, "*LOAD_RIGID_BODY");
    for (const LoadBody& load : deck_.body_loads)
      if (!load.axes.given()) tell(load.source, "*LOAD_BODY");
    for (const Material& material : deck_.materials) {
      const auto* rigid = std::get_if<mat::Rigid>(&material.law);
      if (rigid != nullptr && rigid->constraint_option == 1 &&
          (rigid->constraint_1 != 7 || rigid->constraint_2 != 7) &&
          (rigid->constraint_1 != 0 || rigid->constraint_2 != 0))
        tell(material.source, "*MAT_RIGID");
    }
  }

  Deck& deck_;
  const AffineMap& map_;
  DeckProblems& problems_;
};

}  // namespace

void move_deck(Deck& deck, const AffineMap& map, DeckProblems& problems) {
  DeckMove(deck, map, problems).run();
}

}  // namespace crosswalk::fe
