// SPDX-License-Identifier: MIT
#pragma once

#include "fragments/body_pose.hpp"

namespace fragmotion {

/// The frame of a clip that is number `f` of a motion that goes round and round frames begin .. end of it.
int frame_of(int f, int begin, int end);

/// One cycle of a gait, each pose seen from its character frame, and the way from each to the next.
struct GaitCycle {
  std::vector<BodyPose> poses;
  CharacterFrame end;  ///< where the next cycle begins

  int frames() const { return static_cast<int>(poses.size()); }
  /// In a frame, m.
  Vector2 mean_way() const {
    return Eigen::Rotation2Dd(-poses[0].frame.heading) * Vector2{end.position - poses[0].frame.position} / frames();
  }
};

/// Frames begin .. end of a clip, after which the pose `next` comes: where the last is not as that, the second half
/// leads to it.
GaitCycle gait_cycle_of(const Kinematics& kinematics, const Clip& clip, int begin, int end, const BodyPose& next);
/// The same, after which the first pose comes.
GaitCycle gait_cycle_of(const Kinematics& kinematics, const Clip& clip, int begin, int end);

/// The bones from the head, or the chest where there is none, down to what is above the legs; none without a spine.
std::vector<int> spine_bones(const Skeleton& skeleton);

/// Turns the hips of each pose to the left, rad, and each bone of the spine back by as much, so that the head stays.
void turn_hips(const Skeleton& skeleton, GaitCycle& cycle, double angle);

}  // namespace fragmotion
