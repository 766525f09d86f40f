#include "mb_node/dynamics.h"

#include <algorithm>
#include <cmath>

#include "common/units.h"

namespace crosswalk::mb {
namespace {

constexpr double kRateMin = -3, kRateMax = 6;  // m/s: range of the rate term [E]
constexpr double kCarSlipSpeed = 0.1;          // m/s: width of the friction's sign change [E]
constexpr double kGroundSlipSpeed = 0.05;      // m/s [E]
constexpr double kGroundDampingFade = 2e-3;    // m: damping fades in over this depth [E]
constexpr double kContactThreshold = 10;       // N: first contact of car and pedestrian [E]
constexpr double kKneeWeakening = 0.65, kKneeWeakest = 0.35;  // ligaments of a flexed knee [E]

std::uint64_t mixed(std::uint64_t hash, int a, int b) {
  hash ^= static_cast<std::uint64_t>(a * 4099 + b + 1);
  return hash * 1099511628211ULL;
}

}  // namespace

Dynamics::Dynamics(const MbModel& model, OdeWorld& world) : model_(model), world_(world) {
  const std::size_t n = model.config.body.segments.size();
  now_ = {std::vector<Mat3>(n), std::vector<Vec3>(n), std::vector<Twist>(n)};
  motions_.resize(n);
  loads_ = {std::vector<Wrench>(n), std::vector<Wrench>(n), std::vector<Wrench>(n)};
  report_.car_component.assign(model.components(), Vec3::Zero());
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
  world_.set_gravity(is_held ? Vec3::Zero() : model_.config.multibody.gravity);
  for (auto* loads : {&loads_.joint, &loads_.contact, &loads_.interface}) {
    std::fill(loads->begin(), loads->end(), Wrench{});
  }
  restrain_joints(state);
  bushings_and_ties();
  touch_car(state);
  if (!is_held) touch_ground();
  if (model_.config.multibody.self_contact) touch_self(state);
  double push_on_car = -report_.car_total.y();
  for (const ExternalLoad& e : external) {
    if (e.segment == kCar) {
      push_on_car += e.load.f.y();
      state.energy.car_interface_work += e.load.power(vehicle_twist(state.vehicle)) * dt;
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
  state.energy.car_work += car_power_ * dt;
  advance_vehicle(model_.config.vehicle, state.time, dt, push_on_car, state.vehicle);
  state.contact_set = report_.contact_set;
  state.time += dt;
  ++state.substeps;
  if (state.first_contact_time < 0 && report_.car_total.norm() >= kContactThreshold) {
    state.first_contact_time = state.time;
  }
}

// ---- restraints

void Dynamics::restrain_joints(MbState& state) {
  const auto& segments = model_.config.body.segments;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].parent < 0) continue;
    const int p = segments[i].parent;
    motions_[i] = joint_motion(segments[i].joint, segments[i].restraint.coordinates, now_.R[p],
                               now_.R[i], now_.V[i].w - now_.V[p].w);
  }
  for (int i = 0; i < static_cast<int>(segments.size()); ++i) {
    const Segment& segment = segments[i];
    if (segment.parent < 0) continue;
    if (segment.joint == JointType::SliderY) {
      const Curve& shear = segment.restraint.shear;
      if (shear.empty()) continue;
      const Vec3 axis = now_.R[segment.parent].col(1);
      const Segment& parent = model_.config.body.segments[segment.parent];
      const Vec3 home =
          now_.p[segment.parent] + now_.R[segment.parent] * (segment.joint_centre - parent.com);
      const Vec3 joint = now_.p[i] + now_.R[i] * (segment.joint_centre - segment.com);
      const double s = (joint - home).dot(axis);
      const Vec3 v = now_.V[i].v + now_.V[i].w.cross(joint - now_.p[i]) - now_.V[segment.parent].v -
                     now_.V[segment.parent].w.cross(joint - now_.p[segment.parent]);
      const double force = -std::copysign(shear.value(std::abs(s)), s) -
                           segment.restraint.shear_damping * v.dot(axis);
      add(loads_.joint, i, force * axis, joint);
      add(loads_.joint, segment.parent, -force * axis, joint);
      continue;
    }
    if (model_.bone_of[i] >= 0) {
      restrain_bone(i, state);
      continue;
    }
    Vec3 moments = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      if (motions_[i].dual.col(k).isZero(0)) continue;
      const CoordinateLaw& law = segment.restraint.angle[k];
      CoordinateInput input;
      input.initial = model_.initial[i].angle[k];
      if (law.passive != PassiveMoment::None) {
        input.passive =
            law.passive_factor * (passive_moment(i, law.passive) - model_.initial[i].passive);
      }
      if (!law.ligament.moment.empty()) {
        input.ligament_factor = std::max(
            kKneeWeakest, 1 - kKneeWeakening * std::abs(motions_[i].angle[0]) / (90 * kDegree));
      }
      moments[k] = restraint_moment(law, input, motions_[i].angle[k], motions_[i].rate[k],
                                    state.joints[i].coordinate[k]);
    }
    const Vec3 torque = motions_[i].dual * moments;
    loads_.joint[i].tau += torque;
    loads_.joint[segment.parent].tau -= torque;
  }
}

// Generalised moment about alpha (hip extension, knee flexion, plantarflexion positive).
double Dynamics::passive_moment(int segment, PassiveMoment kind) const {
  const MbModel::PassiveLinks& leg = model_.passive[segment];
  const auto angle = [&](int child) { return child >= 0 ? motions_[child].angle[0] : 0.0; };
  const double hip = -angle(leg.hip), knee = angle(leg.knee), ankle = -angle(leg.ankle);
  switch (kind) {
    case PassiveMoment::Hip:
      return -passive_hip(hip, knee);
    case PassiveMoment::Knee:
      return passive_knee(hip, knee, ankle);
    case PassiveMoment::Ankle:
      return -passive_ankle(knee, ankle);
    case PassiveMoment::None:
      break;
  }
  return 0;
}

void Dynamics::restrain_bone(int i, MbState& state) {
  const Segment& segment = model_.config.body.segments[i];
  const int bone = model_.bone_of[i];
  const bool may_break = model_.config.multibody.fracture && state.bone_broken[bone] == 0;
  const Vec3 moments = bone_moment(segment.restraint.bone, motions_[i].angle, motions_[i].rate,
                                   may_break, state.joints[i].bone);
  if (may_break && state.joints[i].bone.is_broken) state.bone_broken[bone] = 1;
  const Vec3 torque = motions_[i].dual * moments;
  loads_.joint[i].tau += torque;
  loads_.joint[segment.parent].tau -= torque;
}

void Dynamics::bushings_and_ties() {
  const auto& bushings = model_.config.body.bushings;
  for (std::size_t k = 0; k < bushings.size(); ++k) {
    const Bushing& b = bushings[k];
    const Mat3& R = now_.R[b.base];
    const Vec3 home = now_.p[b.base] + R * model_.bushing_home[k];
    const Vec3 d = R.transpose() * (now_.p[b.segment] - home);
    const Vec3 v = R.transpose() * (now_.V[b.segment].v - now_.V[b.base].v -
                                    now_.V[b.base].w.cross(now_.p[b.segment] - now_.p[b.base]));
    Vec3 force = -b.stiffness.cwiseProduct(d) - b.damping * v;
    const double past = std::abs(d.y()) - b.stop;
    if (past > 0) force.y() -= std::copysign(b.stop_stiffness * past * past, d.y());
    add(loads_.joint, b.segment, R * force, now_.p[b.segment]);
    add(loads_.joint, b.base, -(R * force), now_.p[b.segment]);
  }
  for (const WristTie& tie : model_.ties) {
    const int a = tie.left.body, b = tie.right.body;
    const Vec3 p_a = now_.p[a] + now_.R[a] * tie.left.p_B,
               p_b = now_.p[b] + now_.R[b] * tie.right.p_B;
    const Vec3 d = p_b - p_a;
    const double length = d.norm();
    if (length <= tie.rest) continue;
    const Vec3 u = d / length;
    const Vec3 v = now_.V[b].shifted(p_b - now_.p[b]).v - now_.V[a].shifted(p_a - now_.p[a]).v;
    const double tension =
        std::max(0.0, model_.config.multibody.tie_stiffness * (length - tie.rest) +
                          model_.config.multibody.tie_damping * v.dot(u));
    add(loads_.joint, a, tension * u, p_a);
    add(loads_.joint, b, -tension * u, p_b);
  }
}

// ---- contacts

PosedEllipsoid Dynamics::posed(const SurfacePart& part) const {
  const Mat3& R = now_.R[part.segment];
  return {now_.p[part.segment] + R * part.p_B, R, part.semi_axes};
}

void Dynamics::touch_car(MbState& state) {
  report_.car_total.setZero();
  report_.head_car.setZero();
  std::fill(report_.car_component.begin(), report_.car_component.end(), Vec3::Zero());
  report_.contacts = 0;
  report_.contact_set = 14695981039346656037ULL;
  car_power_ = 0;
  const Vehicle& vehicle = model_.config.vehicle;
  const Pose X_WF = vehicle_pose(vehicle, state.vehicle);
  const Vec3 v_car = vehicle_twist(state.vehicle).v;
  const double rate = model_.config.body.contact.rate;
  for (std::size_t i = 0; i < model_.parts.size(); ++i) {
    const SurfacePart& part = model_.parts[i];
    const Vec3 centre = now_.p[part.segment] + now_.R[part.segment] * part.p_B;
    if (centre.y() - part.reach > state.vehicle.y) continue;  // ahead of the foremost point
    const PosedEllipsoid ellipsoid = posed(part);
    for (const FrontChain& chain : model_.chains) {
      const auto found = overlap_with_front(ellipsoid, vehicle.front, chain, X_WF);
      if (!found) continue;
      const Overlap& o = found->overlap;
      const int component = vehicle.front.facet_component[found->facet];
      double& deepest = state.car_deepest[i * model_.components() + component];
      deepest = std::max(deepest, o.depth);
      const ContactLaw& law = model_.car_laws[part.region * model_.components() + component];
      const Vec3 v_point = now_.V[part.segment].shifted(o.point - now_.p[part.segment]).v;
      const double approach = std::clamp((v_car - v_point).dot(o.normal), kRateMin, kRateMax);
      const double force = law.force(o.depth, deepest) * (1 + rate * approach);
      report_.contact_set = mixed(report_.contact_set, static_cast<int>(i), component);
      ++report_.contacts;
      if (force <= 0) continue;
      Vec3 total;
      friction_and_apply(part.segment, o.point, o.normal, force, v_car, vehicle.friction,
                         kCarSlipSpeed, total);
      report_.car_total += total;
      report_.car_component[component] += total;
      if (part.segment == model_.head) {
        report_.head_car += total;
        report_.head_point = o.point;
      }
      car_power_ += total.dot(v_car);
    }
  }
}

void Dynamics::touch_ground() {
  const ContactSettings& settings = model_.config.body.contact;
  report_.ground.setZero();
  for (std::size_t i = 0; i < model_.parts.size(); ++i) {
    const SurfacePart& part = model_.parts[i];
    const double z = now_.p[part.segment].z() + now_.R[part.segment].row(2).dot(part.p_B);
    if (z > part.reach) continue;
    const auto o = overlap_with_plane(posed(part), Vec3::UnitZ(), Vec3::Zero());
    if (!o) continue;
    const Vec3 v = now_.V[part.segment].shifted(o->point - now_.p[part.segment]).v;
    const double damping =
        v.z() < 0 ? settings.ground_damping * std::min(1.0, o->depth / kGroundDampingFade) : 0;
    const double force = part.ground_stiffness * o->depth - damping * v.z();
    report_.contact_set = mixed(report_.contact_set, static_cast<int>(i), -2);
    ++report_.contacts;
    Vec3 total;
    friction_and_apply(part.segment, o->point, Vec3::UnitZ(), force, Vec3::Zero(),
                       settings.friction_ground, kGroundSlipSpeed, total);
    report_.ground += total;
  }
}

void Dynamics::touch_self(MbState& state) {
  report_.self_total = 0;
  for (std::size_t k = 0; k < model_.self_pairs.size(); ++k) {
    const SelfContactPair& pair = model_.self_pairs[k];
    const SurfacePart& first = model_.parts[pair.first];
    const SurfacePart& second = model_.parts[pair.second];
    const Vec3 d = now_.p[first.segment] + now_.R[first.segment] * first.p_B -
                   now_.p[second.segment] - now_.R[second.segment] * second.p_B;
    const double reach = first.reach + second.reach - pair.initial_depth;
    if (d.squaredNorm() > reach * reach) continue;
    const auto o = overlap_with_ellipsoid(posed(first), posed(second));
    if (!o || o->depth <= pair.initial_depth) continue;
    const double depth = o->depth - pair.initial_depth;
    state.self_deepest[k] = std::max(state.self_deepest[k], depth);
    const double force = model_.self_laws[pair.law].force(depth, state.self_deepest[k]);
    report_.contact_set = mixed(report_.contact_set, -3, static_cast<int>(k));
    ++report_.contacts;
    if (force <= 0) continue;
    const Vec3 v_other = now_.V[second.segment].shifted(o->point - now_.p[second.segment]).v;
    Vec3 total;
    friction_and_apply(first.segment, o->point, o->normal, force, v_other,
                       model_.config.body.contact.friction_self, kCarSlipSpeed, total);
    add(loads_.contact, second.segment, -total, o->point);
    report_.self_total += total.norm();
  }
}

void Dynamics::friction_and_apply(int segment, const Vec3& point, const Vec3& normal, double force,
                                  const Vec3& v_other, double friction, double slip_speed,
                                  Vec3& out) {
  const Vec3 v = now_.V[segment].shifted(point - now_.p[segment]).v - v_other;
  const Vec3 slip = v - v.dot(normal) * normal;
  out = force * normal - friction * force * slip / std::max(slip.norm(), slip_speed);
  add(loads_.contact, segment, out, point);
}

void Dynamics::add(std::vector<Wrench>& loads, int segment, const Vec3& force, const Vec3& point) {
  loads[segment] += Wrench{force, (point - now_.p[segment]).cross(force)};
}

// ---- energies

double Dynamics::gravity_energy() const {
  double energy = 0;
  for (int i = 0; i < world_.body_count(); ++i) {
    energy -= world_.mass(i) * model_.config.multibody.gravity.dot(world_.position(i));
  }
  return energy;
}

double Dynamics::joint_energy(const MbState& state) const {
  const auto& segments = model_.config.body.segments;
  double energy = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    if (s.parent < 0 || s.joint == JointType::SliderY) continue;
    const JointMotion motion =
        joint_motion(s.joint, s.restraint.coordinates, now_.R[s.parent], now_.R[i], Vec3::Zero());
    if (model_.bone_of[i] >= 0) {
      energy += bone_energy(s.restraint.bone, motion.angle, state.joints[i].bone);
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      CoordinateInput input;
      input.initial = model_.initial[i].angle[k];
      energy += restraint_energy(s.restraint.angle[k], input, motion.angle[k],
                                 state.joints[i].coordinate[k]);
    }
  }
  for (std::size_t k = 0; k < model_.config.body.bushings.size(); ++k) {
    const Bushing& b = model_.config.body.bushings[k];
    const Vec3 d =
        now_.R[b.base].transpose() * (now_.p[b.segment] - now_.p[b.base]) - model_.bushing_home[k];
    const double past = std::max(0.0, std::abs(d.y()) - b.stop);
    energy += 0.5 * b.stiffness.dot(d.cwiseAbs2()) + b.stop_stiffness * past * past * past / 3;
  }
  return energy;
}

bool Dynamics::all_finite() const {
  return std::all_of(now_.p.begin(), now_.p.end(), [](const Vec3& p) { return p.allFinite(); }) &&
         std::all_of(now_.V.begin(), now_.V.end(),
                     [](const Twist& V) { return V.v.allFinite() && V.w.allFinite(); });
}

}  // namespace crosswalk::mb
