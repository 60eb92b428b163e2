// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "motion/pose.hpp"
#include "walker.hpp"

namespace fragmotion {

inline const Skeleton kSkeleton = humanoid();
inline const Kinematics kKinematics(kSkeleton);

inline double usual_of(const std::vector<Clip>& clips) {
  std::vector<BodyMotion> motions;
  for (const Clip& clip : clips) motions.push_back(body_motion(kKinematics, clip));
  return usual_height(motions);
}

inline Control evident_of(const Clip& clip, int begin, int end, double usual,
                          const ControlSpace& space = ControlSpace()) {
  return evident_control(body_motion(kKinematics, clip), clip.rate, begin, end, usual, space);
}

inline double lowest_tip(const Clip& clip, int frame) {
  std::vector<Vector3> heads(kSkeleton.size());
  std::vector<Quaternion> rotations(kSkeleton.size());
  world(kKinematics, clip, frame, heads.data(), rotations.data());
  double lowest = std::numeric_limits<double>::infinity();
  for (int b = 0; b < kSkeleton.size(); ++b) {
    const Vector3 tip = heads[b] + rotations[b] * kSkeleton.tips[b];
    lowest = std::min(lowest, tip.z());
  }
  return lowest;
}

}  // namespace fragmotion
