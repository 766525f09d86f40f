#include "mb_node/contact_loads.h"

#include <algorithm>
#include <cmath>

namespace crosswalk::mb {
namespace {

constexpr double kRateMin = -3, kRateMax = 6;  // m/s: range of the rate term [E]
constexpr double kCarSlipSpeed = 0.1;          // m/s: width of the friction's sign change [E]
constexpr double kGroundSlipSpeed = 0.05;      // m/s [E]
constexpr double kGroundDampingFade = 2e-3;    // m: damping fades in over this depth [E]

std::uint64_t mixed(std::uint64_t hash, int a, int b) {
  hash ^= static_cast<std::uint64_t>(a * 4099 + b + 1);
  return hash * 1099511628211ULL;
}

/// Velocity of the car's point now at `point`.
Vec3 car_velocity(const Vehicle& vehicle, const VehicleState& car, const Vec3& point) {
  return vehicle_twist(vehicle, car).shifted(point - vehicle_pose(vehicle, car).p).v;
}

}  // namespace

ContactLoads::ContactLoads(const MbModel& model) : model_(model) {
  report_.car_component.assign(model.components(), Vec3::Zero());
  for (std::size_t region = 0; region < model.config.body.regions.size(); ++region) {
    std::vector<const ContactLaw*>& laws = laws_.emplace_back();
    for (const int component : model.panels.component) {
      laws.push_back(&model.car_laws[region * model.components() + component]);
    }
  }
}

void ContactLoads::apply(const Kinematics& now, double dt, bool is_on_ground, MbState& state,
                         std::vector<Wrench>& loads) {
  is_on_ground_ = is_on_ground;
  pushes_.clear();
  report_.contacts = 0;
  report_.contact_set = 14695981039346656037ULL;
  report_.self_total = 0;
  report_.car_total.setZero();
  report_.head_car.setZero();
  report_.ground.setZero();
  report_.ground_head.setZero();
  std::fill(report_.car_component.begin(), report_.car_component.end(), Vec3::Zero());
  touch_car(now, dt, state, loads);
  if (is_on_ground) touch_ground(now, loads);
  if (model_.config.multibody.self_contact) touch_self(now, state, loads);
}

PosedEllipsoid ContactLoads::posed(const Kinematics& now, const SurfacePart& part) const {
  return {now.at(part.segment, part.p_B), now.R[part.segment], part.semi_axes};
}

Vec3 ContactLoads::velocity_of_other(const Kinematics& now, const VehicleState& car,
                                     const Push& push) const {
  if (push.other == kGroundSide) return Vec3::Zero();
  if (push.other == kCarSide) return car_velocity(model_.config.vehicle, car, push.point);
  return now.velocity(push.other, push.point);
}

void ContactLoads::add(const Kinematics& now, const Vec3& v_other, double force, double friction,
                       double slip_speed, Push push, std::vector<Wrench>& loads) {
  const Vec3 v = now.velocity(push.segment, push.point) - v_other;
  const Vec3 slip = v - v.dot(push.normal) * push.normal;
  push.friction = -friction * force * slip / std::max(slip.norm(), slip_speed);
  push.total = force * push.normal + push.friction;
  now.add_force(loads, push.segment, push.total, push.point);
  if (push.other >= 0) now.add_force(loads, push.other, -push.total, push.point);
  pushes_.push_back(push);
}

void ContactLoads::touch_car(const Kinematics& now, double dt, MbState& state,
                             std::vector<Wrench>& loads) {
  const Vehicle& vehicle = model_.config.vehicle;
  const Pose X_WF = vehicle_pose(vehicle, state.vehicle);
  const int panels = model_.panels.count();
  for (std::size_t i = 0; i < model_.parts.size(); ++i) {
    const SurfacePart& part = model_.parts[i];
    const std::span<PanelContact> contacts(&state.car_contacts[i * panels], panels);
    touches_.clear();
    overlaps_.clear();
    const bool is_near =  // not ahead of the foremost point
        now.at(part.segment, part.p_B).y() - part.reach <= state.vehicle.y;
    for (const FrontChain& chain : model_.chains) {
      if (!is_near) break;
      const auto found = overlap_with_front(posed(now, part), vehicle.front, chain, X_WF);
      if (!found) continue;
      const Overlap& o = found->overlap;
      const Vec3 closing =
          car_velocity(vehicle, state.vehicle, o.point) - now.velocity(part.segment, o.point);
      touches_.push_back({model_.panels.of_facet[found->facet], o.depth, closing.dot(o.normal)});
      overlaps_.push_back(o);
    }
    const FrontLosses lost = press_in(touches_, laws_[part.region], dt, contacts);
    state.energy.lost[MbLoss::ContactHysteresis] += lost.hysteresis + lost.left;
    for (std::size_t k = 0; k < touches_.size(); ++k) {
      push_car(now, state, static_cast<int>(i), touches_[k], overlaps_[k], loads);
    }
  }
}

void ContactLoads::push_car(const Kinematics& now, const MbState& state, int i,
                            const PanelTouch& touch, const Overlap& o, std::vector<Wrench>& loads) {
  const SurfacePart& part = model_.parts[i];
  report_.contact_set = mixed(report_.contact_set, i, touch.panel);
  ++report_.contacts;
  const PanelContact& contact = state.car_contacts[i * model_.panels.count() + touch.panel];
  const ContactLaw& law = *laws_[part.region][touch.panel];
  const double elastic = law.force(contact.pressed, contact.deepest);
  if (elastic <= 0) return;
  const double viscous =
      elastic * model_.config.body.contact.rate * std::clamp(touch.approach, kRateMin, kRateMax);
  Push push;
  push.segment = part.segment;
  push.other = kCarSide;
  push.point = o.point;
  push.normal = o.normal;
  push.law = &law;
  push.pressed = contact.pressed;
  push.deepest = contact.deepest;
  push.viscous = viscous;
  add(now, car_velocity(model_.config.vehicle, state.vehicle, o.point), elastic + viscous,
      model_.config.vehicle.friction, kCarSlipSpeed, push, loads);
  const Vec3& total = pushes_.back().total;
  report_.car_total += total;
  report_.car_component[model_.panels.component[touch.panel]] += total;
  if (part.segment == model_.head) {
    report_.head_car += total;
    report_.head_point = o.point;
  }
}

void ContactLoads::touch_ground(const Kinematics& now, std::vector<Wrench>& loads) {
  const ContactSettings& settings = model_.config.body.contact;
  for (std::size_t i = 0; i < model_.parts.size(); ++i) {
    const SurfacePart& part = model_.parts[i];
    if (now.at(part.segment, part.p_B).z() > part.reach) continue;
    const auto o = overlap_with_plane(posed(now, part), Vec3::UnitZ(), Vec3::Zero());
    if (!o) continue;
    const double falling = std::max(0.0, -now.velocity(part.segment, o->point).z());
    report_.contact_set = mixed(report_.contact_set, static_cast<int>(i), -2);
    ++report_.contacts;
    Push push;
    push.segment = part.segment;
    push.point = o->point;
    push.normal = Vec3::UnitZ();
    push.stiffness = part.ground_stiffness;
    push.pressed = o->depth;
    push.viscous = settings.ground_damping * std::min(1.0, o->depth / kGroundDampingFade) * falling;
    add(now, Vec3::Zero(), push.stiffness * push.pressed + push.viscous, settings.friction_ground,
        kGroundSlipSpeed, push, loads);
    report_.ground += pushes_.back().total;
    if (part.segment == model_.head) report_.ground_head += pushes_.back().total;
  }
}

void ContactLoads::touch_self(const Kinematics& now, MbState& state, std::vector<Wrench>& loads) {
  for (std::size_t k = 0; k < model_.self_pairs.size(); ++k) {
    const SelfContactPair& pair = model_.self_pairs[k];
    const SurfacePart& first = model_.parts[pair.first];
    const SurfacePart& second = model_.parts[pair.second];
    const Vec3 d = now.at(first.segment, first.p_B) - now.at(second.segment, second.p_B);
    const double reach = first.reach + second.reach - pair.initial_depth;
    if (d.squaredNorm() > reach * reach) continue;
    const auto o = overlap_with_ellipsoid(posed(now, first), posed(now, second));
    if (!o || o->depth <= pair.initial_depth) continue;
    const ContactLaw& law = model_.self_laws[pair.law];
    const double depth = o->depth - pair.initial_depth;
    double& deepest = state.self_deepest[k];
    if (depth > deepest) {
      state.energy.lost[MbLoss::ContactHysteresis] +=
          law.lost_energy(depth) - law.lost_energy(deepest);
      deepest = depth;
    }
    const double force = law.force(depth, deepest);
    report_.contact_set = mixed(report_.contact_set, -3, static_cast<int>(k));
    ++report_.contacts;
    if (force <= 0) continue;
    Push push;
    push.segment = first.segment;
    push.other = second.segment;
    push.point = o->point;
    push.normal = o->normal;
    push.law = &law;
    push.pressed = depth;
    push.deepest = deepest;
    add(now, now.velocity(second.segment, o->point), force,
        model_.config.body.contact.friction_self, kCarSlipSpeed, push, loads);
    report_.self_total += pushes_.back().total.norm();
  }
}

void ContactLoads::book(const Kinematics& before, const Kinematics& after,
                        const VehicleState& car_before, double dt, MbState& state) const {
  for (const Push& push : pushes_) {
    const Vec3 v_other = 0.5 * (velocity_of_other(before, car_before, push) +
                                velocity_of_other(after, state.vehicle, push));
    const Vec3 v = 0.5 * (before.velocity(push.segment, push.point) +
                          after.velocity(push.segment, push.point)) -
                   v_other;
    state.energy.lost[MbLoss::ContactViscous] -= push.viscous * push.normal.dot(v) * dt;
    state.energy.lost[MbLoss::ContactFriction] -= push.friction.dot(v) * dt;
    if (push.other == kCarSide) state.energy.car_work += push.total.dot(v_other) * dt;
  }
}

double ContactLoads::ground_energy(const Kinematics& now) const {
  double energy = 0;
  for (const SurfacePart& part : model_.parts)
    if (const auto o = overlap_with_plane(posed(now, part), Vec3::UnitZ(), Vec3::Zero()))
      energy += 0.5 * part.ground_stiffness * o->depth * o->depth;
  return energy;
}

double ContactLoads::stored_energy(const Kinematics& after, double dt, const MbState& state) const {
  double energy = is_on_ground_ ? 0 : ground_energy(after);
  for (const Push& push : pushes_) {
    const Vec3 v_other = velocity_of_other(after, state.vehicle, push);
    const Vec3 v = after.velocity(push.segment, push.point) - v_other;
    const double x = std::max(0.0, push.pressed - v.dot(push.normal) * dt);
    if (push.law == nullptr) {
      energy += 0.5 * push.stiffness * x * x;
      continue;
    }
    const double deepest = std::max(push.deepest, x);
    energy += push.law->stored_energy(x, deepest) + push.law->lost_energy(deepest) -
              push.law->lost_energy(push.deepest);
  }
  return energy;
}

}  // namespace crosswalk::mb
