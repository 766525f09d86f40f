#include "tests/coupler/neck_on_bodies.h"

#include <algorithm>
#include <map>

#include "mb_node/mb_node.h"

namespace crosswalk::coupling {
namespace {

using mb::JointKind;

constexpr int kLayers = 12;
constexpr double kLayerHeight = 0.01, kHalfWidth = 0.02;  // m
constexpr double kTorsoBelow = 0.05;                      // m, torso centre under the first layer
constexpr double kJointStiffness = 50;                    // N m/rad of clavicles and arms
constexpr double kWallAt = 0.03, kWallStiffness = 1e5;    // m, N/m
const Vec3 kClavicle(0, 0.1, -kTorsoBelow), kArm(0, 0.18, -kTorsoBelow - 0.15);

Vec3 mirrored(const Vec3& p, int side) { return {p.x(), side * p.y(), p.z()}; }

struct Bar {
  int first, second;
  double stiffness;
};

/// One block of lines per kind of bar.
void connect(fe::Model& model, const std::vector<Bar>& bars, double damping_ratio) {
  fe::ElementTable& lines = model.mesh.table(fe::ElementKind::Line2);
  std::map<std::pair<double, long>, std::vector<int>> kinds;  // by stiffness and length in nm
  const auto length = [&](const Bar& bar) {
    return (model.mesh.position[bar.first] - model.mesh.position[bar.second]).norm();
  };
  for (const Bar& bar : bars) {
    kinds[{bar.stiffness, std::lround(1e9 * length(bar))}].push_back(lines.size());
    lines.nodes.insert(lines.nodes.end(), {bar.first, bar.second});
    lines.part.push_back(0);
    lines.id.push_back(fe::DeckId{lines.size()});
  }
  for (const auto& [kind, elements] : kinds) {
    const double k = kind.first;
    const double c = 2 * damping_ratio * std::sqrt(k * kNeckNodeMass);
    const fe::ElasticLine law{.axial_stiffness = k * length(bars[elements.front()]), .damping = c};
    model.blocks.push_back(fe::make_line_block(model.mesh, 0, elements, {.law = law}));
  }
}

int add_node(fe::Model& model, const Vec3& p, double mass) {
  model.mesh.position.push_back(p);
  model.mesh.node_id.push_back(fe::DeckId{model.mesh.node_count()});
  model.point_mass.push_back(mass);
  return model.mesh.node_count() - 1;
}

void add_block(fe::Model& model, const char* name, std::vector<int> nodes, bool is_free) {
  fe::RigidBody body;
  body.name = name;
  body.role = is_free ? fe::BodyRole::Free : fe::BodyRole::Driven;
  body.nodes = std::move(nodes);
  model.bodies.push_back(body);
}

}  // namespace

fe::Model neck_model(const NeckCase& c, double own_mass) {
  fe::Model model;
  model.mesh.parts.push_back({fe::DeckId{1}, "neck", false});
  std::vector<Bar> bars;
  const auto at = [](int layer, int corner) { return 4 * layer + corner; };
  for (int layer = 0; layer < kLayers; ++layer) {
    for (const auto& [sx, sy] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      add_node(model, {sx * kHalfWidth, sy * kHalfWidth, layer * kLayerHeight}, kNeckNodeMass);
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) bars.push_back({at(layer, i), at(layer, j), kBoneStiffness});
    if (layer == 0) continue;
    const double k = layer % 2 == 1 ? kBoneStiffness : kDiscStiffness;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if ((i - j) % 2 != 0 || i == j) bars.push_back({at(layer - 1, i), at(layer, j), k});
  }
  const int centre = add_node(model, {0, 0, -kTorsoBelow}, 1e-3);
  std::vector<int> base{centre};
  for (int i = 0; i < 4; ++i) base.push_back(at(0, i));
  add_block(model, "torso", base, own_mass > 0);
  if (own_mass > 0) {
    model.bodies[0].own = Inertia::of_point(own_mass, {0, 0, -kTorsoBelow});
    model.bodies[0].own.about_com = sphere_inertia(own_mass, 0.1);
    std::vector<double> t, f;
    for (int i = 0; i <= 400; ++i) {
      t.push_back(kPushTime * i / 400);
      f.push_back(push_at(c, t.back()));
    }
    model.nodal_forces.push_back({{centre}, Vec3::UnitX(), Curve(t, f), 1});
  }
  for (int side : {1, -1}) {
    if (!c.has_clavicles) break;
    std::vector<int> block;
    for (double dx : {-0.01, 0.01})
      block.push_back(add_node(model, mirrored(kClavicle, side) + Vec3(dx, 0, 0), 0.005));
    add_block(model, side > 0 ? "clavicle_left" : "clavicle_right", block, false);
    for (int m = 0; m < 20; ++m)
      bars.push_back({block[m % 2], at(1 + m % (kLayers - 1), side > 0 ? 2 + m % 2 : m % 2),
                      kMuscleStiffness});
  }
  const int head = add_node(model, {0, 0, kLayers * kLayerHeight + 0.05}, c.head_mass);
  for (int i = 0; i < 4; ++i) bars.push_back({at(kLayers - 1, i), head, kBoneStiffness});
  connect(model, bars, c.damping_ratio);
  model.settings.fixed_step = c.fe_step;
  model.finish();
  return model;
}

std::vector<BallJoint> ball_joints(const NeckCase& c) {
  std::vector<BallJoint> joints;
  for (int side : {1, -1}) {
    if (!c.has_clavicles) break;
    const int clavicle = side > 0 ? 1 : 2, arm = clavicle + 2;
    joints.push_back({0, clavicle, mirrored({0, 0.03, -kTorsoBelow}, side)});
    joints.push_back({clavicle, arm, mirrored({0, 0.18, -kTorsoBelow}, side)});
  }
  return joints;
}

NeckBodies::NeckBodies(const NeckCase& c) : case_(c) {
  build(std::vector<InterfaceBody>(static_cast<std::size_t>(attached())));
}

void NeckBodies::build(const std::vector<InterfaceBody>& blocks) {
  world_.emplace(mb::Stepper::Direct);
  world_->set_gravity(Vec3::Zero());
  inertia_.clear();
  const auto add = [&](double mass, const Mat3& inertia, const Vec3& p, const Inertia& block) {
    Inertia own = Inertia::of_point(mass, Vec3::Zero());
    own.about_com = inertia;
    const Inertia all = own + block;
    const int body = world_->add_body(all.mass, all.about_com, {Quat::Identity(), p + all.com});
    inertia_.push_back(all);
    const Vec3 from_torso = p + all.com - Vec3(0, 0, -kTorsoBelow);
    world_->set_twist(body, {case_.spin.cross(from_torso), case_.spin});
    return body;
  };
  const Vec3 torso(0, 0, -kTorsoBelow);
  add(case_.body_mass, sphere_inertia(case_.body_mass, 0.1), torso, blocks[0].block);
  if (!case_.has_clavicles) return;
  for (int side : {1, -1}) {
    add(kClavicleMass, sphere_inertia(kClavicleMass, 0.05), mirrored(kClavicle, side),
        blocks[side > 0 ? 1 : 2].block);
  }
  for (int side : {1, -1}) add(3.0, sphere_inertia(3.0, 0.12), mirrored(kArm, side), {});
  for (const BallJoint& joint : ball_joints(case_))
    world_->add_joint(JointKind::Ball, joint.parent, joint.child, joint.p);
}

BodyMotion NeckBodies::motion(int body) const {
  const Pose X_WC = world_->pose(body);
  const Vec3 back = -(X_WC.q * inertia_[static_cast<std::size_t>(body)].com);
  return {{X_WC.q, X_WC.p + back}, world_->twist(body).shifted(back)};
}

std::vector<InterfaceBody> NeckBodies::interface_bodies() const {
  constexpr std::array kNames = {"torso", "clavicle_left", "clavicle_right"};
  std::vector<InterfaceBody> bodies;
  for (int i = 0; i < attached(); ++i)
    bodies.push_back({kNames[static_cast<std::size_t>(i)], motion(i), {}, true});
  return bodies;
}

void NeckBodies::attach(const std::vector<InterfaceBody>& bodies) { build(bodies); }

void NeckBodies::substep(const MbGrant& grant, double h, bool is_first) {
  std::vector<Vec6> loads;
  double power = 0;
  for (int i = 0; i < attached(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    loads.push_back(grant.bias[k]);
    if (is_first) loads.back() += grant.carry[k] / h;
    power += loads.back().dot(stack(motion(i).V_WB));
    world_->add_force_at(i, loads.back().head<3>(), motion(i).X_WB.p);
    world_->add_torque(i, loads.back().tail<3>());
  }
  Vec3 push = push_at(case_, now_.time) * Vec3::UnitX();
  const double depth = motion(0).X_WB.p.x() - kWallAt;
  if (case_.has_wall) push.x() -= kWallStiffness * std::max(0.0, depth);
  world_->add_force_at(0, push, motion(0).X_WB.p);
  for (int i = 1; i < world_->body_count(); ++i) {
    const int parent = i <= 2 ? 0 : i - 2;
    const Quat q = world_->pose(i).q * world_->pose(parent).q.conjugate();
    const Vec3 moment = -kJointStiffness * log_rotation(q);
    world_->add_torque(i, moment);
    world_->add_torque(parent, -moment);
  }
  world_->step(h);
  now_.time += h;
  for (int i = 0; i < attached(); ++i)
    power += loads[static_cast<std::size_t>(i)].dot(stack(motion(i).V_WB));
  now_.work += h * power / 2;
}

MbReply NeckBodies::advance(const MbGrant& grant, RecordSink&) {
  if (grant.id.phase == Phase::Accept) return reply_;
  if (grant.id.phase == Phase::Evaluate) {
    if (grant.id.iteration == 0) {
      saved_ = now_;
      saved_->world = world_->save();
    } else {
      now_ = *saved_;
      world_->restore(now_.world);
    }
  }
  const int n = substep_count(grant.id.length_s(), case_.mb_step);
  const double h = grant.id.length_s() / n;
  reply_ = {};
  if (grant.want_mobility) {
    std::vector<mb::BodyPoint> points;
    for (int i = 0; i < attached(); ++i)
      points.push_back({i, -inertia_[static_cast<std::size_t>(i)].com});
    reply_.mobility = mb::kMobilitySafety * mb::measure_mobility(*world_, points, h, now_.time);
  }
  for (int k = 0; k < n; ++k) substep(grant, h, k == 0);
  reply_.substeps = n;
  reply_.first_contact = true;  // no car comes: time counts from the start
  reply_.energy.kinetic = world_->kinetic_energy();
  reply_.energy.interface_work = now_.work;
  for (int i = 0; i < attached(); ++i) reply_.bodies.push_back(motion(i));
  return reply_;
}

std::vector<std::byte> NeckBodies::save_state() const {
  ByteWriter out;
  const mb::WorldState world = world_->save();
  out.values(world.bodies);
  out.value(now_.time);
  out.value(now_.work);
  for (const Inertia& body : inertia_) {
    out.value(body.mass);
    out.values(body.com);
    out.values(body.about_com);
  }
  return out.take();
}

void NeckBodies::load_state(const std::vector<std::byte>& bytes) {
  ByteReader in(bytes);
  mb::WorldState world = world_->save();
  in.values(world.bodies);
  world_->restore(world);
  in.value(now_.time);
  in.value(now_.work);
  for (Inertia& body : inertia_) {
    in.value(body.mass);
    in.values(body.com);
    in.values(body.about_com);
  }
}

LatticeNeck::LatticeNeck(const NeckCase& c) : case_(c), model_(neck_model(c, 0)) {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b)
    boundary_.bodies.push_back(static_cast<int>(b));
  boundary_.attached = static_cast<int>(boundary_.bodies.size());
  scratch_.emplace(model_, 1);
}

std::vector<InterfaceBody> LatticeNeck::interface_bodies() const {
  std::vector<InterfaceBody> bodies;
  for (const fe::RigidBody& body : model_.bodies) bodies.push_back({body.name, {}, {}, true});
  return bodies;
}

std::vector<InterfaceBody> LatticeNeck::place(std::vector<InterfaceBody> bodies) {
  const Vec3 torso(0, 0, -kTorsoBelow);
  state_ = fe::initial_state(model_, {}, bodies.at(0).motion.V_WB.shifted(-torso));
  const std::vector<Inertia> blocks = fe::rebase_bodies(boundary_, bodies, model_, state_);
  for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].block = blocks[k];
  return bodies;
}

FeReply LatticeNeck::advance(const FeGrant& grant, RecordSink&) {
  if (grant.id.phase == Phase::Accept) return reply_;
  if (grant.id.phase == Phase::Evaluate) {
    if (grant.id.iteration == 0)
      saved_ = state_;
    else
      state_ = saved_;
  }
  const fe::WindowLoads window = fe::advance_window(model_, boundary_, grant, state_, *scratch_);
  reply_ = {};
  reply_.substeps = window.substeps;
  reply_.loads = window.loads;
  reply_.kinetic = state_.energies.kinetic;
  reply_.internal = state_.energies.internal;
  reply_.interface_work = state_.energies.interface_work;
  return reply_;
}

std::vector<std::byte> LatticeNeck::save_state() const {
  ByteWriter writer;
  fe::write_state(state_, writer);
  return writer.take();
}

void LatticeNeck::load_state(const std::vector<std::byte>& bytes) {
  ByteReader reader(bytes);
  fe::read_state(reader, state_);
}

Vec3 LatticeNeck::momentum() const {
  Vec3 p = Vec3::Zero();
  for (int n = 0; n < model_.mesh.node_count(); ++n)
    if (model_.body_of_node[n] < 0) p += model_.mass[n] * state_.nodes[n].velocity();
  return p;
}

Vec3 LatticeNeck::angular_momentum() const {
  Vec3 L = Vec3::Zero();
  for (int n = 0; n < model_.mesh.node_count(); ++n) {
    if (model_.body_of_node[n] >= 0) continue;
    const Vec3 v = state_.nodes[n].velocity();  // half a step before the position
    const Vec3 p = state_.nodes[n].position() - 0.5 * state_.last_dt * v;
    L += model_.mass[n] * p.cross(v);
  }
  return L;
}

WholeNeck run_whole(const NeckCase& c, double end) {
  const fe::Model model = neck_model(c, c.body_mass);
  fe::State state = fe::initial_state(model);
  fe::Scratch scratch(model, 1);
  WholeNeck result;
  const int steps = static_cast<int>(std::lround(end / c.fe_step));
  for (int i = 0; i < steps; ++i) {
    fe::advance_step(model, state, scratch, c.fe_step);
    result.energy = state.energies.kinetic + state.energies.internal;
    result.peak_energy = std::max(result.peak_energy, result.energy);
  }
  result.head = state.nodes.back().position();
  return result;
}

}  // namespace crosswalk::coupling
