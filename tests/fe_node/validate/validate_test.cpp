// The bookkeeping of component tests: verdicts, head pieces, tissue points, metrics.
#include <cmath>

#include <gtest/gtest.h>

#include "common/units.h"
#include "fe_node/generate/head_neck.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/validate/head_draft.h"
#include "fe_node/validate/injury.h"
#include "fe_node/validate/measure.h"
#include "fe_node/validate/rotation.h"

namespace crosswalk::fe::validate {
namespace {

TEST(Measure, LowConfidenceDecidesNothing) {
  Measure m;
  m.ours = 5;
  m.low = 8;
  m.high = 12;
  EXPECT_EQ(m.verdict(), Verdict::Context);
  m.confidence = Confidence::High;
  EXPECT_EQ(m.verdict(), Verdict::NotMet);
  EXPECT_FALSE(m.is_gate());
  m.confidence = Confidence::ClosedForm;
  EXPECT_TRUE(m.is_gate());
  m.ours = 9;
  EXPECT_EQ(m.verdict(), Verdict::Met);
  m.ours = std::numeric_limits<double>::quiet_NaN();  // nothing measured is nothing met
  EXPECT_EQ(m.verdict(), Verdict::NotMet);
}

TEST(Measure, LogarithmicStrainOfAStretch) {
  const double stretch = 1.3;
  EXPECT_NEAR(logarithmic(0.5 * (stretch * stretch - 1)), std::log(stretch), 1e-12);
}

TEST(Hic, SquarePulse) {
  std::vector<double> time, acceleration;
  for (int i = 0; i <= 400; ++i) {
    time.push_back(1e-4 * i);
    acceleration.push_back(i > 100 && i <= 200 ? 100 * kStandardGravity : 0);
  }
  EXPECT_NEAR(hic(time, acceleration, 0.015), std::pow(100, 2.5) * 0.010, 1);
}

TEST(Rotation, EndsAtItsSpeed) {
  EXPECT_NEAR(ramp_and_hold(19, 0.0115)(0.02), 19, 1e-12);
  EXPECT_NEAR(up_and_down(30, 0.01)(0.01), 30, 1e-12);
  EXPECT_NEAR(up_and_down(30, 0.01)(0.02), 0, 1e-9);
}

TEST(Rotation, DamageOfASlowTurnIsTheStaticLag) {
  // Constant acceleration alpha: lag alpha / k once at rest; 23493 1/s2 about y.
  const Rotation steady{.axis = 1,
                        .pivot = {},
                        .speed = [](double t) { return 500 * t * std::min(1.0, t / 0.5); },
                        .end = 1.0};
  EXPECT_NEAR(damage_of(steady), 2.9903 * 1000 / 23493, 0.1 * 2.9903 * 1000 / 23493);
}

class HeadPieces : public testing::Test {
 protected:
  static const generate::HeadNeck& whole() {
    static const generate::HeadNeck made = generate::build_head_neck({});
    return made;
  }
};

TEST_F(HeadPieces, HeadAloneKeepsTheMassOfTheHead) {
  const generate::ModelDraft head = whole_head(whole());
  const std::vector<int> parts = parts_of_set(head, "head");
  EXPECT_NEAR(generate::inertia_of(head, parts, true).mass, whole().masses.row("head").inertia.mass,
              1e-9);
  for (const generate::Hex& hex : head.mesh.hexes)
    for (int n : hex.node) ASSERT_LT(n, static_cast<int>(head.mesh.nodes.size()));
}

TEST_F(HeadPieces, RigidSkullHoldsBrainAndFluid) {
  const generate::ModelDraft head = rigid_skull_head(whole());
  for (const generate::Hex& hex : head.mesh.hexes) {
    EXPECT_NE(hex.part, generate::part::kDiploe);
    EXPECT_NE(hex.part, generate::part::kScalp);
  }
}

TEST_F(HeadPieces, TissuePointSitsWhereItWasAskedFor) {
  const generate::ModelDraft head = rigid_skull_head(whole());
  const Vec3 wanted = whole().landmarks.tragion + Vec3(0.003, 0.031, 0.081);
  const TissuePoint point = tissue_point(head, parts_of_set(head, "brain"), wanted);
  Vec3 found = Vec3::Zero();
  for (int c = 0; c < 8; ++c) found += point.weight[c] * head.mesh.nodes[point.node[c]];
  EXPECT_LT((found - wanted).norm(), 1e-9);
}

}  // namespace
}  // namespace crosswalk::fe::validate
