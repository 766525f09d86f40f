// The brain's strain as three cuts through the head, coloured by cividis (perceptually uniform,
// colour-blind safe, rising in lightness so that it reads in grey [Nunez et al. 2018, PLoS ONE
// 13:e0199239]).
#pragma once

#include <string>

#include "recorder/report/image.h"
#include "recorder/report/report.h"

namespace crosswalk::recording {

/// 0 .. 1, clamped.
Rgb strain_colour(double share);
std::string css_colour(Rgb colour);

/// Sagittal, coronal and horizontal cut through the middle of the brain, side by side: every pixel
/// takes the strain of the element centroid nearest to it in the cut's plane, blank where none is
/// within reach (1.5 times the mean spacing).
Image brain_map_image(const StrainMap& map, double full_scale);

/// The picture with its caption and colour scale, as HTML.
std::string brain_map_html(const StrainMap& map);

}  // namespace crosswalk::recording
