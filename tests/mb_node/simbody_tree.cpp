#include "tests/mb_node/simbody_tree.h"

#include <Simbody.h>

namespace crosswalk::oracle {
namespace {

using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::Transform;
using SimTK::Vec3;

Vec3 vec(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

/// Simbody's pins turn about z and its sliders move along x of their frames.
Rotation joint_frame(Joint joint) {
  switch (joint) {
    case Joint::PinX:
      return Rotation(SimTK::Pi / 2, SimTK::YAxis);
    case Joint::PinY:
      return Rotation(-SimTK::Pi / 2, SimTK::XAxis);
    case Joint::SliderY:
      return Rotation(SimTK::Pi / 2, SimTK::ZAxis);
    default:
      return {};
  }
}

MobilizedBody joined(MobilizedBody& parent, const Body& b, const Vec3& parent_com,
                     const SimTK::Body& body) {
  const Rotation R = joint_frame(b.joint);
  const Transform X_PF(R, vec(b.joint_centre) - parent_com);
  const Transform X_BM(R, vec(b.joint_centre) - vec(b.com));
  switch (b.joint) {
    case Joint::Free:
      return MobilizedBody::Free(parent, Transform(vec(b.com)), body, Transform());
    case Joint::Ball:
      return MobilizedBody::Ball(parent, X_PF, body, X_BM);
    case Joint::UniversalXY:
      return MobilizedBody::Universal(parent, X_PF, body, X_BM);
    case Joint::SliderY:
      return MobilizedBody::Slider(parent, X_PF, body, X_BM);
    default:
      return MobilizedBody::Pin(parent, X_PF, body, X_BM);
  }
}

void set_rates(const MobilizedBody& body, const Body& b, SimTK::State& state) {
  switch (b.joint) {
    case Joint::Free:
      for (int k = 0; k < 3; ++k) {
        body.setOneU(state, k, b.rate[k]);
        body.setOneU(state, 3 + k, b.velocity[k]);
      }
      return;
    case Joint::Ball:
      for (int k = 0; k < 3; ++k) body.setOneU(state, k, b.rate[k]);
      return;
    case Joint::UniversalXY:
      for (int k = 0; k < 2; ++k) body.setOneU(state, k, b.rate[k]);
      return;
    case Joint::SliderY:
      return;
    default:
      body.setOneU(state, 0, b.rate[0] + b.rate[1] + b.rate[2]);  // only the pin's own is not zero
  }
}

}  // namespace

std::vector<std::array<double, 3>> free_flight(const std::vector<Body>& bodies, double duration) {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  std::vector<MobilizedBody> mobilized;
  for (const Body& b : bodies) {
    const SimTK::Body::Rigid body(SimTK::MassProperties(
        b.mass, Vec3(0), SimTK::Inertia(b.moments[0], b.moments[1], b.moments[2])));
    MobilizedBody parent = matter.Ground();
    Vec3 parent_com(0);
    if (b.parent >= 0) {
      parent = mobilized[b.parent];
      parent_com = vec(bodies[b.parent].com);
    }
    mobilized.push_back(joined(parent, b, parent_com, body));
  }
  SimTK::State state = system.realizeTopology();
  for (std::size_t i = 0; i < bodies.size(); ++i) set_rates(mobilized[i], bodies[i], state);
  SimTK::RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(1e-9);
  SimTK::TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  stepper.stepTo(duration);
  system.realize(integrator.getState(), SimTK::Stage::Position);
  std::vector<std::array<double, 3>> positions;
  for (const MobilizedBody& body : mobilized) {
    const Vec3 p = body.getBodyOriginLocation(integrator.getState());
    positions.push_back({p[0], p[1], p[2]});
  }
  return positions;
}

}  // namespace crosswalk::oracle
