// Where a finite-element head and neck join the multibody pedestrian, and where its condyles and
// head centre have to lie: one recipe for both sides, from the scaled subject alone, so that
// nothing but motion travels between them. Erect reference posture, axes of W, m.
#pragma once

#include "common/body_description.h"

namespace crosswalk {

struct NeckLandmarks {
  Vec3 base = Vec3::Zero();           ///< C7/T1: joint of the lower neck on torso_up
  Vec3 condyles = Vec3::Zero();       ///< occipital condyles: joint of the head on the neck
  Vec3 head_centre = Vec3::Zero();    ///< mass centre of the head
  Vec3 base_on_torso = Vec3::Zero();  ///< base from the mass centre of torso_up
};

/// Of a description that still has its head and neck.
NeckLandmarks neck_landmarks(const BodyDescription& body);

}  // namespace crosswalk
