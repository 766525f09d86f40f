// [head_neck] and [windshield]: defaults, choices, and a subject outside the generator's range.
#include "fe_node/generate/generate_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/subject_fixture.h"

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
  const std::optional<WindshieldSpec> pane =
      read_windshield(document.root().table("windshield", ""), VehicleFront{}, Fidelity::Medium);
  document.finish();
  EXPECT_FALSE(pane.has_value());
  EXPECT_EQ(spec.mass.preset, MassPreset::Literature);
  EXPECT_EQ(spec.activation, 0);
  EXPECT_EQ(spec.brain_bulk, kBrainBulk);
  EXPECT_EQ(spec.head.length, 0.185);
}

TEST(GenerateConfig, MeasuredHeadInUserUnits) {
  ConfigDocument document = ConfigDocument::from_text(
      "[head_neck]\nmass = \"measured\"\nhead_mass_g = 4100\n"
      "head_moments_kg_m2 = [0.018, 0.020, 0.014]\nbrain_bulk_GPa = 2.19\n"
      "[windshield]\nmodel = \"laminated\"\ncell_mm = 5\n",
      "test.toml");
  const HeadNeckSpec spec =
      read_head_neck_spec(document.root().table("head_neck", ""), man(), Fidelity::Medium);
  const std::optional<WindshieldSpec> pane = read_windshield(
      document.root().table("windshield", ""), load_front("generic_sedan_buck"), Fidelity::Coarse);
  document.finish();
  EXPECT_EQ(spec.fidelity, Fidelity::Medium);
  EXPECT_NEAR(spec.mass.head_mass, 4.1, 1e-12);
  EXPECT_EQ(spec.mass.head_moments, Vec3(0.018, 0.020, 0.014));
  EXPECT_NEAR(spec.brain_bulk, kWaterBulk, 1);
  ASSERT_TRUE(pane.has_value());
  EXPECT_EQ(pane->kind, WindshieldKind::Laminated);
  EXPECT_NEAR(pane->cell, 0.005, 1e-15);
  EXPECT_NEAR(pane->upper_x, 1.840, 1e-12);  // as the buck has it
  EXPECT_NEAR(pane->lower_z, 0.990, 1e-12);
  EXPECT_NEAR(pane->width, 1.4, 1e-12);
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

TEST(GenerateConfig, PaneNeedsACarThatHasOne) {
  ConfigDocument document =
      ConfigDocument::from_text("[windshield]\nmodel = \"panel\"\n", "test.toml");
  read_windshield(document.root().table("windshield", ""), VehicleFront{}, Fidelity::Coarse);
  try {
    document.finish();
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("windshield.model"));
    EXPECT_THAT(error.what(), testing::HasSubstr("component `windshield`"));
  }
}

}  // namespace
}  // namespace crosswalk::fe::generate
