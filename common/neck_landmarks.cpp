#include "common/neck_landmarks.h"

#include "common/error.h"

namespace crosswalk {

NeckLandmarks neck_landmarks(const BodyDescription& body) {
  const int torso = body.find_segment("torso_up"), neck = body.find_segment("neck_low"),
            head = body.find_segment("head");
  CW_ASSERT(torso >= 0 && neck >= 0 && head >= 0);
  NeckLandmarks marks;
  marks.base = body.segments[neck].joint_centre;
  marks.condyles = body.segments[head].joint_centre;
  marks.head_centre = body.segments[head].com;
  marks.base_on_torso = marks.base - body.segments[torso].com;
  return marks;
}

}  // namespace crosswalk
