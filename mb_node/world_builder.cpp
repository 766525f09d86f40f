#include "mb_node/world_builder.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk::mb {
namespace {

constexpr double kTieMinLength = 0.03;  // m, rest length of the wrist tie [E]
constexpr double kFarAway = 50;         // m: search range for the car's start

JointKind engine_joint(JointType type) {
  switch (type) {
    case JointType::Free:
      return JointKind::Free;
    case JointType::Ball:
      return JointKind::Ball;
    case JointType::UniversalXY:
      return JointKind::Universal;
    case JointType::SliderY:
      return JointKind::Slider;
    case JointType::HingeX:
    case JointType::HingeY:
    case JointType::HingeZ:
      return JointKind::Hinge;
  }
  return JointKind::Free;
}

Vec3 first_axis(JointType type) {
  switch (type) {
    case JointType::HingeY:
    case JointType::SliderY:
      return Vec3::UnitY();
    case JointType::HingeZ:
      return Vec3::UnitZ();
    default:
      return Vec3::UnitX();
  }
}

JointMotion start_motion(const MbModel& model, int i) {
  const Segment& s = model.config.body.segments[i];
  if (s.parent < 0) return {};
  return joint_motion(s.joint, s.restraint.frame, model.X_WB0[s.parent].R(), model.X_WB0[i].R(),
                      Vec3::Zero());
}

void set_restraints(MbModel& model) {
  auto& segments = model.config.body.segments;
  const int n = static_cast<int>(segments.size());
  model.initial.resize(n);
  model.bone_of.assign(n, -1);
  model.passive.resize(n);
  std::map<std::string, int> bones;
  for (int i = 0; i < n; ++i) {
    JointRestraint& r = segments[i].restraint;
    model.initial[i].angle = start_motion(model, i).angle;
    if (r.bone.bending > 0) {
      model.bone_of[i] = bones.emplace(r.bone.bone, static_cast<int>(bones.size())).first->second;
    }
    for (int k = 0; k < 3; ++k) {
      CoordinateLaw& law = r.angle[k];
      // The body is in equilibrium with its own joints: the start lies inside the free range.
      law.min = std::min(law.min, model.initial[i].angle[k]);
      law.max = std::max(law.max, model.initial[i].angle[k]);
      if (!law.ligament.moment.empty() && !model.config.multibody.knee_failure) {
        law.ligament = without_failure(law.ligament);
      }
    }
  }
  model.bone_count = static_cast<int>(bones.size());
}

void set_passive_moments(MbModel& model) {
  const BodyDescription& body = model.config.body;
  for (const std::string side : {"_l", "_r"}) {
    const MbModel::PassiveLinks leg{body.find_segment("femur_1" + side),
                                    body.find_segment("tibia_1" + side),
                                    body.find_segment("talus" + side)};
    if (leg.hip < 0 || leg.knee < 0 || leg.ankle < 0) continue;
    const double hip = -model.initial[leg.hip].angle[0], knee = model.initial[leg.knee].angle[0];
    const double ankle = -model.initial[leg.ankle].angle[0];
    for (const int i : {leg.hip, leg.knee, leg.ankle}) model.passive[i] = leg;
    model.initial[leg.hip].passive = -passive_hip(hip, knee);
    model.initial[leg.knee].passive = passive_knee(hip, knee, ankle);
    model.initial[leg.ankle].passive = -passive_ankle(knee, ankle);
  }
}

void set_surfaces(MbModel& model) {
  const BodyDescription& body = model.config.body;
  for (const SurfaceEllipsoid& e : body.ellipsoids) {
    SurfacePart part{e.segment,
                     e.region,
                     e.centre - body.segments[e.segment].com,
                     e.semi_axes,
                     e.semi_axes.maxCoeff(),
                     body.contact.ground_body};
    if (body.regions[e.region].name == "foot") part.ground_stiffness = body.contact.ground_foot;
    model.parts.push_back(part);
  }
  const VehicleFront& front = model.config.vehicle.front;
  model.chains = convex_chains(front);
  model.panels = front_panels(front, model.chains);
  for (const Region& region : body.regions) {
    for (int c = 0; c < model.components(); ++c) {
      const auto facet = std::find(front.facet_component.begin(), front.facet_component.end(), c) -
                         front.facet_component.begin();
      model.car_laws.emplace_back(region.flesh, front.facets[facet].structure);
    }
  }
}

PosedEllipsoid start_ellipsoid(const MbModel& model, const SurfacePart& part) {
  const Pose& X_WB = model.X_WB0[part.segment];
  return {X_WB * part.p_B, X_WB.R(), part.semi_axes};
}

void set_self_contacts(MbModel& model) {
  std::map<std::pair<int, int>, int> laws;
  const auto& regions = model.config.body.regions;
  for (const auto& [a, b] : model.config.body.self_contacts) {
    const SurfacePart& first = model.parts[a];
    const SurfacePart& second = model.parts[b];
    const auto key = std::pair(first.region, second.region);
    const auto [law, is_new] = laws.emplace(key, static_cast<int>(model.self_laws.size()));
    if (is_new) {
      model.self_laws.emplace_back(regions[first.region].flesh, regions[second.region].flesh);
    }
    SelfContactPair pair{a, b, law->second, 0};
    const auto overlap =
        overlap_with_ellipsoid(start_ellipsoid(model, first), start_ellipsoid(model, second));
    if (overlap) pair.initial_depth = overlap->depth;
    model.self_pairs.push_back(pair);
  }
}

void set_bushings_and_ties(MbModel& model) {
  const BodyDescription& body = model.config.body;
  for (const Bushing& b : body.bushings) {
    model.bushing_home.push_back(model.X_WB0[b.base].inverse() * model.X_WB0[b.segment].p);
  }
  if (model.config.posture.arms != Arms::Bound) return;
  const auto end_of = [&](const std::string& side) -> BodyPoint {
    const int hand = body.find_segment("hand" + side);
    if (hand >= 0) {
      return {hand, body.segments[hand].joint_centre - body.segments[hand].com};
    }
    const int stump = body.find_segment("forearm_prox" + side);
    if (stump < 0) return {};
    return {stump, body.segments[stump].com - body.segments[stump].joint_centre};
  };
  WristTie tie{end_of("_l"), end_of("_r"), 0};
  if (tie.left.body < 0 || tie.right.body < 0) return;
  const Vec3 d =
      model.X_WB0[tie.right.body] * tie.right.p_B - model.X_WB0[tie.left.body] * tie.left.p_B;
  tie.rest = std::max(kTieMinLength, d.norm());
  model.ties.push_back(tie);
}

bool touches(const MbModel& model, double y) {
  const Pose X_WF = vehicle_pose(model.config.vehicle, initial_state(model.config.vehicle, y));
  for (const SurfacePart& part : model.parts) {
    const PosedEllipsoid e = start_ellipsoid(model, part);
    for (const FrontChain& chain : model.chains) {
      if (overlap_with_front(e, model.config.vehicle.front, chain, X_WF)) return true;
    }
  }
  return false;
}

}  // namespace

MbModel build_model(MbConfig config) {
  MbModel model;
  model.config = std::move(config);
  const Posture posture = solve_posture(model.config.body, model.config.posture);
  model.X_WB0 = posture.X_WB;
  model.reference_offset.assign(posture.X_WB.size(), Vec3::Zero());
  model.head = model.config.body.find_segment("head");
  set_restraints(model);
  set_passive_moments(model);
  set_surfaces(model);
  set_self_contacts(model);
  set_bushings_and_ties(model);
  return model;
}

MbState initial_state(const MbModel& model) {
  MbState state;
  const std::size_t n = model.config.body.segments.size();
  // The car comes from far away along +y: the first touch, less the gap.
  double clear = -kFarAway, touching = -kFarAway;
  for (double y = -3; y < 3; y += 0.02) {
    if (touches(model, y)) {
      touching = y;
      break;
    }
    clear = y;
  }
  if (touching == -kFarAway) {
    throw UserError(
        {{}, "vehicle.lateral_offset", "a car that meets the pedestrian", "a miss", ""});
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (clear + touching);
    (touches(model, middle) ? touching : clear) = middle;
  }
  state.vehicle = initial_state(model.config.vehicle, clear - model.config.vehicle.gap);
  state.joints.resize(n);
  state.car_contacts.resize(model.parts.size() * model.panels.count());
  state.self_deepest.assign(model.self_pairs.size(), 0);
  state.bone_broken.assign(model.bone_count, 0);
  return state;
}

OdeWorld build_world(MbModel& model, const std::vector<Inertia>& blocks) {
  const MbConfig& config = model.config;
  const auto& segments = config.body.segments;
  OdeWorld world(config.multibody.stepper, config.multibody.quick_iterations);
  const Vec3 walking = Vec3(std::cos(config.posture.heading), std::sin(config.posture.heading), 0) *
                       config.posture.walking_speed;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Pose& X_WB = model.X_WB0[i];
    Inertia own{segments[i].mass, Vec3::Zero(), segments[i].inertia};
    const Inertia& block_W = blocks[i];
    if (block_W.mass > 0) {
      const bool is_replaced = segments[i].name == "torso_up" && config.multibody.replaces_t1_t3;
      if (is_replaced) {
        const double left = 1 - block_W.mass / own.mass;
        CW_ASSERT(left > 0);
        own.mass *= left;
        own.about_com *= left;
      }
      own = own + block_W.in({X_WB.q.conjugate(), Vec3::Zero()});
    }
    model.reference_offset[i] = -own.com;
    const int body =
        world.add_body(own.mass, own.about_com, X_WB * Pose{Quat::Identity(), own.com});
    const Vec3& spin = config.posture.spin;
    world.set_twist(body, {walking + spin.cross(world.position(body) - model.X_WB0[0].p), spin});
  }
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    if (s.parent < 0) continue;
    const Mat3 R_WP = model.X_WB0[s.parent].R(), R_WC = model.X_WB0[i].R();
    const Vec3 joint = model.X_WB0[i] * Vec3(s.joint_centre - s.com);
    world.add_joint(engine_joint(s.joint), s.parent, static_cast<int>(i), joint,
                    R_WP * first_axis(s.joint), R_WC * Vec3::UnitY());
  }
  return world;
}

}  // namespace crosswalk::mb
