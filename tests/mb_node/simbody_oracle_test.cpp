// Free tumbling of the whole tree against Simbody: another formulation (joint coordinates,
// recursive dynamics) and another integrator (Runge-Kutta-Merson at 1e-9). Built only where Simbody
// is installed.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "mb_node/world_builder.h"
#include "tests/mb_node/mb_fixture.h"
#include "tests/mb_node/simbody_tree.h"

namespace crosswalk::mb {
namespace {

constexpr double kDuration = 0.03;  // s

std::array<double, 3> plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Erect pedestrian, all joint angles zero, so that all body frames are parallel.
MbModel erect() {
  return build_model(load_config("walking_40", RunMode::Multibody,
                                 "[posture]\narms = \"hanging\"\nright_hip_flexion_deg = 0\n"
                                 "right_knee_flexion_deg = 0\nleft_hip_flexion_deg = 0\n"
                                 "left_knee_flexion_deg = 0\n[vehicle]\nspeed_km_h = 0.0\n"));
}

/// Relative rates at the start, rad/s (m/s for a slider), reproducible and all different.
Vec3 start_rate(int segment) {
  const double i = segment;
  return 4.0 * Vec3(std::sin(1.7 * i), std::cos(2.3 * i), std::sin(0.9 * i + 1));
}

/// The part of the rate that the joint allows.
Vec3 allowed(JointType type, const Vec3& rate) {
  switch (type) {
    case JointType::Ball:
      return rate;
    case JointType::HingeX:
      return {rate.x(), 0, 0};
    case JointType::HingeY:
      return {0, rate.y(), 0};
    case JointType::HingeZ:
      return {0, 0, rate.z()};
    case JointType::UniversalXY:
      return {rate.x(), rate.y(), 0};
    default:
      return Vec3::Zero();
  }
}

const Twist kPelvis{{0, 8, 1}, {3, -2, 4}};

std::vector<Vec3> by_engine(double dt) {
  MbModel model = erect();
  const auto& segments = model.config.body.segments;
  OdeWorld world = build_world(model, std::vector<Inertia>(segments.size()));
  std::vector<Twist> V(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    if (s.parent < 0) {
      V[i] = kPelvis;
    } else {
      const Vec3 p_C = model.X_WB0[i].p, joint = p_C + (s.joint_centre - s.com);
      V[i].w = V[s.parent].w + allowed(s.joint, start_rate(static_cast<int>(i)));
      V[i].v = V[s.parent].shifted(joint - model.X_WB0[s.parent].p).v + V[i].w.cross(p_C - joint);
    }
    world.set_twist(static_cast<int>(i), V[i]);
  }
  const int steps = static_cast<int>(std::lround(kDuration / dt));
  for (int k = 0; k < steps; ++k) world.step(dt);
  std::vector<Vec3> positions;
  for (int i = 0; i < world.body_count(); ++i) positions.push_back(world.position(i));
  return positions;
}

oracle::Joint oracle_joint(JointType type) {
  switch (type) {
    case JointType::Free:
      return oracle::Joint::Free;
    case JointType::Ball:
      return oracle::Joint::Ball;
    case JointType::HingeX:
      return oracle::Joint::PinX;
    case JointType::HingeY:
      return oracle::Joint::PinY;
    case JointType::HingeZ:
      return oracle::Joint::PinZ;
    case JointType::UniversalXY:
      return oracle::Joint::UniversalXY;
    case JointType::SliderY:
      return oracle::Joint::SliderY;
  }
  return oracle::Joint::Free;
}

std::vector<Vec3> by_simbody() {
  const MbModel model = erect();
  std::vector<oracle::Body> bodies;
  for (std::size_t i = 0; i < model.X_WB0.size(); ++i) {
    const Segment& s = model.config.body.segments[i];
    const Vec3 com = model.X_WB0[i].p;
    const bool is_root = s.parent < 0;
    bodies.push_back(
        {.parent = s.parent,
         .joint = oracle_joint(s.joint),
         .mass = s.mass,
         .moments = plain(s.inertia.diagonal()),
         .com = plain(com),
         .joint_centre = plain(com + s.joint_centre - s.com),
         .rate = plain(is_root ? kPelvis.w : allowed(s.joint, start_rate(static_cast<int>(i)))),
         .velocity = plain(kPelvis.v)});
  }
  std::vector<Vec3> positions;
  for (const auto& p : oracle::free_flight(bodies, kDuration)) {
    positions.emplace_back(p[0], p[1], p[2]);
  }
  return positions;
}

TEST(SimbodyOracle, TumblingTreeAgreesAndConvergesAtFirstOrder) {
  const std::vector<Vec3> reference = by_simbody();
  const std::vector<Vec3> coarse = by_engine(2e-5), fine = by_engine(1e-5);
  ASSERT_EQ(reference.size(), fine.size());
  double worst_coarse = 0, worst_fine = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    worst_coarse = std::max(worst_coarse, (coarse[i] - reference[i]).norm());
    worst_fine = std::max(worst_fine, (fine[i] - reference[i]).norm());
  }
  const int head = erect().config.body.find_segment("head");
  EXPECT_LT((fine[head] - reference[head]).norm(), 2e-5);
  EXPECT_LT(worst_fine, 2e-3);  // free-spinning thumbs
  EXPECT_NEAR(worst_coarse / worst_fine, 2, 0.2);
}

}  // namespace
}  // namespace crosswalk::mb
