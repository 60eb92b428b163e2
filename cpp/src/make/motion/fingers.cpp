// SPDX-License-Identifier: MIT
#include "motion/fingers.hpp"

#include <algorithm>

#include "skeleton/relaxed_hands.hpp"

namespace fragmotion {
namespace {

constexpr double kRests = 1e-3;  // rad from its rest: what a file's digits make of none

bool rests(const Skeleton& skeleton, const Clip& clip, int bone) {
  const std::size_t width = std::size_t{4} * skeleton.size();
  for (std::size_t at = std::size_t{4} * bone; at < clip.rotations.size(); at += width) {
    if (load_quaternion(&clip.rotations[at]).angularDistance(skeleton.rest_rotations[bone]) > kRests) return false;
  }
  return true;
}

}  // namespace

Clip with_fingers(const Skeleton& skeleton, Clip clip, const std::vector<double>& pose) {
  const std::size_t width = std::size_t{4} * skeleton.size();
  for (const int bone : finger_bones(skeleton)) {
    if (!rests(skeleton, clip, bone)) continue;
    for (std::size_t at = std::size_t{4} * bone; at < clip.rotations.size(); at += width) {
      std::copy_n(&pose[std::size_t{4} * bone], 4, &clip.rotations[at]);
    }
  }
  return clip;
}

}  // namespace fragmotion
