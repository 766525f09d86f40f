// From the messages of a run to what is seen of it: shapes from the nodes' descriptions
// (docs/messages.md), poses from the records, times relative to first contact.
#pragma once

#include "recorder/report/scene.h"
#include "recorder/run_record.h"

namespace crosswalk::recording {

/// The shapes alone, without frames.
Scene shapes_of(const RunRecord& record);
/// Appends the frames of a record to a scene that has its shapes.
void add_frames(Scene& scene, const RunRecord& record, double t0);

/// `t0` (s): simulated time of first contact. An empty scene when the log holds no body poses.
Scene scene_of(const RunRecord& record, double t0);

}  // namespace crosswalk::recording
