// Motion of head and car of a run, for a head alone that is driven by it or starts from it.
//
// `# key: value` lines, then one row per head sample, frame W, SI. Columns: t_s from the row that
// starts it; for `head` (origin at the COG, axes forward, left, up) and `buck` (the car's frame)
// each <body>_{x,y,z}_m, <body>_q{w,x,y,z}, <body>_v{x,y,z}_mps, <body>_w{x,y,z}_radps.
#pragma once

#include <filesystem>

#include "recorder/run_record.h"

namespace crosswalk::recording {

enum class MotionStart {
  FirstContact,  ///< of car and pedestrian
  HeadContact    ///< kLead before the head touches the car
};
/// s; a finite-element head is larger here and there than the ellipsoid of a multibody one.
inline constexpr double kLead = 2e-3;

/// Throws UserError when the run has no head contact to start from or no car.
void write_motion_csv(const std::filesystem::path& path, const RunRecord& record,
                      MotionStart start);

/// Trajectories: one row per recorded instant (1 ms), t_ms after first contact, then of every body,
/// the car last, <body>_{x,y,z}_mm and <body>_q{w,x,y,z} of its frame in W (multibody centre of
/// mass, axes of the erect posture). Throws UserError when the log holds no poses.
void write_bodies_csv(const std::filesystem::path& path, const RunRecord& record);

}  // namespace crosswalk::recording
