// SPDX-License-Identifier: MIT
#include <algorithm>

#include "skeleton/bone_names.hpp"
#include "skeleton/skeleton.hpp"

namespace fragmotion {

std::vector<int> mirror_bones(const Skeleton& skeleton) {
  const std::vector<BoneName> names = read_names(skeleton.names);
  std::vector<int> mirror(names.size());
  for (int bone = 0; bone < skeleton.size(); ++bone) {
    const int other = names[bone].counterpart;
    // Both must name each other: names that differ only in case would pair three bones.
    mirror[bone] = other >= 0 && names[other].counterpart == bone ? other : bone;
  }
  return mirror;
}

std::vector<int> measured_bones(const Skeleton& skeleton) {
  const Roles& roles = skeleton.roles;
  const std::vector<BoneName> names = read_names(skeleton.names);
  const auto is_beyond = [&](int bone, int end) { return end >= 0 && bone != end && skeleton.is_below(bone, end); };
  const int hips = std::max(roles.hips, 0);
  std::vector<int> bones{hips};  // whatever the roles are, Dis sums over something
  for (int bone = hips + 1; bone < skeleton.size(); ++bone) {
    if (!skeleton.is_below(bone, hips)) continue;
    const bool is_face = is_beyond(bone, roles.head);
    const bool is_hand_part = is_beyond(bone, roles.left_hand) || is_beyond(bone, roles.right_hand);
    // CMU's thumbs hang on the wrist beside the hand, so the place alone does not tell fingers.
    const bool is_named_finger = names[bone].side != Side::kNone && is_finger(names[bone]);
    if (!is_face && !is_hand_part && !is_named_finger) bones.push_back(bone);
  }
  return bones;
}

}  // namespace fragmotion
