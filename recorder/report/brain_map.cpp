#include "recorder/report/brain_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace crosswalk::recording {
namespace {

// Cividis at 0, 1/8 .. 1.
constexpr std::array<Rgb, 9> kCividis{{{0, 34, 78},
                                       {18, 53, 112},
                                       {59, 73, 108},
                                       {87, 93, 109},
                                       {112, 113, 115},
                                       {138, 134, 120},
                                       {165, 156, 116},
                                       {195, 179, 105},
                                       {254, 232, 56}}};
constexpr int kPanel = 260;               // px, one cut
constexpr int kGap = 12;                  // px
constexpr double kReach = 1.5;            // of the mean spacing
constexpr double kMargin = 1.1;           // of the reach, around the centroids
constexpr double kFullScaleShare = 0.98;  // of the elements lie on the scale; the rest is "more"

struct Cut {
  int right, up, through;  ///< axes of the head frame
  double right_sign;
};
constexpr std::array<Cut, 3> kCuts{{{0, 2, 1, 1.0}, {1, 2, 0, -1.0}, {1, 0, 2, -1.0}}};

}  // namespace

Rgb strain_colour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kCividis.size() - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), kCividis.size() - 2);
  const double f = at - static_cast<double>(i);
  const auto mix = [f](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + f * (b - a)));
  };
  const Rgb& a = kCividis[i];
  const Rgb& b = kCividis[i + 1];
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

std::string css_colour(Rgb colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
}

Image brain_map_image(const StrainMap& map, double full_scale) {
  Image image(3 * kPanel + 2 * kGap, kPanel, Rgb{255, 255, 255});
  if (map.centroids.empty()) return image;
  Vec3 low = map.centroids.front();
  Vec3 high = low;
  for (const Vec3& c : map.centroids) {
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  const Vec3 middle = 0.5 * (low + high);
  // Mean spacing from the volume of the ellipsoid that the centroids fill.
  const double volume = 0.52 * (high - low).cwiseMax(1e-6).prod();
  const double reach = kReach * std::cbrt(volume / static_cast<double>(map.centroids.size()));
  const double size = (high - low).maxCoeff() + 2 * kMargin * reach;
  for (std::size_t panel = 0; panel < kCuts.size(); ++panel) {
    const Cut& cut = kCuts[panel];
    std::vector<double> nearest(static_cast<std::size_t>(kPanel) * kPanel, reach * reach);
    const double px = size / kPanel;
    for (std::size_t i = 0; i < map.centroids.size(); ++i) {
      const Vec3 c = map.centroids[i] - middle;
      if (std::abs(c[cut.through]) > reach) continue;
      const double u = kPanel * 0.5 + cut.right_sign * c[cut.right] / px;
      const double v = kPanel * 0.5 - c[cut.up] / px;
      const int r = static_cast<int>(std::ceil(reach / px));
      for (int y = std::max(0, static_cast<int>(v) - r);
           y <= std::min(kPanel - 1, static_cast<int>(v) + r); ++y) {
        for (int x = std::max(0, static_cast<int>(u) - r);
             x <= std::min(kPanel - 1, static_cast<int>(u) + r); ++x) {
          const double dx = (x + 0.5 - u) * px;
          const double dy = (y + 0.5 - v) * px;
          const double d2 = dx * dx + dy * dy + c[cut.through] * c[cut.through];
          double& best = nearest[static_cast<std::size_t>(y) * kPanel + x];
          if (d2 >= best) continue;
          best = d2;
          image.at(static_cast<int>(panel) * (kPanel + kGap) + x, y) =
              strain_colour(map.strain[i] / full_scale);
        }
      }
    }
  }
  return image;
}

std::string brain_map_html(const StrainMap& map) {
  if (map.centroids.empty()) return "";
  std::vector<double> sorted = map.strain;
  std::sort(sorted.begin(), sorted.end());
  const double high =
      sorted[static_cast<std::size_t>(kFullScaleShare * static_cast<double>(sorted.size() - 1))];
  const double full_scale = std::max(0.05, std::ceil(high * 20.0) / 20.0);
  std::string scale;
  for (int i = 0; i <= 4; ++i) {
    scale += fmt::format("<span><i style='background:{};width:2.2em'></i>{:.2g}{}</span> ",
                         css_colour(strain_colour(0.25 * i)), 0.25 * i * full_scale,
                         i == 4 ? " and more" : "");
  }
  return fmt::format(
      "<figure><img src='{}' alt='brain strain in three cuts'><figcaption>Cuts through the middle: "
      "sagittal (front to the right), coronal (seen from behind), horizontal (seen from above, "
      "front "
      "up). <span class='key'>strain {}</span></figcaption></figure>",
      data_url(brain_map_image(map, full_scale)), scale);
}

}  // namespace crosswalk::recording
