#include "mb_node/ode_world.h"

#include <algorithm>
#include <array>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <ode/ode.h>

#include "common/error.h"

namespace crosswalk::mb {
namespace {

constexpr int kValuesPerBody = 3 + 4 + 12 + 3 + 3;
constexpr unsigned long kRandomSeed = 1;  // any fixed value: QuickStep shuffles its rows

class Library {
 public:
  Library() { dInitODE2(0); }
  ~Library() { dCloseODE(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

void use_library_in_this_thread() {
  static const Library library;
  thread_local bool is_ready = false;
  if (!is_ready) dAllocateODEDataForThread(dAllocateFlagBasicData);
  is_ready = true;
}

struct DestroyWorld {
  void operator()(dWorldID world) const { dWorldDestroy(world); }
};

Vec3 vec3(const dReal* a) { return {a[0], a[1], a[2]}; }

// ODE's getters point into the body itself; writing there is the only way to restore it bit by bit
// (the setters normalise the quaternion again).
struct Field {
  const dReal* (*get)(dBodyID);
  int size;
};
constexpr std::array<Field, 5> kStateFields = {{{dBodyGetPosition, 3},
                                                {dBodyGetQuaternion, 4},
                                                {dBodyGetRotation, 12},
                                                {dBodyGetLinearVel, 3},
                                                {dBodyGetAngularVel, 3}}};

}  // namespace

struct OdeWorld::Impl {
  std::unique_ptr<dxWorld, DestroyWorld> world;
  Stepper stepper = Stepper::Direct;
  std::vector<dBodyID> bodies;
  std::vector<double> masses;
  std::vector<Mat3> inertias;
  struct Anchored {
    int parent, child;
    Vec3 p_P, p_C;  // the anchor from both centres of mass
  };
  std::vector<Anchored> anchored;
  TreeSolver tree;
  JointSoftness softness;
  std::vector<BodyNow> now;  // scratch of the tree solver
  std::vector<Wrench> joint_loads;

  void read_bodies();
  void add_joint_loads(double dt);
};

void OdeWorld::Impl::read_bodies() {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const dReal* q = dBodyGetQuaternion(bodies[i]);
    const dReal* r = dBodyGetRotation(bodies[i]);
    BodyNow& b = now[i];
    b.p = vec3(dBodyGetPosition(bodies[i]));
    b.q = Quat(q[0], q[1], q[2], q[3]);
    b.R << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
    b.V = {vec3(dBodyGetLinearVel(bodies[i])), vec3(dBodyGetAngularVel(bodies[i]))};
  }
}

// ODE then steps bodies without joints: their forces stand in for them.
void OdeWorld::Impl::add_joint_loads(double dt) {
  read_bodies();
  dVector3 gravity;
  dWorldGetGravity(world.get(), gravity);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    now[i].load = {vec3(dBodyGetForce(bodies[i])) + masses[i] * vec3(gravity),
                   vec3(dBodyGetTorque(bodies[i]))};
    joint_loads[i] = {};
  }
  tree.add_joint_loads(dt, softness, now, joint_loads);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Wrench& F = joint_loads[i];
    dBodyAddForce(bodies[i], F.f.x(), F.f.y(), F.f.z());
    dBodyAddTorque(bodies[i], F.tau.x(), F.tau.y(), F.tau.z());
  }
}

OdeWorld::OdeWorld(Stepper stepper, int quick_iterations) : impl_(std::make_unique<Impl>()) {
  use_library_in_this_thread();
  impl_->world.reset(dWorldCreate());
  impl_->stepper = stepper;
  dWorldID world = impl_->world.get();
  dWorldSetGravity(world, 0, 0, 0);
  dWorldSetAutoDisableFlag(world, 0);
  dWorldSetDamping(world, 0, 0);
  dWorldSetQuickStepNumIterations(world, quick_iterations);
  impl_->softness = {dWorldGetERP(world), dWorldGetCFM(world)};
  dRandSetSeed(kRandomSeed);
}

OdeWorld::~OdeWorld() = default;
OdeWorld::OdeWorld(OdeWorld&&) noexcept = default;
OdeWorld& OdeWorld::operator=(OdeWorld&&) noexcept = default;

int OdeWorld::add_body(double mass, const Mat3& about_com, const Pose& X_WB) {
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(about_com);
  const Vec3 moments = principal.eigenvalues();
  CW_ASSERT(mass > 0 && moments[0] > 0);
  CW_ASSERT(moments[0] + moments[1] >= moments[2] * (1 - 1e-9));
  dBodyID body = dBodyCreate(impl_->world.get());
  dMass ode_mass;
  dMassSetParameters(&ode_mass, mass, 0, 0, 0, about_com(0, 0), about_com(1, 1), about_com(2, 2),
                     about_com(0, 1), about_com(0, 2), about_com(1, 2));
  dBodySetMass(body, &ode_mass);
  // Without the gyroscopic term the head of a tumbling pedestrian is wrong by centimetres.
  dBodySetGyroscopicMode(body, 1);
  impl_->bodies.push_back(body);
  impl_->masses.push_back(mass);
  impl_->inertias.push_back(about_com);
  impl_->tree.add_body(mass, about_com);
  impl_->now.emplace_back();
  impl_->joint_loads.emplace_back();
  const int index = body_count() - 1;
  set_pose(index, X_WB);
  return index;
}

void OdeWorld::add_joint(JointKind kind, int parent, int child, const Vec3& p_W, const Vec3& axis_1,
                         const Vec3& axis_2) {
  if (kind == JointKind::Free) return;
  dWorldID world = impl_->world.get();
  dBodyID a = parent < 0 ? nullptr : impl_->bodies[parent];
  dBodyID b = impl_->bodies[child];
  impl_->read_bodies();
  impl_->tree.add_joint(kind, parent, child, p_W, axis_1, axis_2, impl_->now);
  dJointID joint = nullptr;
  switch (kind) {
    case JointKind::Ball:
      joint = dJointCreateBall(world, nullptr);
      dJointAttach(joint, a, b);
      dJointSetBallAnchor(joint, p_W.x(), p_W.y(), p_W.z());
      break;
    case JointKind::Hinge:
      joint = dJointCreateHinge(world, nullptr);
      dJointAttach(joint, a, b);
      dJointSetHingeAnchor(joint, p_W.x(), p_W.y(), p_W.z());
      dJointSetHingeAxis(joint, axis_1.x(), axis_1.y(), axis_1.z());
      break;
    case JointKind::Universal:
      joint = dJointCreateUniversal(world, nullptr);
      dJointAttach(joint, a, b);
      dJointSetUniversalAnchor(joint, p_W.x(), p_W.y(), p_W.z());
      dJointSetUniversalAxis1(joint, axis_1.x(), axis_1.y(), axis_1.z());
      dJointSetUniversalAxis2(joint, axis_2.x(), axis_2.y(), axis_2.z());
      break;
    case JointKind::Slider:
      joint = dJointCreateSlider(world, nullptr);
      dJointAttach(joint, a, b);
      dJointSetSliderAxis(joint, axis_1.x(), axis_1.y(), axis_1.z());
      break;
    case JointKind::Free:
      break;
  }
  CW_ASSERT(impl_->stepper != Stepper::Direct || impl_->tree.is_tree());
  if (impl_->stepper == Stepper::Direct) dJointDisable(joint);
  if (kind == JointKind::Slider) return;
  const Vec3 p_P = parent < 0 ? p_W : Vec3(pose(parent).inverse() * p_W);
  impl_->anchored.push_back({parent, child, p_P, pose(child).inverse() * p_W});
}

int OdeWorld::body_count() const { return static_cast<int>(impl_->bodies.size()); }
double OdeWorld::mass(int body) const { return impl_->masses[body]; }
const Mat3& OdeWorld::inertia(int body) const { return impl_->inertias[body]; }

Pose OdeWorld::pose(int body) const {
  const dReal* q = dBodyGetQuaternion(impl_->bodies[body]);
  return {Quat(q[0], q[1], q[2], q[3]), position(body)};
}

Mat3 OdeWorld::rotation(int body) const {
  const dReal* r = dBodyGetRotation(impl_->bodies[body]);
  Mat3 R;
  R << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
  return R;
}

Vec3 OdeWorld::position(int body) const { return vec3(dBodyGetPosition(impl_->bodies[body])); }

Twist OdeWorld::twist(int body) const {
  return {vec3(dBodyGetLinearVel(impl_->bodies[body])),
          vec3(dBodyGetAngularVel(impl_->bodies[body]))};
}

void OdeWorld::set_pose(int body, const Pose& X_WB) {
  const std::array<dReal, 4> q = {X_WB.q.w(), X_WB.q.x(), X_WB.q.y(), X_WB.q.z()};
  dBodySetQuaternion(impl_->bodies[body], q.data());
  dBodySetPosition(impl_->bodies[body], X_WB.p.x(), X_WB.p.y(), X_WB.p.z());
}

void OdeWorld::set_twist(int body, const Twist& V_WB) {
  dBodySetLinearVel(impl_->bodies[body], V_WB.v.x(), V_WB.v.y(), V_WB.v.z());
  dBodySetAngularVel(impl_->bodies[body], V_WB.w.x(), V_WB.w.y(), V_WB.w.z());
}

void OdeWorld::set_gravity(const Vec3& g_W) {
  dWorldSetGravity(impl_->world.get(), g_W.x(), g_W.y(), g_W.z());
}

void OdeWorld::add_force_at(int body, const Vec3& f_W, const Vec3& p_W) {
  dBodyAddForceAtPos(impl_->bodies[body], f_W.x(), f_W.y(), f_W.z(), p_W.x(), p_W.y(), p_W.z());
}

void OdeWorld::add_torque(int body, const Vec3& tau_W) {
  dBodyAddTorque(impl_->bodies[body], tau_W.x(), tau_W.y(), tau_W.z());
}

void OdeWorld::clear_loads() {
  for (dBodyID body : impl_->bodies) {
    dBodySetForce(body, 0, 0, 0);
    dBodySetTorque(body, 0, 0, 0);
  }
}

void OdeWorld::step(double dt) {
  use_library_in_this_thread();
  if (impl_->stepper == Stepper::Direct) impl_->add_joint_loads(dt);
  const int ok = impl_->stepper == Stepper::Quick ? dWorldQuickStep(impl_->world.get(), dt)
                                                  : dWorldStep(impl_->world.get(), dt);
  if (ok == 0) throw std::bad_alloc();
}

WorldState OdeWorld::save() const {
  WorldState state;
  state.random_seed = dRandGetSeed();
  state.bodies.reserve(impl_->bodies.size() * kValuesPerBody);
  for (dBodyID body : impl_->bodies) {
    for (const Field& field : kStateFields) {
      const dReal* values = field.get(body);
      state.bodies.insert(state.bodies.end(), values, values + field.size);
    }
  }
  return state;
}

void OdeWorld::restore(const WorldState& state) {
  CW_ASSERT(state.bodies.size() == impl_->bodies.size() * kValuesPerBody);
  const double* from = state.bodies.data();
  for (dBodyID body : impl_->bodies) {
    for (const Field& field : kStateFields) {
      std::copy_n(from, field.size, const_cast<dReal*>(field.get(body)));
      from += field.size;
    }
  }
  dRandSetSeed(state.random_seed);
  clear_loads();
}

double OdeWorld::kinetic_energy() const {
  double energy = 0;
  for (int i = 0; i < body_count(); ++i) {
    const Twist V = twist(i);
    const Vec3 w_B = rotation(i).transpose() * V.w;
    energy += 0.5 * (mass(i) * V.v.squaredNorm() + w_B.dot(inertia(i) * w_B));
  }
  return energy;
}

Vec3 OdeWorld::linear_momentum() const {
  Vec3 momentum = Vec3::Zero();
  for (int i = 0; i < body_count(); ++i) momentum += mass(i) * twist(i).v;
  return momentum;
}

Vec3 OdeWorld::angular_momentum(const Vec3& about_W) const {
  Vec3 momentum = Vec3::Zero();
  for (int i = 0; i < body_count(); ++i) {
    const Twist V = twist(i);
    const Mat3 R = rotation(i);
    momentum +=
        (position(i) - about_W).cross(mass(i) * V.v) + R * (inertia(i) * (R.transpose() * V.w));
  }
  return momentum;
}

OdeWorld::JointDrift OdeWorld::joint_drift() const {
  JointDrift worst;
  for (const Impl::Anchored& joint : impl_->anchored) {
    const Vec3 on_parent = joint.parent < 0 ? joint.p_P : Vec3(pose(joint.parent) * joint.p_P);
    const double distance = (on_parent - pose(joint.child) * joint.p_C).norm();
    if (distance > worst.distance) worst = {distance, joint.child};
  }
  return worst;
}

Eigen::MatrixXd measure_mobility(OdeWorld& world, std::span<const BodyPoint> points, double dt,
                                 double time_s) {
  constexpr double kForceImpulse = 1e-3;   // N s: far above rounding, far below any motion
  constexpr double kMomentImpulse = 1e-5;  // N m s
  const int n = static_cast<int>(points.size());
  const WorldState start = world.save();
  std::vector<Vec3> arms;
  for (const BodyPoint& point : points) arms.push_back(world.rotation(point.body) * point.p_B);
  // Velocities of all points after one step, seen at the arms of the step's start.
  const auto velocities = [&] {
    Eigen::VectorXd v(6 * n);
    for (int i = 0; i < n; ++i) {
      v.segment<6>(6 * i) = stack(world.twist(points[i].body).shifted(arms[i]));
    }
    return v;
  };
  world.clear_loads();
  world.step(dt);
  const Eigen::VectorXd unloaded = velocities();
  Eigen::MatrixXd W(6 * n, 6 * n);
  for (int column = 0; column < 6 * n; ++column) {
    world.restore(start);
    const int i = column / 6;
    const int axis = column % 6;
    const double impulse = axis < 3 ? kForceImpulse : kMomentImpulse;
    const Vec3 load = Vec3::Unit(axis % 3) * (impulse / dt);
    if (axis < 3) {
      world.add_force_at(points[i].body, load, world.position(points[i].body) + arms[i]);
    } else {
      world.add_torque(points[i].body, load);
    }
    world.step(dt);
    W.col(column) = (velocities() - unloaded) / impulse;
  }
  world.restore(start);
  // Compared in units where both kinds of entry have like size: rows scaled by 1/sqrt(diagonal).
  const Eigen::VectorXd scale = W.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * W * scale.asDiagonal();
  const double asymmetry = (scaled - scaled.transpose()).cwiseAbs().maxCoeff();
  W = 0.5 * (W + W.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> principal(
      scale.asDiagonal() * W * scale.asDiagonal(), Eigen::EigenvaluesOnly);
  const double smallest = principal.eigenvalues()[0];
  if (!(asymmetry < kMobilityAsymmetry) || !(smallest > -kMobilityAsymmetry)) {
    throw NumericalError(
        time_s, fmt::format("mobility of the interface bodies: asymmetry {:.1e}, smallest scaled "
                            "eigenvalue {:.1e}",
                            asymmetry, smallest));
  }
  return W;
}

}  // namespace crosswalk::mb
