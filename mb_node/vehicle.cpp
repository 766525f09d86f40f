#include "mb_node/vehicle.h"

#include <algorithm>

namespace crosswalk::mb {
namespace {

constexpr double kDivePivot = 2.6;  // m behind the foremost point: about the rear axle [E]
constexpr double kDiveTime = 0.15;  // s until the full dive [E]

double speed_at(const Vehicle& vehicle, double t) {
  switch (vehicle.motion) {
    case VehicleMotion::Braking:
      return std::max(
          0.0, vehicle.speed - vehicle.deceleration * std::max(0.0, t - vehicle.braking_start));
    case VehicleMotion::Table:
      return vehicle.speed_table.value(t);
    case VehicleMotion::Constant:
    case VehicleMotion::Free:
      break;
  }
  return vehicle.speed;
}

double dive_at(const Vehicle& vehicle, double t) {
  if (vehicle.motion != VehicleMotion::Braking) return 0;
  return vehicle.dive * std::clamp((t - vehicle.braking_start) / kDiveTime, 0.0, 1.0);
}

}  // namespace

Vehicle read_vehicle(ConfigTable table) {
  Vehicle v;
  v.front = read_vehicle_front(table);
  const std::string motion = table.choice_or("motion", {"constant", "braking", "table", "free"},
                                             "constant", "how the car moves");
  v.speed = table.quantity("speed", Dimension::Speed, {0, 60}, "speed at t = 0");
  v.gap = table.quantity_or("gap", Dimension::Length, {0, 1}, 2e-3,
                            "gap between car and pedestrian at t = 0");
  v.lateral_offset = table.quantity_or("lateral_offset", Dimension::Length, {-1, 1}, 0,
                                       "centre line of the car in the pedestrian's x");
  v.friction = table.quantity_or("friction", Dimension::None, {0, 2}, 0.3,
                                 "friction of body and car [yu2020, 2.2.3]");
  v.mass = table.quantity_or("mass", Dimension::Mass, kPositive, 1300, "mass of a free car [E]");
  v.deceleration =
      table.quantity_or("deceleration", Dimension::Acceleration, kNonNegative, 6.9, "braking [E]");
  v.braking_start = table.quantity_or("braking_start", Dimension::Time, kNonNegative, 0.1,
                                      "start of braking [E]");
  v.dive = table.quantity_or("dive", Dimension::Angle, {0, 0.1}, 0, "nose down while braking");
  if (motion == "table") {
    v.motion = VehicleMotion::Table;
    v.speed_table = table.curve("speed_table", Dimension::Time, Dimension::Speed,
                                Curve::Outside::Hold, "speed against time");
    v.speed = v.speed_table.value(0);
  } else {
    v.motion = motion == "braking" ? VehicleMotion::Braking
               : motion == "free"  ? VehicleMotion::Free
                                   : VehicleMotion::Constant;
  }
  return v;
}

VehicleState initial_state(const Vehicle& vehicle, double y) {
  return {y, speed_at(vehicle, 0), dive_at(vehicle, 0)};
}

void advance_vehicle(const Vehicle& vehicle, double t, double dt, double force_y,
                     VehicleState& state) {
  const double before = state.v;
  if (vehicle.motion == VehicleMotion::Free) {
    state.v += force_y / vehicle.mass * dt;
    state.y += state.v * dt;  // semi-implicit, as the pedestrian
    return;
  }
  state.v = speed_at(vehicle, t + dt);
  state.y += 0.5 * (before + state.v) * dt;
  const double dive = dive_at(vehicle, t + dt);
  state.dive_rate = (dive - state.dive) / dt;
  state.dive = dive;
}

Pose vehicle_pose(const Vehicle& vehicle, const VehicleState& state) {
  const Pose upright{Quat::Identity(), {vehicle.lateral_offset, state.y, 0}};
  if (state.dive == 0) return upright;
  const Pose pivot{Quat::Identity(), {0, -kDivePivot, 0}};
  return upright * pivot * Pose{exp_rotation({-state.dive, 0, 0}), Vec3::Zero()} * pivot.inverse();
}

Twist vehicle_twist(const Vehicle& vehicle, const VehicleState& state) {
  const Vec3 pivot(vehicle.lateral_offset, state.y - kDivePivot, 0);
  const Twist about_pivot{Vec3(0, state.v, 0), Vec3(-state.dive_rate, 0, 0)};
  return about_pivot.shifted(vehicle_pose(vehicle, state).p - pivot);
}

}  // namespace crosswalk::mb
