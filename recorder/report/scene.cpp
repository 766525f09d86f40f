#include "recorder/report/scene.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace crosswalk::recording {

const SceneFrame& Scene::frame_at(double t) const {
  CW_ASSERT(!frames.empty());
  const auto after =
      std::lower_bound(frames.begin(), frames.end(), t,
                       [](const SceneFrame& frame, double time) { return frame.t < time; });
  if (after == frames.begin()) return frames.front();
  if (after == frames.end()) return frames.back();
  const auto before = after - 1;
  return std::abs(before->t - t) <= std::abs(after->t - t) ? *before : *after;
}

}  // namespace crosswalk::recording
