#include "mb_node/joint_loads.h"

#include <algorithm>
#include <cmath>

#include "common/units.h"

namespace crosswalk::mb {
namespace {

constexpr double kKneeWeakening = 0.65, kKneeWeakest = 0.35;  // ligaments of a flexed knee [E]
constexpr double kKneeFlexed = 90 * kDegree;

double ligament_factor(double flexion) {
  return std::max(kKneeWeakest, 1 - kKneeWeakening * std::abs(flexion) / kKneeFlexed);
}

double ligament_factor_slope(double flexion) {
  if (ligament_factor(flexion) <= kKneeWeakest) return 0;
  return -std::copysign(kKneeWeakening / kKneeFlexed, flexion);
}

}  // namespace

JointLoads::JointLoads(const MbModel& model)
    : model_(model), motions_(model.config.body.segments.size()) {}

void JointLoads::apply(const Kinematics& now, MbState& state, std::vector<Wrench>& loads) {
  turns_.clear();
  drags_.clear();
  const auto& segments = model_.config.body.segments;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const int p = segments[i].parent;
    if (p < 0) continue;
    motions_[i] = joint_motion(segments[i].joint, segments[i].restraint.frame, now.R[p], now.R[i],
                               now.V[i].w - now.V[p].w);
  }
  for (int i = 0; i < static_cast<int>(segments.size()); ++i) {
    if (segments[i].parent < 0) continue;
    if (segments[i].joint == JointType::SliderY) {
      restrain_shear(now, i, loads);
    } else if (model_.bone_of[i] >= 0) {
      restrain_bone(i, state, loads);
    } else {
      restrain(i, state, loads);
    }
  }
  bushings(now, loads);
  ties(now, loads);
}

void JointLoads::turn(int segment, const Vec3& moments, std::vector<Wrench>& loads) const {
  const Vec3 torque = motions_[segment].dual * moments;
  loads[segment].tau += torque;
  loads[model_.config.body.segments[segment].parent].tau -= torque;
}

void JointLoads::restrain(int i, MbState& state, std::vector<Wrench>& loads) {
  const Segment& segment = model_.config.body.segments[i];
  Turn t;
  t.segment = i;
  Vec3 moments = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (motions_[i].dual.col(k).isZero(0)) continue;
    const CoordinateLaw& law = segment.restraint.angle[k];
    CoordinateHistory& history = state.joints[i].coordinate[k];
    CoordinateInput input;
    input.initial = model_.initial[i].angle[k];
    if (law.passive != PassiveMoment::None) {
      input.passive =
          law.passive_factor * (passive_moment(i, law.passive) - model_.initial[i].passive);
    }
    if (!law.ligament.moment.empty()) {
      const double flexion = motions_[i].angle[0];
      input.ligament_factor = ligament_factor(flexion);
      t.weakening =
          -ligament_factor_slope(flexion) *
          ligament_energy(law.ligament, motions_[i].angle[k] - input.initial, history.ligament);
    }
    const RestraintMoment m =
        restraint_moment(law, input, motions_[i].angle[k], motions_[i].rate[k], history);
    moments[k] = m.total();
    t.damping[k] = m.damping;
    t.friction[k] = m.friction;
    t.passive[k] = m.passive;
    state.energy.lost[MbLoss::JointHysteresis] += m.lost;
  }
  turn(i, moments, loads);
  turns_.push_back(t);
}

// Generalised moment about alpha (hip extension, knee flexion, plantarflexion positive).
double JointLoads::passive_moment(int segment, PassiveMoment kind) const {
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

void JointLoads::restrain_bone(int i, MbState& state, std::vector<Wrench>& loads) {
  const Segment& segment = model_.config.body.segments[i];
  const int bone = model_.bone_of[i];
  const bool may_break = model_.config.multibody.fracture && state.bone_broken[bone] == 0;
  const BoneMoment m = bone_moment(segment.restraint.bone, motions_[i].angle, motions_[i].rate,
                                   may_break, state.joints[i].bone);
  if (may_break && state.joints[i].bone.is_broken) state.bone_broken[bone] = 1;
  state.energy.lost[MbLoss::JointHysteresis] += m.lost;
  turn(i, m.total(), loads);
  Turn t;
  t.segment = i;
  t.damping = m.damping;
  t.friction = m.friction;
  turns_.push_back(t);
}

JointLoads::Shear JointLoads::shear_of(const Kinematics& now, int i) const {
  const Segment& segment = model_.config.body.segments[i];
  const Segment& parent = model_.config.body.segments[segment.parent];
  const Vec3 home = now.at(segment.parent, segment.joint_centre - parent.com);
  Shear s;
  s.axis = now.R[segment.parent].col(1);
  s.joint = now.at(i, segment.joint_centre - segment.com);
  s.displacement = (s.joint - home).dot(s.axis);
  return s;
}

void JointLoads::restrain_shear(const Kinematics& now, int i, std::vector<Wrench>& loads) {
  const Segment& segment = model_.config.body.segments[i];
  const Curve& curve = segment.restraint.shear;
  if (curve.empty()) return;
  const Shear s = shear_of(now, i);
  const Vec3 v = now.velocity(i, s.joint) - now.velocity(segment.parent, s.joint);
  const double elastic = -std::copysign(curve.value(std::abs(s.displacement)), s.displacement);
  const double viscous = -segment.restraint.shear_damping * v.dot(s.axis);
  const Vec3 force = (elastic + viscous) * s.axis;
  now.add_force(loads, i, force, s.joint);
  now.add_force(loads, segment.parent, -force, s.joint);
  drags_.push_back({i, segment.parent, s.joint, viscous * s.axis});
}

void JointLoads::bushings(const Kinematics& now, std::vector<Wrench>& loads) {
  for (std::size_t k = 0; k < model_.config.body.bushings.size(); ++k) {
    const Bushing& b = model_.config.body.bushings[k];
    const Mat3& R = now.R[b.base];
    const Vec3& p = now.p[b.segment];
    const Vec3 d = R.transpose() * (p - now.at(b.base, model_.bushing_home[k]));
    const Vec3 v = now.V[b.segment].v - now.velocity(b.base, p);
    Vec3 elastic = -b.stiffness.cwiseProduct(d);
    const double past = std::abs(d.y()) - b.stop;
    if (past > 0) elastic.y() -= std::copysign(b.stop_stiffness * past * past, d.y());
    const Vec3 viscous = -b.damping * v;
    const Vec3 force = R * elastic + viscous;
    now.add_force(loads, b.segment, force, p);
    now.add_force(loads, b.base, -force, p);
    drags_.push_back({b.segment, b.base, p, viscous});
  }
}

void JointLoads::ties(const Kinematics& now, std::vector<Wrench>& loads) {
  for (const WristTie& tie : model_.ties) {
    const int a = tie.left.body, b = tie.right.body;
    const Vec3 p_a = now.at(a, tie.left.p_B), p_b = now.at(b, tie.right.p_B);
    const Vec3 d = p_b - p_a;
    const double stretch = d.norm() - tie.rest;
    if (stretch <= 0) continue;
    const Vec3 u = d.normalized();
    const Vec3 v = now.velocity(b, p_b) - now.velocity(a, p_a);
    const double elastic = model_.config.multibody.tie_stiffness * stretch;
    const double tension = std::max(0.0, elastic + model_.config.multibody.tie_damping * v.dot(u));
    now.add_force(loads, a, tension * u, p_a);
    now.add_force(loads, b, -tension * u, p_b);
    // On one line with p_a: the moment about it is the same from there.
    drags_.push_back({a, b, p_a, (tension - elastic) * u});
  }
}

void JointLoads::book(const Kinematics& before, const Kinematics& after, double dt,
                      MbState& state) const {
  LossBooks& lost = state.energy.lost;
  for (const Turn& t : turns_) {
    const int p = model_.config.body.segments[t.segment].parent;
    const Vec3 w =
        0.5 * (before.V[t.segment].w + after.V[t.segment].w - before.V[p].w - after.V[p].w);
    const Vec3 rate = motions_[t.segment].dual.transpose() * w;
    lost[MbLoss::JointDamping] -= t.damping.dot(rate) * dt;
    lost[MbLoss::JointFriction] -= t.friction.dot(rate) * dt;
    lost[MbLoss::JointPassive] -= t.passive.dot(rate) * dt;
    lost[MbLoss::JointPassive] += t.weakening * rate[0] * dt;
  }
  for (const Drag& d : drags_) {
    const Vec3 v = 0.5 * (before.velocity(d.first, d.point) + after.velocity(d.first, d.point) -
                          before.velocity(d.second, d.point) - after.velocity(d.second, d.point));
    lost[MbLoss::JointDamping] -= d.force.dot(v) * dt;
  }
}

double JointLoads::stored_energy(const Kinematics& now, const MbState& state) const {
  const auto& segments = model_.config.body.segments;
  double energy = 0;
  for (int i = 0; i < static_cast<int>(segments.size()); ++i) {
    const Segment& s = segments[i];
    if (s.parent < 0) continue;
    if (s.joint == JointType::SliderY) {
      const Curve& shear = s.restraint.shear;
      if (!shear.empty()) energy += shear.integral(std::abs(shear_of(now, i).displacement));
      continue;
    }
    const JointMotion motion =
        joint_motion(s.joint, s.restraint.frame, now.R[s.parent], now.R[i], Vec3::Zero());
    if (model_.bone_of[i] >= 0) {
      energy += bone_energy(s.restraint.bone, motion.angle, state.joints[i].bone);
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const CoordinateLaw& law = s.restraint.angle[k];
      CoordinateInput input;
      input.initial = model_.initial[i].angle[k];
      if (!law.ligament.moment.empty()) input.ligament_factor = ligament_factor(motion.angle[0]);
      energy += restraint_energy(law, input, motion.angle[k], state.joints[i].coordinate[k]);
    }
  }
  for (std::size_t k = 0; k < model_.config.body.bushings.size(); ++k) {
    const Bushing& b = model_.config.body.bushings[k];
    const Vec3 d =
        now.R[b.base].transpose() * (now.p[b.segment] - now.p[b.base]) - model_.bushing_home[k];
    const double past = std::max(0.0, std::abs(d.y()) - b.stop);
    energy += 0.5 * b.stiffness.dot(d.cwiseAbs2()) + b.stop_stiffness * past * past * past / 3;
  }
  for (const WristTie& tie : model_.ties) {
    const double length =
        (now.at(tie.right.body, tie.right.p_B) - now.at(tie.left.body, tie.left.p_B)).norm();
    const double stretch = std::max(0.0, length - tie.rest);
    energy += 0.5 * model_.config.multibody.tie_stiffness * stretch * stretch;
  }
  return energy;
}

}  // namespace crosswalk::mb
