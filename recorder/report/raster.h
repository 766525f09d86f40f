// A small software renderer: orthographic camera, z-buffer, smooth shading, object outlines and
// supersampling; deterministic (no threads, no display).
//
// Camera frame C: x right, y up, z towards the viewer. Light comes from the upper left of the
// viewer.
#pragma once

#include <array>
#include <vector>

#include "common/spatial.h"
#include "recorder/report/image.h"
#include "recorder/report/scene.h"

namespace crosswalk::recording {

struct Camera {
  Mat3 R_CW = Mat3::Identity();
  Vec3 centre_W = Vec3::Zero();     ///< shown in the middle of the picture
  double pixels_per_metre = 200.0;  ///< of the final picture
};

class Raster {
 public:
  Raster(int width, int height, const Camera& camera, Rgb background);

  /// A triangle with corner normals in W; `object` separates outlines.
  void triangle(const std::array<Vec3, 3>& p_W, const std::array<Vec3, 3>& normal_W, Rgb colour,
                int object);
  void ellipsoid(const Pose& X_WE, const Vec3& semi_axes, Rgb colour, int object);
  void mesh(const Pose& X_WM, const SceneMesh& mesh, Rgb colour, int object);
  /// A flat quadrilateral, corners in order.
  void quad(const std::array<Vec3, 4>& p_W, Rgb colour, int object);
  /// A line of the given width (final pixels) drawn where nothing nearer is.
  void line(const Vec3& from_W, const Vec3& to_W, double width, Rgb colour);

  /// Darkens object borders and averages the supersamples.
  Image finish() const;

 private:
  struct Sample {
    double depth;
    int object;
    Rgb colour;
  };
  Vec3 to_screen(const Vec3& p_W) const;
  bool is_border(int x, int y) const;
  Sample& at(int x, int y) { return samples_[static_cast<std::size_t>(y) * width_ + x]; }
  const Sample& at(int x, int y) const {
    return samples_[static_cast<std::size_t>(y) * width_ + x];
  }

  int width_;  ///< supersampled
  int height_;
  Camera camera_;
  std::vector<Sample> samples_;
};

}  // namespace crosswalk::recording
