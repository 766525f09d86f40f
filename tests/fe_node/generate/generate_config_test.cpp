// [head_neck] and [windshield]: defaults, choices, and a subject outside the generator's range.
#include "fe_node/generate/generate_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crosswalk::fe::generate {
namespace {

Anthropometry man() {
  Anthropometry subject;
  subject.standing_height = 1.795;
  subject.head_length = 0.185;
  subject.head_breadth = 0.161;
  subject.head_to_chin_height = 0.2085;
  subject.neck_circumference = 0.452;
  return subject;
}

TEST(GenerateConfig, DefaultsAreLiteraturePassive) {
  ConfigDocument document = ConfigDocument::from_text("[head_neck]\n[windshield]\n", "test.toml");
  const HeadNeckSpec spec =
      read_head_neck_spec(document.root().table("head_neck", ""), man(), Fidelity::Medium);
  const WindshieldSpec pane = read_windshield(document.root().table("windshield", ""));
  document.finish();
  EXPECT_EQ(spec.mass.preset, MassPreset::Literature);
  EXPECT_EQ(spec.activation, 0);
  EXPECT_EQ(spec.head.length, 0.185);
  EXPECT_EQ(pane.kind, WindshieldKind::Panel);
}

TEST(GenerateConfig, MeasuredHeadInUserUnits) {
  ConfigDocument document = ConfigDocument::from_text(
      "[head_neck]\nmass = \"measured\"\nhead_mass_g = 4100\n"
      "head_moments_kg_m2 = [0.018, 0.020, 0.014]\n[windshield]\nkind = \"laminated\"\ncell_mm = "
      "5\n",
      "test.toml");
  const HeadNeckSpec spec =
      read_head_neck_spec(document.root().table("head_neck", ""), man(), Fidelity::Medium);
  const WindshieldSpec pane = read_windshield(document.root().table("windshield", ""));
  document.finish();
  EXPECT_EQ(spec.fidelity, Fidelity::Medium);
  EXPECT_NEAR(spec.mass.head_mass, 4.1, 1e-12);
  EXPECT_EQ(spec.mass.head_moments, Vec3(0.018, 0.020, 0.014));
  EXPECT_EQ(pane.kind, WindshieldKind::Laminated);
  EXPECT_NEAR(pane.cell, 0.005, 1e-15);
}

TEST(GenerateConfig, SubjectOutsideTheRangeIsReported) {
  ConfigDocument document = ConfigDocument::from_text("[head_neck]\n", "test.toml");
  Anthropometry child = man();
  child.head_length = 0.15;
  read_head_neck_spec(document.root().table("head_neck", ""), child, Fidelity::Coarse);
  try {
    document.finish();
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("head length"));
    EXPECT_THAT(error.what(), testing::HasSubstr("150.0"));
  }
}

}  // namespace
}  // namespace crosswalk::fe::generate
