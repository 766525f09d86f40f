// The scene as the page's 3-D view reads it: shapes as numbers, poses of all frames as one base64
// block of float32 (frame by frame: t, then x y z qw qx qy qz of every body, head and vehicle).
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "recorder/report/scene.h"

namespace crosswalk::recording {

/// The block of poses alone.
std::string poses_base64(const Scene& scene);

nlohmann::ordered_json scene_json(const Scene& scene);

}  // namespace crosswalk::recording
