#include "recorder/report/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace crosswalk::recording {
namespace {

constexpr int kSupersampling = 3;
constexpr int kLines = 14;            // of the ellipsoid's parallels
constexpr int kMeridians = 28;        // facets stay under two pixels off at 200 pixels per metre
constexpr double kAmbient = 0.52;     // share of the colour kept in full shade
constexpr double kBorderStep = 0.03;  // m: depth jump inside one object that draws an outline

Rgb shaded(Rgb colour, const Vec3& normal_C) {
  static const Vec3 light = Vec3(-0.45, 0.65, 0.62).normalized();
  const double lit = kAmbient + (1.0 - kAmbient) * std::max(0.0, normal_C.dot(light));
  const auto scale = [lit](std::uint8_t c) {
    return static_cast<std::uint8_t>(std::lround(std::min(255.0, 1.08 * lit * c)));
  };
  return {scale(colour.r), scale(colour.g), scale(colour.b)};
}

}  // namespace

Raster::Raster(int width, int height, const Camera& camera, Rgb background)
    : width_(width * kSupersampling),
      height_(height * kSupersampling),
      camera_(camera),
      samples_(static_cast<std::size_t>(width_) * height_,
               Sample{-std::numeric_limits<double>::infinity(), -1, background}) {}

Vec3 Raster::to_screen(const Vec3& p_W) const {
  const Vec3 p_C = camera_.R_CW * (p_W - camera_.centre_W);
  const double scale = camera_.pixels_per_metre * kSupersampling;
  return {0.5 * width_ + scale * p_C.x(), 0.5 * height_ - scale * p_C.y(), p_C.z()};
}

void Raster::triangle(const std::array<Vec3, 3>& p_W, const std::array<Vec3, 3>& normal_W,
                      Rgb colour, int object) {
  std::array<Vec3, 3> s;
  std::array<Vec3, 3> n;
  for (int k = 0; k < 3; ++k) {
    s[k] = to_screen(p_W[k]);
    n[k] = camera_.R_CW * normal_W[k];
    if (!s[k].allFinite()) return;
  }
  const auto edge = [](const Vec3& a, const Vec3& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  };
  const double area = edge(s[0], s[1], s[2].x(), s[2].y());
  if (std::abs(area) < 1e-12) return;
  const auto [x_min, x_max] = std::minmax({s[0].x(), s[1].x(), s[2].x()});
  const auto [y_min, y_max] = std::minmax({s[0].y(), s[1].y(), s[2].y()});
  if (x_max < 0 || y_max < 0 || x_min > width_ || y_min > height_) return;
  const int x_end = static_cast<int>(std::min<double>(width_ - 1, std::ceil(x_max)));
  const int y_end = static_cast<int>(std::min<double>(height_ - 1, std::ceil(y_max)));
  for (int y = static_cast<int>(std::max(0.0, std::floor(y_min))); y <= y_end; ++y) {
    for (int x = static_cast<int>(std::max(0.0, std::floor(x_min))); x <= x_end; ++x) {
      const double a = edge(s[1], s[2], x + 0.5, y + 0.5) / area;
      const double b = edge(s[2], s[0], x + 0.5, y + 0.5) / area;
      const double c = 1.0 - a - b;
      if (a < 0 || b < 0 || c < 0) continue;
      const double depth = a * s[0].z() + b * s[1].z() + c * s[2].z();
      Sample& sample = at(x, y);
      if (depth <= sample.depth) continue;
      Vec3 normal = a * n[0] + b * n[1] + c * n[2];
      if (normal.z() < 0) normal = -normal;  // both faces of an open surface are lit
      sample = {depth, object, shaded(colour, normal.normalized())};
    }
  }
}

void Raster::ellipsoid(const Pose& X_WE, const Vec3& semi_axes, Rgb colour, int object) {
  const auto on_sphere = [](int line, int meridian) -> Vec3 {
    const double polar = std::numbers::pi * line / kLines;
    const double azimuth = 2.0 * std::numbers::pi * meridian / kMeridians;
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
            std::cos(polar)};
  };
  const auto corner = [&](int line, int meridian, Vec3& p, Vec3& n) {
    const Vec3 unit = on_sphere(line, meridian);
    p = X_WE * Vec3(unit.cwiseProduct(semi_axes));
    n = (X_WE.q * Vec3(unit.cwiseQuotient(semi_axes))).normalized();
  };
  for (int i = 0; i < kLines; ++i) {
    for (int j = 0; j < kMeridians; ++j) {
      std::array<Vec3, 4> p;
      std::array<Vec3, 4> n;
      corner(i, j, p[0], n[0]);
      corner(i + 1, j, p[1], n[1]);
      corner(i + 1, j + 1, p[2], n[2]);
      corner(i, j + 1, p[3], n[3]);
      triangle({p[0], p[1], p[2]}, {n[0], n[1], n[2]}, colour, object);
      triangle({p[0], p[2], p[3]}, {n[0], n[2], n[3]}, colour, object);
    }
  }
}

void Raster::mesh(const Pose& X_WM, const SceneMesh& mesh, Rgb colour, int object) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    const Vec3 b = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    const Vec3 area = a.cross(b);
    for (const int corner : t) normals[corner] += area;
  }
  for (const auto& t : mesh.triangles) {
    std::array<Vec3, 3> p;
    std::array<Vec3, 3> n;
    for (int k = 0; k < 3; ++k) {
      p[k] = X_WM * mesh.vertices[t[k]];
      n[k] = X_WM.q * normals[t[k]];
    }
    triangle(p, {n[0].normalized(), n[1].normalized(), n[2].normalized()}, colour, object);
  }
}

void Raster::quad(const std::array<Vec3, 4>& p_W, Rgb colour, int object) {
  const Vec3 n = (p_W[2] - p_W[0]).cross(p_W[3] - p_W[1]).normalized();
  triangle({p_W[0], p_W[1], p_W[2]}, {n, n, n}, colour, object);
  triangle({p_W[0], p_W[2], p_W[3]}, {n, n, n}, colour, object);
}

void Raster::line(const Vec3& from_W, const Vec3& to_W, double width, Rgb colour) {
  const Vec3 a = to_screen(from_W);
  const Vec3 b = to_screen(to_W);
  const double half = 0.5 * width * kSupersampling;
  const double length = (b - a).head<2>().norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * length)));
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = a + (b - a) * (static_cast<double>(i) / steps);
    for (int y = static_cast<int>(p.y() - half); y <= static_cast<int>(p.y() + half); ++y) {
      for (int x = static_cast<int>(p.x() - half); x <= static_cast<int>(p.x() + half); ++x) {
        if (x < 0 || y < 0 || x >= width_ || y >= height_ || at(x, y).object >= 0) continue;
        at(x, y).colour = colour;
      }
    }
  }
}

bool Raster::is_border(int x, int y) const {
  const Sample& here = at(x, y);
  if (here.object < 0) return false;
  constexpr std::array<std::array<int, 2>, 8> kSteps{
      {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-2, 0}, {2, 0}, {0, -2}, {0, 2}}};
  for (const auto& step : kSteps) {
    const int nx = x + step[0];
    const int ny = y + step[1];
    if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_) continue;
    const Sample& there = at(nx, ny);
    if (there.object != here.object && there.depth < here.depth) return true;
    if (there.object == here.object && there.depth < here.depth - kBorderStep) return true;
  }
  return false;
}

Image Raster::finish() const {
  Image image(width_ / kSupersampling, height_ / kSupersampling, Rgb{});
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double r = 0;
      double g = 0;
      double b = 0;
      for (int j = 0; j < kSupersampling; ++j) {
        for (int i = 0; i < kSupersampling; ++i) {
          const int sx = x * kSupersampling + i;
          const int sy = y * kSupersampling + j;
          const double tone = is_border(sx, sy) ? 0.35 : 1.0;
          const Rgb& c = at(sx, sy).colour;
          r += tone * c.r;
          g += tone * c.g;
          b += tone * c.b;
        }
      }
      constexpr double kShare = 1.0 / (kSupersampling * kSupersampling);
      image.at(x, y) = {static_cast<std::uint8_t>(std::lround(r * kShare)),
                        static_cast<std::uint8_t>(std::lround(g * kShare)),
                        static_cast<std::uint8_t>(std::lround(b * kShare))};
    }
  }
  return image;
}

}  // namespace crosswalk::recording
