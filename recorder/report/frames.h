// Still pictures of a scene as the seed paper shows them [yu2020, Figures 5 and A3-A6]: posterior
// (seen from behind the subject, along +x of W) and superior (from above, the subject's front up).
// The car comes from the right in both. Orthographic, one scale for all times of a scene.
//
// Gold: multibody segments. Blue: finite-element head. Grey: car; light blue: windshield.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "recorder/report/image.h"
#include "recorder/report/raster.h"
#include "recorder/report/scene.h"

namespace crosswalk::recording {

enum class StillView { Posterior, Superior };
std::string_view view_name(StillView view);  ///< "posterior", "superior"

/// The part of the world that all stills of a scene show, fixed for the given times.
struct Framing {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();   ///< m: y of W and z (posterior) or x (superior)
  Eigen::Vector2d high = Eigen::Vector2d::Zero();  ///< m
};
Framing framing(const Scene& scene, StillView view, const std::vector<double>& times);

Image render_still(const Scene& scene, StillView view, double t, const Framing& part, int height);

/// Default instants: first contact to 200 ms (or the end) every 40 ms.
std::vector<double> default_still_times(const Scene& scene);

/// Writes `<view>_<t>ms.png` for every view and time into `folder` (made if absent); returns the
/// files in order.
std::vector<std::filesystem::path> write_stills(const std::filesystem::path& folder,
                                                const Scene& scene,
                                                const std::vector<double>& times, int height = 480);

}  // namespace crosswalk::recording
