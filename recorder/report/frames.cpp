#include "recorder/report/frames.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace crosswalk::recording {
namespace {

constexpr Rgb kPaper{255, 255, 255};
constexpr Rgb kGridLine{226, 229, 232};
constexpr Rgb kGround{120, 126, 132};
// Told apart without colour too: luma 88, 165, 207 and 228 of head, body, car and windshield.
constexpr Rgb kMultibody{226, 158, 44};     // gold, as the seed paper draws it
constexpr Rgb kFiniteElement{38, 98, 168};  // blue
constexpr Rgb kCar{203, 208, 213};
constexpr Rgb kCarSide{224, 227, 230};
constexpr Rgb kGlass{205, 236, 250};
constexpr double kGrid = 0.5;        // m
constexpr double kSkin = 0.03;       // m: drawn thickness of the front seen from the side
constexpr double kMargin = 0.12;     // m around the scene
constexpr double kCarBehind = 0.35;  // m of the car's rear that may be cut off, see framing()

bool is_glass(const SceneFacet& facet) { return facet.component.find("wind") != std::string::npos; }

/// Picture coordinates of a point: (y, z) or (y, x mirrored so that the subject's front is up).
Eigen::Vector2d in_picture(const Vec3& p_W, StillView view) {
  return {p_W.y(), view == StillView::Posterior ? p_W.z() : p_W.x()};
}

Mat3 camera_axes(StillView view) {
  Mat3 R_CW;
  if (view == StillView::Posterior) {
    R_CW << 0, -1, 0, 0, 0, 1, -1, 0, 0;  // right -y (the subject's right), up z, viewer at -x
  } else {
    R_CW << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // right -y, up x, viewer above
  }
  return R_CW;
}

void include(Framing& part, const Eigen::Vector2d& p) {
  part.low = part.low.cwiseMin(p);
  part.high = part.high.cwiseMax(p);
}

void draw_vehicle(Raster& raster, const Scene& scene, const Pose& X_WV, StillView view) {
  const int object = static_cast<int>(scene.bodies.size()) + 10;
  double floor = 0.15;  // m: lower edge of the drawn side
  for (const SceneFacet& facet : scene.facets) {
    floor = std::min({floor, facet.begin.y(), facet.end.y()});
  }
  int index = 1;
  for (const SceneFacet& facet : scene.facets) {
    const Rgb colour = is_glass(facet) ? kGlass : kCar;
    const double w = facet.half_width;
    const auto corner = [&](double x, const Eigen::Vector2d& yz) {
      return X_WV * Vec3(x, yz.x(), yz.y());
    };
    raster.quad({corner(-w, facet.begin), corner(-w, facet.end), corner(w, facet.end),
                 corner(w, facet.begin)},
                colour, object + index);
    if (view == StillView::Posterior) {  // the far side, so that it never hides the pedestrian
      const Eigen::Vector2d below_begin(facet.begin.x(), floor);
      const Eigen::Vector2d below_end(facet.end.x(), floor);
      raster.quad({corner(w, facet.begin), corner(w, facet.end), corner(w, below_end),
                   corner(w, below_begin)},
                  kCarSide, object);
      const Eigen::Vector2d along = (facet.end - facet.begin).normalized();
      const Eigen::Vector2d outward = kSkin * Eigen::Vector2d(along.y(), -along.x());
      const double near = w - 1e-3;
      raster.quad({corner(near, facet.begin), corner(near, facet.end),
                   corner(near, facet.end - outward), corner(near, facet.begin - outward)},
                  colour, object + index);
    }
    ++index;
  }
}

void draw_grid(Raster& raster, const Framing& part, StillView view) {
  const auto place = [view](double along, double across) {
    return view == StillView::Posterior ? Vec3(0, along, across) : Vec3(across, along, 0);
  };
  for (double y = std::ceil(part.low.x() / kGrid) * kGrid; y <= part.high.x(); y += kGrid) {
    raster.line(place(y, part.low.y()), place(y, part.high.y()), 1.0, kGridLine);
  }
  for (double v = std::ceil(part.low.y() / kGrid) * kGrid; v <= part.high.y(); v += kGrid) {
    raster.line(place(part.low.x(), v), place(part.high.x(), v), 1.0, kGridLine);
  }
  if (view == StillView::Posterior) {
    raster.line(place(part.low.x(), 0), place(part.high.x(), 0), 2.0, kGround);
  }
}

}  // namespace

std::string_view view_name(StillView view) {
  return view == StillView::Posterior ? "posterior" : "superior";
}

Framing framing(const Scene& scene, StillView view, const std::vector<double>& times) {
  Framing part;
  part.low = Eigen::Vector2d::Constant(1e9);
  part.high = -part.low;
  for (const double t : times) {
    const SceneFrame& frame = scene.frame_at(t);
    for (const SceneEllipsoid& e : scene.ellipsoids) {
      const Pose X_WE = frame.X_WB[e.body] * e.X_BE;
      const Mat3 A = X_WE.R() * e.semi_axes.asDiagonal();
      const Vec3 extent = A.rowwise().norm();
      include(part, in_picture(X_WE.p - extent, view));
      include(part, in_picture(X_WE.p + extent, view));
    }
    if (scene.head && frame.X_WH) {
      for (const Vec3& v : scene.head->vertices) include(part, in_picture(*frame.X_WH * v, view));
    }
  }
  const double body_low = part.low.x() - kCarBehind;
  for (const double t : times) {
    for (const SceneFacet& facet : scene.facets) {
      for (const Eigen::Vector2d& yz : {facet.begin, facet.end}) {
        for (const double x : {-facet.half_width, facet.half_width}) {
          const Vec3 p_W = scene.frame_at(t).X_WV * Vec3(x, yz.x(), yz.y());
          const Eigen::Vector2d p = in_picture(p_W, view);
          include(part, {std::max(p.x(), body_low), p.y()});
        }
      }
    }
  }
  part.low -= Eigen::Vector2d::Constant(kMargin);
  part.high += Eigen::Vector2d::Constant(kMargin);
  if (view == StillView::Posterior) part.low.y() = -kMargin;
  return part;
}

Image render_still(const Scene& scene, StillView view, double t, const Framing& part, int height) {
  const SceneFrame& frame = scene.frame_at(t);
  const Eigen::Vector2d size = part.high - part.low;
  const Eigen::Vector2d middle = 0.5 * (part.low + part.high);
  Camera camera;
  camera.R_CW = camera_axes(view);
  camera.pixels_per_metre = height / size.y();
  camera.centre_W = view == StillView::Posterior ? Vec3(0, middle.x(), middle.y())
                                                 : Vec3(middle.y(), middle.x(), 0);
  const int width = std::max(1, static_cast<int>(std::lround(camera.pixels_per_metre * size.x())));
  Raster raster(width, height, camera, kPaper);
  draw_vehicle(raster, scene, frame.X_WV, view);
  for (const SceneEllipsoid& e : scene.ellipsoids) {
    raster.ellipsoid(frame.X_WB[e.body] * e.X_BE, e.semi_axes, kMultibody, e.body);
  }
  if (scene.head && frame.X_WH) {
    raster.mesh(*frame.X_WH, *scene.head, kFiniteElement, static_cast<int>(scene.bodies.size()));
  }
  draw_grid(raster, part, view);
  return raster.finish();
}

std::vector<double> default_still_times(const Scene& scene) {
  std::vector<double> times;
  if (scene.frames.empty()) return times;
  constexpr double kStep = 0.040;
  constexpr double kLast = 0.200;  // [yu2020, Appendix B]: leg contact to 200 ms
  constexpr double kReach = 2e-3;  // a run to 200 ms has its last poses up to 1 ms before
  for (int i = 0; i * kStep <= std::min(kLast, scene.frames.back().t + kReach) + 1e-9; ++i) {
    times.push_back(i * kStep);
  }
  return times;
}

std::vector<std::filesystem::path> write_stills(const std::filesystem::path& folder,
                                                const Scene& scene,
                                                const std::vector<double>& times, int height) {
  std::filesystem::create_directories(folder);
  std::vector<std::filesystem::path> files;
  for (const StillView view : {StillView::Posterior, StillView::Superior}) {
    const Framing part = framing(scene, view, times);
    for (const double t : times) {
      files.push_back(folder / fmt::format("{}_{:03.0f}ms.png", view_name(view), 1e3 * t));
      write_png(files.back(), render_still(scene, view, t, part, height));
    }
  }
  return files;
}

}  // namespace crosswalk::recording
