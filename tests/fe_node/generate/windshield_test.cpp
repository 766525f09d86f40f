// Generated windshields: size, mass, normals and numbering.
#include "fe_node/generate/windshield.h"

#include <numeric>

#include <gtest/gtest.h>

#include "fe_node/generate/mass_report.h"
#include "fe_node/generate/part_ids.h"

namespace crosswalk::fe::generate {
namespace {

TEST(Windshield, FiveMillimetresGiveTheSizeOfThePaper) {
  WindshieldSpec spec;
  spec.cell = 0.005;
  const ModelDraft draft = build_windshield(spec);
  // 54 000 nodes and 58 000 elements there [yu2020, App. A]; the pane's size is not published.
  EXPECT_NEAR(static_cast<double>(draft.mesh.nodes.size()), 54e3, 6e3);
  EXPECT_NEAR(static_cast<double>(draft.mesh.quads.size()), 58e3, 8e3);
}

TEST(Windshield, WeighsItsAreaTimesItsPlies) {
  WindshieldSpec spec;
  spec.cell = 0.020;
  const double area = spec.width * 0.88685;  // between (1070, 990) and (1840, 1430)
  EXPECT_NEAR(inertia_of(build_windshield(spec), {part::kWindshield}, false).mass,
              area * 1e-3 * 7850, 1e-3);
  spec.kind = WindshieldKind::Laminated;
  EXPECT_NEAR(inertia_of(build_windshield(spec), {part::kWindshield}, false).mass, area * 11.336,
              1e-2);
}

TEST(Windshield, NormalsPointOutwardsAndUp) {
  WindshieldSpec spec;
  spec.cell = 0.050;
  spec.sagitta = 0.04;
  const ModelDraft draft = build_windshield(spec);
  const auto& x = draft.mesh.nodes;
  for (const Quad& quad : draft.mesh.quads) {
    const Vec3 normal =
        (x[quad.node[2]] - x[quad.node[0]]).cross(x[quad.node[3]] - x[quad.node[1]]);
    EXPECT_GT(normal.z(), 0);
    EXPECT_LT(normal.normalized().x(), -0.2);
  }
}

TEST(Windshield, LaminateRuleFillsTheThickness) {
  WindshieldSpec spec;
  spec.kind = WindshieldKind::Laminated;
  spec.cell = 0.1;
  const Deck deck = generate_windshield(spec);
  ASSERT_EQ(deck.integrations.size(), 1u);
  double sum = 0, moment = 0;
  for (const IntegrationPoint& row : deck.integrations[0].rows) {
    sum += row.weight;
    moment += row.weight * row.position * row.position;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  const double pvb = spec.pvb_thickness / (2 * spec.glass_thickness + spec.pvb_thickness);
  EXPECT_NEAR(moment, (1 - pvb * pvb * pvb) / 3, 1e-12);  // bending, but for the interlayer's own
}

}  // namespace
}  // namespace crosswalk::fe::generate
