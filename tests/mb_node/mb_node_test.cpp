// The multibody participant: attachment, impulses, windows that repeat, checkpoints, records.
#include "mb_node/mb_node.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/units.h"
#include "tests/mb_node/mb_fixture.h"

namespace crosswalk::mb {
namespace {

constexpr int kTorso = 0, kClavicleLeft = 1;  // order of the interfaces in the scenario

std::vector<InterfaceBody> with_blocks(const MbNode& node) {
  std::vector<InterfaceBody> bodies = node.interface_bodies();
  bodies[kTorso].block = {0.3, Vec3(0.01, 0, 0.11), Vec3(4e-4, 5e-4, 6e-4).asDiagonal()};
  bodies[kClavicleLeft].block = {0.02, Vec3(-0.03, 0.02, 0.01),
                                 Vec3(1e-5, 2e-5, 2e-5).asDiagonal()};
  return bodies;
}

TEST(MbNode, InterfaceBodiesStandAtTheirCentresOfMass) {
  const MbNode node(load_config("v2370", RunMode::Coupled));
  const std::vector<InterfaceBody> bodies = node.interface_bodies();
  ASSERT_EQ(bodies.size(), 8u);
  EXPECT_EQ(bodies[0].name, "torso_up");
  EXPECT_TRUE(bodies[2].is_attached);
  EXPECT_EQ(bodies[3].name, "buck");
  EXPECT_FALSE(bodies[3].is_attached);
  const int torso = node.model().config.body.find_segment("torso_up");
  EXPECT_LT((bodies[0].motion.X_WB.p - node.world().position(torso)).norm(), 1e-15);
  EXPECT_NEAR(bodies[3].motion.V_WB.v.y(), 40 / 3.6, 1e-12);
  EXPECT_EQ(node.world().body_count(), 49);
}

TEST(MbNode, AttachAddsTheBlocksExactlyAndKeepsTheReferencePoints) {
  MbNode node(load_config("v2370", RunMode::Coupled, "[multibody]\nreplaces_t1_t3 = false\n"));
  const std::vector<InterfaceBody> before = node.interface_bodies();
  const int clavicle = node.model().config.body.find_segment("clavicle_l");
  const Inertia own{node.world().mass(clavicle), node.world().position(clavicle),
                    node.world().rotation(clavicle) * node.world().inertia(clavicle) *
                        node.world().rotation(clavicle).transpose()};
  const std::vector<InterfaceBody> bodies = with_blocks(node);
  node.attach(bodies);
  const Inertia& block = bodies[kClavicleLeft].block;
  const Pose to_world{Quat::Identity(), bodies[kClavicleLeft].motion.X_WB.p};
  const Inertia sum = own + block.in(to_world);
  EXPECT_NEAR(node.world().mass(clavicle), sum.mass, 1e-12);
  EXPECT_LT((node.world().position(clavicle) - sum.com).norm(), 1e-12);
  const Mat3 R = node.world().rotation(clavicle);
  EXPECT_LT((R * node.world().inertia(clavicle) * R.transpose() - sum.about_com).norm(), 1e-12);
  const std::vector<InterfaceBody> after = node.interface_bodies();
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_LT((after[i].motion.X_WB.p - before[i].motion.X_WB.p).norm(), 1e-12);
  }
}

TEST(MbNode, StartsWalkingAndTurningAboutThePelvisAsOnePiece) {
  MbNode node(load_config("v2370", RunMode::Coupled,
                          "[posture]\nheading_deg = 90.0\nwalking_speed_m_s = 1.5\n"
                          "spin_x_rad_s = 1.0\nspin_y_rad_s = -2.0\nspin_z_deg_s = 180.0\n"));
  node.attach(with_blocks(node));
  const Vec3 walking(0, 1.5, 0), spin(1, -2, kPi), pelvis = node.model().X_WB0[0].p;
  for (const InterfaceBody& body : node.interface_bodies()) {
    if (body.name == "buck") continue;
    const Vec3 expected = walking + spin.cross(body.motion.X_WB.p - pelvis);
    EXPECT_LT((body.motion.V_WB.v - expected).norm(), 1e-12) << body.name;
    EXPECT_LT((body.motion.V_WB.w - spin).norm(), 1e-12) << body.name;
  }
}

TEST(MbNode, TheTorsoBlockReplacesItsOwnMass) {
  MbNode node(load_config("v2370", RunMode::Coupled));
  const int torso = node.model().config.body.find_segment("torso_up");
  const double before = node.world().mass(torso);
  node.attach(with_blocks(node));
  EXPECT_NEAR(node.world().mass(torso), before, 1e-12);
}

TEST(MbNode, CarriedImpulseChangesVelocitiesByTheMobility) {
  MbNode plain(load_config("v2370", RunMode::Coupled)),
      pushed(load_config("v2370", RunMode::Coupled));
  plain.attach(with_blocks(plain));
  pushed.attach(with_blocks(pushed));
  KeptRecords sink;
  MbGrant g = grant(0, 10'000);
  g.want_mobility = true;
  const MbReply a = plain.advance(g, sink);
  ASSERT_EQ(a.mobility.rows(), 18);
  Eigen::VectorXd C = Eigen::VectorXd::Zero(18);
  for (int i = 0; i < 18; ++i) C[i] = (i % 6 < 3 ? 1e-3 : 1e-5) * (1 + i % 5);
  g.carry.assign(8, Vec6::Zero());
  for (int i = 0; i < 3; ++i) g.carry[i] = C.segment<6>(6 * i);
  const MbReply b = pushed.advance(g, sink);
  const Eigen::VectorXd expected = a.mobility / kMobilitySafety * C;
  Eigen::VectorXd change(18);
  for (int i = 0; i < 3; ++i) {
    change.segment<6>(6 * i) = stack(b.bodies[i].V_WB) - stack(a.bodies[i].V_WB);
  }
  EXPECT_LT((change - expected).norm(), 2e-4 * expected.norm());
  EXPECT_GT(b.energy.interface_work, 0);
  EXPECT_EQ(a.energy.interface_work, 0);
}

TEST(MbNode, BiasActsOverTheWholeWindow) {
  MbNode carried(load_config("v2370", RunMode::Coupled)),
      biased(load_config("v2370", RunMode::Coupled));
  KeptRecords sink;
  MbGrant g = grant(0);
  g.carry.assign(8, Vec6::Zero());
  g.carry[0][1] = 0.01;
  carried.advance(g, sink);
  MbGrant h = grant(0);
  h.bias.assign(8, Vec6::Zero());
  h.bias[0][1] = 0.01 / h.id.length_s();
  biased.advance(h, sink);
  const double p = carried.world().linear_momentum().y();
  EXPECT_NEAR(p, 0.01, 1e-9);
  EXPECT_NEAR(biased.world().linear_momentum().y(), p, 1e-9);
}

TEST(MbNode, RepeatedWindowsStartFromTheSameState) {
  MbNode node(load_config("v2370", RunMode::Coupled));
  KeptRecords sink;
  for (int k = 0; k < 12; ++k) node.advance(grant(k), sink);
  const std::size_t kept = sink.force_times.size();
  MbGrant g = grant(12);
  g.id.phase = Phase::Evaluate;
  const std::uint64_t first = node.advance(g, sink).state_hash;
  g.id.iteration = 1;
  g.bias.assign(8, Vec6::Constant(5));
  EXPECT_NE(node.advance(g, sink).state_hash, first);
  g.id.iteration = 2;
  g.bias.clear();
  EXPECT_EQ(node.advance(g, sink).state_hash, first);
  EXPECT_EQ(sink.force_times.size(), kept) << "an evaluation is no record";
  g.id.phase = Phase::Accept;
  EXPECT_EQ(node.advance(g, sink).state_hash, first);
  // The same window done once and for good gives the same bits.
  MbNode other(load_config("v2370", RunMode::Coupled));
  KeptRecords ignored;
  std::uint64_t direct = 0;
  for (int k = 0; k <= 12; ++k) direct = other.advance(grant(k), ignored).state_hash;
  EXPECT_EQ(direct, first);
  EXPECT_EQ(sink.force_times, ignored.force_times);
}

TEST(MbNode, CheckpointContinuesBitByBit) {
  for (const char* stepper : {"direct", "quick"}) {
    const std::string more = std::string("[multibody]\nstepper = \"") + stepper + "\"\n";
    MbNode node(load_config("v2370", RunMode::Multibody, more));
    KeptRecords sink;
    int k = 0;
    for (; k < 15; ++k) node.advance(grant(k), sink);
    const std::vector<std::byte> bytes = node.save_state();
    std::uint64_t expected = 0;
    for (; k < 20; ++k) expected = node.advance(grant(k), sink).state_hash;
    MbNode fresh(load_config("v2370", RunMode::Multibody, more));
    fresh.load_state(bytes);
    std::uint64_t found = 0;
    for (k = 15; k < 20; ++k) found = fresh.advance(grant(k), sink).state_hash;
    EXPECT_EQ(found, expected) << stepper;
    std::vector<std::byte> damaged(bytes.begin(), bytes.end() - 1);
    EXPECT_THROW(fresh.load_state(damaged), ProtocolError);
  }
}

TEST(MbNode, TouchesTheCarWhenTheGapIsClosed) {
  // 2 mm at 11.11 m/s: 0.18 ms; until then the harness holds the body still.
  MbNode node(load_config("v2370", RunMode::Multibody));
  KeptRecords sink;
  MbReply reply;
  for (int k = 0; k < 9; ++k) reply = node.advance(grant(k), sink);
  EXPECT_FALSE(reply.first_contact);
  EXPECT_LT(reply.energy.kinetic, 1e-18);
  for (int k = 9; k < 12; ++k) reply = node.advance(grant(k), sink);
  EXPECT_TRUE(reply.first_contact);
  EXPECT_NEAR(node.state().first_contact_time, 0.18e-3, 0.03e-3);
  ASSERT_EQ(sink.events.size(), 1u);
}

TEST(MbNode, TheNeckCarriesTheHeadsInertiaAndWeight) {
  const MbConfig config = load_config("v2370", RunMode::Multibody);
  const int i = config.body.find_segment("head");
  const Segment& head = config.body.segments[i];
  MbNode node(config);
  KeptRecords sink;
  constexpr int kWindows = 6000;  // 60 ms, one step each: the head is pulled along, hit by nothing
  for (int k = 0; k < kWindows; ++k) node.advance(grant(k, 10'000), sink);
  Vec3 spin = Vec3::Zero();
  double largest = 0;
  for (int k = 1000; k < kWindows; ++k) {
    const HeadSample& s = sink.heads[k];
    const Mat3 R = s.X_WH.R();
    const Vec3 L = R * head.inertia * R.transpose() * s.V_WH.w;
    if (k > 1000) {
      const Vec3 force = head.mass * (s.acceleration + Vec3(0, 0, kStandardGravity));
      EXPECT_LT((s.neck.f - force).norm(), 1e-6 * (1 + force.norm())) << k;
      const Vec3 about_com = s.neck.shifted(R * (head.com - head.joint_centre)).tau;
      EXPECT_LT((about_com - (L - spin) / 1e-5).norm(), 1e-6 * (1 + about_com.norm())) << k;
    }
    spin = L;
    largest = std::max(largest, s.neck.f.norm());
  }
  EXPECT_GT(largest, 100);
}

TEST(MbNode, RecordsHeadForcesAndPosesAtTheirRates) {
  MbNode node(load_config("v2370", RunMode::Multibody));
  KeptRecords sink;
  for (int k = 0; k < 55; ++k) node.advance(grant(k), sink);  // 1.1 ms
  EXPECT_EQ(sink.heads.size(), 55u);
  EXPECT_EQ(sink.heads.back().t_ns, 1'100'000);
  EXPECT_EQ(sink.body_times, (std::vector<std::int64_t>{0, 1'000'000}));
  EXPECT_EQ(sink.force_times.size(), 23u);
  EXPECT_EQ(sink.force_times[1], 50'000);
  const auto description = nlohmann::json::parse(node.description());
  EXPECT_EQ(description["bodies"].size(), sink.poses[0].size());
  EXPECT_EQ(description["contact_pairs"].size(), sink.forces[0].size());
  EXPECT_EQ(description["contact_pairs"][0], "car_total");
  EXPECT_EQ(description["bodies"][description["head_body"].get<int>()], "head");
  EXPECT_EQ(description["vehicle"]["provenance"], "estimated");
}

}  // namespace
}  // namespace crosswalk::mb
