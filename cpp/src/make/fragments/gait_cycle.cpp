// SPDX-License-Identifier: MIT
#include "fragments/gait_cycle.hpp"

#include <cstdlib>

#include "motion/pose.hpp"
#include "motion/trunk.hpp"

namespace fragmotion {

int frame_of(int f, int begin, int end) {
  const int length = std::abs(end - begin), at = (f % length + length) % length;
  return begin < end ? begin + at : begin - at;
}

GaitCycle gait_cycle_of(const Kinematics& kinematics, const Clip& clip, int begin, int end) {
  return gait_cycle_of(kinematics, clip, begin, end, body_pose(kinematics, clip, begin));
}

GaitCycle gait_cycle_of(const Kinematics& kinematics, const Clip& clip, int begin, int end, const BodyPose& next) {
  GaitCycle cycle;
  for (int f = 0; f < std::abs(end - begin); ++f) {
    cycle.poses.push_back(body_pose(kinematics, clip, frame_of(f, begin, end)));
  }
  const BodyPose last = body_pose(kinematics, clip, end);
  cycle.end = last.frame;
  for (int f = 0; f < cycle.frames(); ++f) {
    const double weight = ease_in_ease_out(2.0 * f / cycle.frames() - 1);
    BodyPose& pose = cycle.poses[f];
    pose.height += weight * (next.height - last.height);
    for (std::size_t b = 0; b < pose.rotations.size(); b += 4) {
      const Quaternion missing = load_quaternion(&next.rotations[b]) * load_quaternion(&last.rotations[b]).conjugate();
      const Quaternion by = Quaternion::Identity().slerp(weight, missing);
      store_quaternion((by * load_quaternion(&pose.rotations[b])).normalized(), &pose.rotations[b]);
    }
  }
  return cycle;
}

std::vector<int> spine_bones(const Skeleton& skeleton) {
  std::vector<int> bones;
  const Trunk trunk(skeleton);
  if (trunk.base < 0) return bones;
  const int end = skeleton.parents[trunk.base];
  for (int b = trunk.head >= 0 ? trunk.head : trunk.chest; b != end; b = skeleton.parents[b]) bones.push_back(b);
  return bones;
}

void turn_hips(const Skeleton& skeleton, GaitCycle& cycle, double angle) {
  if (angle == 0) return;
  const std::vector<int> spine = spine_bones(skeleton);
  const double each = angle / static_cast<double>(spine.size());
  const Quaternion turn{Eigen::AngleAxisd(angle, Vector3::UnitZ())};
  for (BodyPose& pose : cycle.poses) {
    double* hips = &pose.rotations[std::size_t{4} * skeleton.roles.hips];
    store_quaternion(turn * load_quaternion(hips), hips);
    for (const int b : spine) turn_bone(skeleton, b, Vector3::UnitZ(), -each, pose.rotations.data());
  }
}

}  // namespace fragmotion
