#include "fe_node/element/shell_section.h"

#include <cmath>
#include <stdexcept>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

/// Gauss-Legendre on (-1/2, 1/2) with weights summing to one.
std::vector<ShellPoint> gauss_points(int count) {
  switch (count) {
    case 1:
      return {{0, 1}};
    case 2: {
      const double a = 0.5 / std::sqrt(3.0);
      return {{-a, 0.5}, {a, 0.5}};
    }
    case 3: {
      const double a = 0.5 * std::sqrt(0.6);
      return {{-a, 5.0 / 18}, {0, 8.0 / 18}, {a, 5.0 / 18}};
    }
    case 4: {
      const double r = std::sqrt(1.2), a = 0.5 * std::sqrt((3 - 2 * r) / 7),
                   b = 0.5 * std::sqrt((3 + 2 * r) / 7);
      const double w = std::sqrt(30.0) / 72;
      return {{-b, 0.25 - w}, {-a, 0.25 + w}, {a, 0.25 + w}, {b, 0.25 - w}};
    }
    case 5: {
      const double r = 2 * std::sqrt(10.0 / 7), a = std::sqrt(5 - r) / 6, b = std::sqrt(5 + r) / 6;
      const double w = 13 * std::sqrt(70.0) / 1800;
      return {{-b, 322.0 / 1800 - w},
              {-a, 322.0 / 1800 + w},
              {0, 128.0 / 450},
              {a, 322.0 / 1800 + w},
              {b, 322.0 / 1800 - w}};
    }
    default:
      throw std::invalid_argument("a shell takes 1 to 5 Gauss points through the thickness");
  }
}

/// Points on both faces and equally spaced between, weighted so that bending of a linear law is
/// exact: Lobatto for three, and the trapezoid rule corrected at the ends for more.
std::vector<ShellPoint> face_points(int count) {
  if (count < 3 || count > 10)
    throw std::invalid_argument("a shell takes 3 to 10 Lobatto points through the thickness");
  if (count == 3) return {{-0.5, 1.0 / 6}, {0, 4.0 / 6}, {0.5, 1.0 / 6}};
  std::vector<ShellPoint> points(count);
  const double step = 1.0 / (count - 1);
  double moment = 0, interior = 0;
  for (int i = 0; i < count; ++i) {
    points[i] = {-0.5 + i * step, step};
    if (i > 0 && i < count - 1) {
      moment += step * points[i].position * points[i].position;
      interior += step;
    }
  }
  // end weight e and interior scale s from: 2 e + s interior = 1 and e/2 + s moment = 1/12
  const double s = (0.25 - 1.0 / 12) / (0.25 * interior - moment);
  for (ShellPoint& point : points) point.weight *= s;
  points.front().weight = points.back().weight = 0.5 * (1 - s * interior);
  return points;
}

}  // namespace

double density_of(const ShellLaw& law) {
  return std::visit([](const auto& l) { return l.density; }, law);
}

double ShellSection::density() const {
  double sum = 0;
  for (const ShellLayer& layer : layers)
    for (const ShellPoint& point : layer.points) sum += point.weight * density_of(layer.law);
  return sum;
}

double ShellSection::youngs_modulus() const {
  double sum = 0;
  for (const ShellLayer& layer : layers)
    for (const ShellPoint& point : layer.points)
      sum += point.weight * std::visit([](const auto& l) { return l.youngs_modulus; }, layer.law);
  return sum;
}

ShellSection uniform_section(ShellLaw law, double thickness, int points, ThicknessRule rule) {
  ShellSection section;
  section.thickness = thickness;
  section.layers.push_back(
      {std::move(law), rule == ThicknessRule::Gauss ? gauss_points(points) : face_points(points)});
  return section;
}

ShellSection membrane_section(ShellLaw law, double thickness) {
  ShellSection section = uniform_section(std::move(law), thickness, 1);
  section.theory = ShellTheory::Membrane;
  return section;
}

void move_reference(ShellSection& section, double position) {
  for (ShellLayer& layer : section.layers)
    for (ShellPoint& point : layer.points) point.position -= position;
}

double series_shear_factor(const ShellSection& section) {
  double stiff = 0, compliance = 0;
  for (const ShellLayer& layer : section.layers) {
    double share = 0;
    for (const ShellPoint& point : layer.points) share += point.weight;
    const double G = std::visit(
        [](const auto& l) { return 0.5 * l.youngs_modulus / (1 + l.poisson_ratio); }, layer.law);
    stiff += share * G;
    compliance += share / G;
  }
  return std::min(5.0 / 6.0, 1 / (stiff * compliance));
}

ShellSection laminate(const std::vector<Ply>& plies) {
  CW_ASSERT(!plies.empty());
  ShellSection section;
  for (const Ply& ply : plies) section.thickness += ply.thickness;
  double bottom = -0.5;
  for (const Ply& ply : plies) {
    const double share = ply.thickness / section.thickness;
    ShellLayer layer{ply.law, gauss_points(ply.points)};
    for (ShellPoint& point : layer.points) {
      point.position = bottom + share * (0.5 + point.position);
      point.weight *= share;
    }
    bottom += share;
    section.layers.push_back(std::move(layer));
  }
  section.shear_factor = series_shear_factor(section);
  return section;
}

}  // namespace crosswalk::fe
