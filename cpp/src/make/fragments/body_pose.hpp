// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motion/facing.hpp"
#include "skeleton/kinematics.hpp"

namespace fragmotion {

/// A pose seen from its character frame: the hips' height, and rotations with the hips' relative to the frame.
struct BodyPose {
  CharacterFrame frame;
  double height = 0;
  std::vector<double> rotations;
};

BodyPose body_pose(const Kinematics& kinematics, const Clip& clip, double at);

/// Adds a frame to a clip: the pose in that character frame.
void append(const Kinematics& kinematics, Clip& clip, const CharacterFrame& frame, const BodyPose& pose);

inline Vector2 turned(const Vector2& v, double angle) { return Eigen::Rotation2Dd(angle) * v; }

}  // namespace fragmotion
