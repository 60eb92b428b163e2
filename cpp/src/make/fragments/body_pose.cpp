// SPDX-License-Identifier: MIT
#include "fragments/body_pose.hpp"

#include <cstddef>

#include "motion/pose.hpp"

namespace fragmotion {

BodyPose body_pose(const Kinematics& kinematics, const Clip& clip, double at) {
  BodyPose pose;
  pose.rotations.resize(std::size_t{4} * kinematics.bones());
  const Vector3 root = sample_pose(clip, at, pose.rotations.data());
  double* hips = &pose.rotations[std::size_t{4} * kinematics.skeleton().roles.hips];
  pose.frame = frame_at(clip, at);
  pose.height = root.z();
  store_quaternion(pose.frame.rotation().inverse() * load_quaternion(hips), hips);
  return pose;
}

void append(const Kinematics& kinematics, Clip& clip, const CharacterFrame& frame, const BodyPose& pose) {
  const Vector3 root{frame.position.x(), frame.position.y(), pose.height};
  clip.root_positions.insert(clip.root_positions.end(), root.data(), root.data() + 3);
  clip.headings.push_back(frame.heading);
  clip.rotations.insert(clip.rotations.end(), pose.rotations.begin(), pose.rotations.end());
  double* hips =
      &clip.rotations[std::size_t{4} * (clip.frames * kinematics.bones() + kinematics.skeleton().roles.hips)];
  store_quaternion(frame.rotation() * load_quaternion(hips), hips);
  ++clip.frames;
}

}  // namespace fragmotion
