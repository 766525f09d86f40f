// The striking car: its front, how it moves, and where it stands. It travels along +y of W.
#pragma once

#include "common/config.h"
#include "common/curve.h"
#include "common/spatial.h"
#include "common/vehicle_front.h"

namespace crosswalk::mb {

enum class VehicleMotion {
  Constant,  ///< prescribed speed
  Braking,   ///< prescribed: constant deceleration to rest from a stated time
  Table,     ///< prescribed: speed against time
  Free       ///< a mass pushed back by the pedestrian
};

struct Vehicle {
  VehicleFront front;
  VehicleMotion motion = VehicleMotion::Constant;
  double speed = 0;           ///< m/s at t = 0
  double mass = 0;            ///< kg, free motion
  double deceleration = 0;    ///< m/s2
  double braking_start = 0;   ///< s
  double dive = 0;            ///< rad nose down while braking
  double gap = 0;             ///< m between car and body at t = 0
  double lateral_offset = 0;  ///< m, centre line of the car along x of W
  double friction = 0;        ///< body on car
  Curve speed_table;          ///< s -> m/s
};

struct VehicleState {
  double y = 0;          ///< m, foremost point
  double v = 0;          ///< m/s
  double dive = 0;       ///< rad
  double dive_rate = 0;  ///< rad/s
};

Vehicle read_vehicle(ConfigTable vehicle);
VehicleState initial_state(const Vehicle& vehicle, double y);
/// Moves the car over dt; `force_y` is the pedestrian's push on it (free motion only).
void advance_vehicle(const Vehicle& vehicle, double t, double dt, double force_y,
                     VehicleState& state);
/// Pose of the front's frame (contact_shapes.h, body `buck`), and its twist.
Pose vehicle_pose(const Vehicle& vehicle, const VehicleState& state);
Twist vehicle_twist(const Vehicle& vehicle, const VehicleState& state);

}  // namespace crosswalk::mb
