// SPDX-License-Identifier: MIT
#include "motion/fingers.hpp"

#include <algorithm>

#include "base/rounding.hpp"
#include "skeleton/relaxed_hands.hpp"

namespace fragmotion {
namespace {

// Whether a bone is turned so in all of a clip.
bool stays(const Clip& clip, int bones, int bone, const Quaternion& rotation) {
  const std::size_t width = std::size_t{4} * bones;
  for (std::size_t at = std::size_t{4} * bone; at < clip.rotations.size(); at += width) {
    if (load_quaternion(&clip.rotations[at]).angularDistance(rotation) > kFileRounding) return false;
  }
  return true;
}

}  // namespace

Clip with_fingers(const Skeleton& skeleton, Clip clip, const std::vector<double>& pose) {
  const std::size_t width = std::size_t{4} * skeleton.size();
  for (const int bone : finger_bones(skeleton)) {
    if (!stays(clip, skeleton.size(), bone, skeleton.rest_rotations[bone])) continue;
    for (std::size_t at = std::size_t{4} * bone; at < clip.rotations.size(); at += width) {
      std::copy_n(&pose[std::size_t{4} * bone], 4, &clip.rotations[at]);
    }
  }
  return clip;
}

std::vector<int> still_fingers(const Skeleton& skeleton, const std::vector<Clip>& clips) {
  if (clips.empty()) return {};
  std::vector<int> still;
  for (const int bone : finger_bones(skeleton)) {
    const Quaternion first = load_quaternion(&clips.front().rotations[std::size_t{4} * bone]);
    const auto stands = [&](const Clip& clip) { return stays(clip, skeleton.size(), bone, first); };
    if (std::all_of(clips.begin(), clips.end(), stands)) still.push_back(bone);
  }
  return still;
}

}  // namespace fragmotion
