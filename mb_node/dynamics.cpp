#include "mb_node/dynamics.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace crosswalk::mb {
namespace {

constexpr double kContactThreshold = 10;  // N: first contact of car and pedestrian [E]

}  // namespace

Dynamics::Dynamics(const MbModel& model, OdeWorld& world)
    : model_(model), world_(world), joints_(model), contacts_(model) {
  const std::size_t n = model.config.body.segments.size();
  now_ = {std::vector<Mat3>(n), std::vector<Vec3>(n), std::vector<Twist>(n)};
  loads_ = {std::vector<Wrench>(n), std::vector<Wrench>(n), std::vector<Wrench>(n)};
  refresh();
}

void Dynamics::refresh() {
  for (int i = 0; i < world_.body_count(); ++i) {
    now_.R[i] = world_.rotation(i);
    const Vec3 offset = now_.R[i] * model_.reference_offset[i];
    now_.p[i] = world_.position(i) + offset;
    now_.V[i] = world_.twist(i).shifted(offset);
  }
}

void Dynamics::substep(MbState& state, double dt, std::span<const ExternalLoad> external) {
  const bool is_held =
      model_.config.posture.support == Support::Harness && state.first_contact_time < 0;
  last_gravity_ = is_held ? Vec3::Zero() : model_.config.multibody.gravity;
  world_.set_gravity(last_gravity_);
  for (auto* loads : {&loads_.joint, &loads_.contact, &loads_.interface}) {
    std::fill(loads->begin(), loads->end(), Wrench{});
  }
  joints_.apply(now_, state, loads_.joint);
  contacts_.apply(now_, dt, !is_held, state, loads_.contact);
  double push_on_car = -contacts().car_total.y();
  for (const ExternalLoad& e : external) {
    if (e.segment == kCar) {
      push_on_car += e.load.f.y();
      state.energy.car_interface_work +=
          e.load.power(vehicle_twist(model_.config.vehicle, state.vehicle)) * dt;
    } else {
      loads_.interface[e.segment] += e.load;
    }
  }
  for (int i = 0; i < world_.body_count(); ++i) {
    Wrench total = loads_.joint[i];
    total += loads_.contact[i];
    total += loads_.interface[i];
    world_.add_force_at(i, total.f, now_.p[i]);
    world_.add_torque(i, total.tau);
  }
  before_ = now_;
  world_.step(dt);
  refresh();
  // Work with the mean twist of the step: exact for the engine's change of kinetic energy in
  // translation.
  for (int i = 0; i < world_.body_count(); ++i) {
    const Twist mean{0.5 * (before_.V[i].v + now_.V[i].v), 0.5 * (before_.V[i].w + now_.V[i].w)};
    state.energy.joint_work += loads_.joint[i].power(mean) * dt;
    state.energy.contact_work += loads_.contact[i].power(mean) * dt;
    state.energy.interface_work += loads_.interface[i].power(mean) * dt;
  }
  const VehicleState car_before = state.vehicle;
  advance_vehicle(model_.config.vehicle, state.time, dt, push_on_car, state.vehicle);
  joints_.book(before_, now_, dt, state);
  contacts_.book(before_, now_, car_before, dt, state);
  last_dt_ = dt;
  state.contact_set = contacts().contact_set;
  state.time += dt;
  ++state.substeps;
  if (state.first_contact_time < 0 && contacts().car_total.norm() >= kContactThreshold) {
    state.first_contact_time = state.time;
  }
}

Wrench Dynamics::joint_load(int i) const {
  CW_ASSERT(last_dt_ > 0 && model_.reference_offset[i].isZero(0));
  const Segment& segment = model_.config.body.segments[i];
  const auto spin = [&](const Kinematics& at) -> Vec3 {
    return at.R[i] * world_.inertia(i) * at.R[i].transpose() * at.V[i].w;
  };
  Wrench load;
  load.f = world_.mass(i) * ((now_.V[i].v - before_.V[i].v) / last_dt_ - last_gravity_) -
           loads_.contact[i].f - loads_.interface[i].f;
  load.tau =
      (spin(now_) - spin(before_)) / last_dt_ - loads_.contact[i].tau - loads_.interface[i].tau;
  return load.shifted(now_.R[i] * (segment.joint_centre - segment.com));
}

double Dynamics::gravity_energy() const {
  double energy = 0;
  for (int i = 0; i < world_.body_count(); ++i) {
    energy -= world_.mass(i) * model_.config.multibody.gravity.dot(world_.position(i));
  }
  return energy;
}

bool Dynamics::all_finite() const {
  return std::all_of(now_.p.begin(), now_.p.end(), [](const Vec3& p) { return p.allFinite(); }) &&
         std::all_of(now_.V.begin(), now_.V.end(),
                     [](const Twist& V) { return V.v.allFinite() && V.w.allFinite(); });
}

}  // namespace crosswalk::mb
