// MPS, CSDM, pressure and stress of uniform deformations, where closed forms exist.
#include "fe_node/output/tissue_metrics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fe_node/output/stretched_box.h"

namespace crosswalk::fe {
namespace {

const Elastic kTissue = Elastic::from_bulk(1040, 2e5, 3e3);

Model tissue_box(const Box& box) {
  Model model = box_model(box, kTissue);
  model.finish();
  return model;
}

TissueSample sample(const Model& model, const Mat3& F, StrainPeaks& peaks) {
  const TissueMetrics metrics(model, {{"brain", {0}}});
  if (peaks.empty()) peaks = metrics.no_peaks();
  return metrics.sample(model, deformed_state(model, F), 7, peaks);
}

TEST(PrincipalStrain, ClosedForms) {
  const double a = 1.2;  // (a^2 - 1) / 2 along the stretch
  EXPECT_NEAR(first_principal_strain(stretch(a, 1, 1)), 0.22, 1e-12);
  EXPECT_NEAR(first_principal_strain(stretch(0.9, 0.8, 0.7)), 0.5 * (0.81 - 1), 1e-12);
  // Simple shear g: C has the eigenvalues 1 + g^2/2 +- g sqrt(1 + g^2/4).
  const double g = 0.3;
  Mat3 shear = Mat3::Identity();
  shear(0, 1) = g;
  EXPECT_NEAR(first_principal_strain(shear), 0.5 * (g * g / 2 + g * std::sqrt(1 + g * g / 4)),
              1e-12);
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_NEAR(first_principal_strain(turn), 0, 1e-12);
  EXPECT_NEAR(first_principal_strain(turn * shear), first_principal_strain(shear), 1e-12);
}

TEST(VolumeQuantile, WeighsByVolume) {
  EXPECT_EQ(volume_quantile({}, 0.95), 0);
  EXPECT_EQ(volume_quantile({{3.0, 1}, {1.0, 1}, {2.0, 1}, {4.0, 1}}, 0.5), 2.0);
  // 95 % of the volume lies below the one large element
  EXPECT_EQ(volume_quantile({{0.1, 95}, {0.9, 5}}, 0.95), 0.1);
  EXPECT_EQ(volume_quantile({{0.1, 94}, {0.9, 6}}, 0.95), 0.9);
}

TEST(TissueMetrics, UniaxialStretchOfABox) {
  const Model model = tissue_box({3, 2, 2, {0.03, 0.02, 0.02}});
  StrainPeaks peaks;
  const double a = 1.3;
  const TissueSample tissue = sample(model, stretch(a, 1, 1), peaks);
  ASSERT_EQ(tissue.regions.size(), 1U);
  EXPECT_EQ(tissue.t_ns, 7);
  const TissueSample::Region& region = tissue.regions[0];
  const double strain = 0.5 * (a * a - 1);  // 0.345
  EXPECT_NEAR(region.mps_max, strain, 1e-9);
  EXPECT_NEAR(region.mps_95, strain, 1e-9);
  EXPECT_NEAR(region.mps_95_so_far, strain, 1e-9);
  EXPECT_EQ(region.csdm_15, 1);
  EXPECT_EQ(region.csdm_25, 1);
  // Cauchy stress of the law under F = diag(a, 1, 1)
  const double side = kTissue.lambda * (a - 1);
  const double along = side + kTissue.mu * (a * a - 1) / a;
  EXPECT_NEAR(region.pressure_max, -(along + 2 * side) / 3, 1e-6 * side);
  EXPECT_NEAR(region.pressure_min, region.pressure_max, 1e-6 * side);
  EXPECT_NEAR(region.von_mises_95, along - side, 1e-6 * side);
}

TEST(TissueMetrics, PeaksStayAndTheDamageMeasureCountsTheirVolume) {
  const Model model = tissue_box({10, 1, 1, {0.1, 0.01, 0.01}});
  const TissueMetrics metrics(model, {{"brain", {0}}});
  StrainPeaks peaks = metrics.no_peaks();
  // Three of ten equal elements are stretched beyond 0.15, one of them beyond 0.25.
  State state = initial_state(model);
  const auto place = [&](double last, double before) {
    std::vector<double> length(10, 0.01);
    length[9] *= last;
    length[8] *= before;
    length[7] *= before;
    for (int n = 0; n < model.mesh.node_count(); ++n) {
      Vec3 p = model.mesh.position[n];
      const int layer = static_cast<int>(std::lround(p.x() / 0.01));
      p.x() = 0;
      for (int i = 0; i < layer; ++i) p.x() += length[i];
      state.nodes[n].set_position(p);
    }
    return metrics.sample(model, state, 0, peaks).regions[0];
  };
  const TissueSample::Region stretched = place(1.3, 1.2);
  EXPECT_NEAR(stretched.csdm_15, 0.3, 1e-12);
  EXPECT_NEAR(stretched.csdm_25, 0.1, 1e-12);
  EXPECT_NEAR(stretched.mps_max, 0.345, 1e-9);
  const TissueSample::Region relaxed = place(1.0, 1.0);
  EXPECT_NEAR(relaxed.mps_max, 0, 1e-12);
  EXPECT_NEAR(relaxed.mps_95_so_far, 0.345, 1e-9);
  EXPECT_NEAR(relaxed.csdm_15, 0.3, 1e-12);
  EXPECT_NEAR(relaxed.csdm_25, 0.1, 1e-12);
}

// Two of ten equal bricks share the edge whose node is pushed through them; their mean volume stays
// positive, so no stress tells.
TEST(TissueMetrics, CountsBricksWithACornerInsideOut) {
  const Model model = tissue_box({10, 1, 1, {0.1, 0.01, 0.01}});
  StrainPeaks peaks;
  EXPECT_EQ(sample(model, stretch(0.5, 1.4, 1.4), peaks).regions[0].inside_out, 0);
  for (int threads : {1, 2}) {
    State state = initial_state(model);
    for (NodeRecord& node : state.nodes)
      if ((node.position() - Vec3(0.05, 0.01, 0.01)).norm() < 1e-9)
        node.set_position({0.05, -0.001, 0.01});
    const TissueMetrics metrics(model, {{"brain", {0}}});
    EXPECT_NEAR(metrics.sample(model, state, 0, peaks, threads).regions[0].inside_out, 0.2, 1e-12);
  }
}

TEST(TissueMetrics, OtherPartsAreNotObserved) {
  Model model = tissue_box({2, 1, 1, {2, 1, 1}});
  const TissueMetrics metrics(model, {{"nothing", {}}, {"brain", {0}}});
  EXPECT_EQ(metrics.names(), (std::vector<std::string>{"nothing", "brain"}));
  StrainPeaks peaks = metrics.no_peaks();
  const TissueSample tissue =
      metrics.sample(model, deformed_state(model, stretch(1.2, 1, 1)), 0, peaks);
  EXPECT_EQ(tissue.regions[0].mps_max, 0);
  EXPECT_EQ(tissue.regions[0].csdm_15, 0);
  EXPECT_NEAR(tissue.regions[1].mps_max, 0.22, 1e-9);
}

}  // namespace
}  // namespace crosswalk::fe
