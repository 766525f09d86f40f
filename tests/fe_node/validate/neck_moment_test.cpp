// The turning of neck levels: what is read off a moment-angle record.
#include "fe_node/validate/neck_moment.h"

#include <gtest/gtest.h>

#include "fe_node/validate/neck_trunk.h"

namespace crosswalk::fe::validate {
namespace {

TEST(AtMoment, LiesBetweenTheSamplesAboutIt) {
  std::vector<MomentSample> samples(3);
  for (int i = 0; i < 3; ++i) {
    samples[i].turned = 0.1 * i;
    samples[i].moment = 0.5 * i * i;
    samples[i].levels = {0.05 * i, 0.05 * i};
    samples[i].energy[1] = i;
  }
  const MomentSample at = at_moment(samples, 1.25);
  EXPECT_NEAR(at.turned, 0.15, 1e-12);
  EXPECT_NEAR(at.levels[1], 0.075, 1e-12);
  EXPECT_NEAR(at.energy[1], 1.5, 1e-12);
  EXPECT_TRUE(at_moment(samples, 3).levels.empty());
}

TEST(Trunk, TouchesNothingAtRestAndOnlyPushes) {
  generate::ModelDraft draft = neck_with_rigid_head(generate::build_head_neck({}));
  const std::size_t lines = draft.mesh.lines.size(), curves = draft.curves.size();
  add_trunk(draft);
  ASSERT_EQ(draft.mesh.lines.size(), lines + 11);
  for (std::size_t k = curves; k < draft.curves.size(); ++k) {
    const auto& points = draft.curves[k].points;
    if (draft.curves[k].axes != generate::CurveAxes::ForceOverElongation) continue;
    for (std::size_t i = 1; i < points.size(); ++i) {
      EXPECT_GT(points[i].first, points[i - 1].first);
      EXPECT_LE(points[i - 1].second, 0);
    }
    EXPECT_EQ(points.back().second, 0);
    EXPECT_LT(points[4].first, -0.02) << "free way before the contact, m";
    EXPECT_EQ(points[4].second, 0);
  }
}

TEST(Volunteer, HasToneThenReflex) {
  const Points a = volunteer(0.04);
  EXPECT_EQ(a.front().second, a[1].second);
  EXPECT_NEAR(a[1].first, 0.115, 1e-12);
  EXPECT_GT(a.back().second, 0.2);
}

}  // namespace
}  // namespace crosswalk::fe::validate
