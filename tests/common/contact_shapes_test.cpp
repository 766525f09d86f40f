#include "common/contact_shapes.h"

#include <gtest/gtest.h>

#include "tests/common/subject_fixture.h"
#include "tests/source_folder.h"

namespace crosswalk {
namespace {

TEST(VehicleFront, FacetsFaceOutwards) {
  const VehicleFront front = load_front("generic_sedan_buck");
  ASSERT_EQ(front.components.size(), 6u);
  EXPECT_EQ(front.provenance, "estimated");
  for (const FrontFacet& facet : front.facets) {
    EXPECT_NEAR(facet.normal.norm(), 1, 1e-12);
    EXPECT_NEAR(facet.normal.dot(facet.end - facet.begin), 0, 1e-12);
  }
  // Bumper faces the pedestrian, hood and glass face upwards.
  EXPECT_GT(front.facets[4].normal.x(), 0.9);
  EXPECT_GT(front.facets.back().normal.y(), 0.8);
}

TEST(VehicleFront, WrapAroundDistanceFollowsTheTape) {
  const VehicleFront front = load_front("generic_sedan_buck");
  // Wrap-around distances of the profile points, mm, by an independent computation.
  struct Case {
    double x, z, wad;
  };
  for (const Case& c : {Case{0, 490, 490}, Case{25, 570, 576}, Case{88, 730, 749},
                        Case{170, 775, 844}, Case{1070, 990, 1770}, Case{1840, 1430, 2657}}) {
    EXPECT_NEAR(1e3 * wrap_around_distance(front, {-1e-3 * c.x, 1e-3 * c.z}), c.wad, 1.5);
  }
}

TEST(ContactShapes, GiveBothSidesTheSameSurfaces) {
  ConfigDocument document = ConfigDocument::from_text(
      "[subject]\nbase = \"subjects/v2370.toml\"\n[vehicle]\nbase = "
      "\"vehicles/generic_sedan_buck.toml\"\n",
      "test.toml", source_folder() / "scenarios");
  const std::vector<BodyShapes> shapes =
      read_contact_shapes(document.root(), {"buck", "scapula_l", "upper_arm_r"});
  document.finish();
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].facets.size(), load_front("generic_sedan_buck").facets.size());
  const BodyDescription body = load_subject("v2370");
  ASSERT_EQ(shapes[1].ellipsoids.size(), 1u);
  const EllipsoidShape& shoulder = shapes[1].ellipsoids[0];
  const SurfaceEllipsoid& reference = body.ellipsoids[body.find_ellipsoid("shoulder_l")];
  EXPECT_EQ(shoulder.region, "shoulder");
  EXPECT_EQ(shoulder.X_BE.p, reference.centre - body.segments[reference.segment].com);
  EXPECT_EQ(shoulder.semi_axes, reference.semi_axes);
  EXPECT_EQ(shapes[2].ellipsoids.size(), 2u);
}

}  // namespace
}  // namespace crosswalk
