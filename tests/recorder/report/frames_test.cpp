#include "recorder/report/frames.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/recorder/report/synthetic_run.h"

namespace crosswalk::recording {
namespace {

constexpr Rgb kWhite{255, 255, 255};
constexpr Rgb kRed{200, 40, 40};
constexpr Rgb kGreen{40, 200, 40};

Camera from_above(double pixels_per_metre) {
  Camera camera;
  camera.pixels_per_metre = pixels_per_metre;
  return camera;
}

bool is_reddish(Rgb c) { return c.r > 2 * c.g; }
bool is_greenish(Rgb c) { return c.g > 2 * c.r; }

TEST(Raster, SphereCoversItsProjectedArea) {
  Raster raster(80, 80, from_above(40.0), kWhite);
  raster.ellipsoid(Pose{}, Vec3::Constant(0.8), kRed, 0);
  const Image image = raster.finish();
  int covered = 0;
  for (const Rgb& p : image.pixels) covered += p == kWhite ? 0 : 1;
  // Disc of radius 32 px: 3217 px, and the ring of partly covered pixels (about 2 pi 32).
  EXPECT_NEAR(covered, 3217, 210);
  EXPECT_TRUE(is_reddish(image.at(40, 40)));
  EXPECT_EQ(image.at(2, 2), kWhite);
}

TEST(Raster, NearerSurfaceHidesTheOtherWhateverTheOrder) {
  Pose near_pose;
  near_pose.p = Vec3(0, 0, 1);
  Raster a(20, 20, from_above(10.0), kWhite);
  a.ellipsoid(near_pose, Vec3::Constant(0.5), kRed, 0);
  a.ellipsoid(Pose{}, Vec3::Constant(0.5), kGreen, 1);
  Raster b(20, 20, from_above(10.0), kWhite);
  b.ellipsoid(Pose{}, Vec3::Constant(0.5), kGreen, 1);
  b.ellipsoid(near_pose, Vec3::Constant(0.5), kRed, 0);
  EXPECT_TRUE(is_reddish(a.finish().at(10, 10)));
  EXPECT_TRUE(is_reddish(b.finish().at(10, 10)));
}

TEST(Raster, LightComesFromTheUpperLeft) {
  Raster raster(60, 60, from_above(30.0), kWhite);
  raster.ellipsoid(Pose{}, Vec3::Constant(0.9), kGreen, 0);
  const Image image = raster.finish();
  EXPECT_GT(image.at(20, 20).g, image.at(40, 40).g);
  EXPECT_TRUE(is_greenish(image.at(30, 30)));
}

TEST(Frames, SubjectsRightIsOnTheRightOfThePosteriorView) {
  Scene scene;
  scene.bodies = {"left", "right"};
  scene.ellipsoids = {{0, "left", Pose{}, Vec3::Constant(0.1)},
                      {1, "right", Pose{}, Vec3::Constant(0.1)}};
  Pose left;
  left.p = Vec3(0, 0.5, 1.0);  // +y: W has the subject's front along x and up along z
  Pose right;
  right.p = Vec3(0, -0.5, 0.2);
  SceneFrame frame;
  frame.X_WB = {left, right};
  scene.frames = {frame};
  const Framing part = framing(scene, StillView::Posterior, {0.0});
  const Image image = render_still(scene, StillView::Posterior, 0.0, part, 60);
  const auto row_of_first_body = [&image](int begin, int end) {
    for (int y = 0; y < image.height; ++y) {
      for (int x = begin; x < end; ++x) {
        if (image.at(x, y).r > 2 * image.at(x, y).b && image.at(x, y).r > 60) return y;
      }
    }
    return image.height;
  };
  EXPECT_LT(row_of_first_body(0, image.width / 2), row_of_first_body(image.width / 2, image.width));
}

TEST(Frames, SamePictureEveryTime) {
  const Scene scene = synthetic::scene();
  const Framing part = framing(scene, StillView::Superior, {0.1});
  EXPECT_EQ(png(render_still(scene, StillView::Superior, 0.1, part, 40)),
            png(render_still(scene, StillView::Superior, 0.1, part, 40)));
}

TEST(Frames, DefaultInstantsEndAt200Milliseconds) {
  EXPECT_THAT(default_still_times(synthetic::scene()),
              testing::ElementsAre(0, testing::DoubleEq(0.04), testing::DoubleEq(0.08),
                                   testing::DoubleEq(0.12), testing::DoubleEq(0.16),
                                   testing::DoubleEq(0.2)));
}

TEST(Frames, OneFilePerViewAndInstant) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "crosswalk_stills";
  const auto files = write_stills(folder, synthetic::scene(), {0.0, 0.12}, 30);
  ASSERT_EQ(files.size(), 4U);
  EXPECT_EQ(files[1].filename(), "posterior_120ms.png");
  EXPECT_EQ(files[2].filename(), "superior_000ms.png");
  for (const auto& file : files) EXPECT_GT(std::filesystem::file_size(file), 100U);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace crosswalk::recording
